#include "mdat/report/scene_view.hpp"

#include <cmath>

#include "mdat/common/text.hpp"
#include "mdat/report/base64.hpp"
#include "mdat/report/page.hpp"
#include "mdat/run/relative_poses.hpp"

namespace lasso::mdat {

std::string seen_section(const std::vector<SeenPicture>& pictures) {
  if (pictures.empty()) return "";
  std::string html = "<section>\n<h2>What the sensors see</h2>\n<div class='seen'>\n";
  for (const SeenPicture& picture : pictures) {
    html += "<figure><img alt='" + escape(picture.caption) + "' src='data:image/png;base64," + base64(picture.png) + "'><figcaption>" +
            escape(picture.caption) + "</figcaption></figure>\n";
  }
  return html +
         "</div>\n<p class='note'>As an eye would see it: exposed for the target. On it the rays of the scan: green, those that "
         "returned; grey, those that did not.</p>\n</section>\n";
}

std::string relative_section(const SimulationResult& result) {
  if (result.relative.empty()) return "";
  std::string html =
      "<section>\n<h2>Poses between named frames</h2>\n<div class='wide'><table>\n<tr><th></th><th>valid</th><th>rms, mm</th><th>rms, "
      "deg</th><th>NEES of 6</th><th>filtered rms, mm</th><th>filtered rms, deg</th></tr>\n";
  for (const RelativeRun& run : result.relative) {
    const RelativeFigures figures = relative_figures(run);
    html += "<tr><td>" + escape(run.name) + format("</td><td>%zu of %zu</td>", figures.valid, figures.poses);
    for (const double figure : {figures.rms_mm, figures.rms_deg, figures.nees, figures.filtered_rms_mm, figures.filtered_rms_deg})
      html += "<td>" + (std::isfinite(figure) ? format("%.4g", figure) : std::string("–")) + "</td>";
    html += "</tr>\n";
  }
  return html + "</table></div>\n</section>\n";
}

}  // namespace lasso::mdat
