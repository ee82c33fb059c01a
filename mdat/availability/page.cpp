#include "mdat/availability/page.hpp"

#include <cmath>

#include "mdat/availability/results.hpp"
#include "mdat/common/share_text.hpp"
#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/report/base64.hpp"
#include "mdat/report/drawing.hpp"
#include "mdat/report/page.hpp"

namespace lasso::mdat {
namespace {

constexpr const char* kHeadColours[] = {"#1c7c3c", "#d4571e", "#2563b8"};  // laser camera, stereo, stereo with lamp
const char* head_colour(std::size_t i) { return kHeadColours[i % std::size(kHeadColours)]; }

std::string share_cell(const FrameFigures& figures) {
  const char* grade = figures.available == figures.frames ? "good" : figures.available == 0 ? "bad" : "partly";
  return format("<span class='%s'>%s</span>", grade, count_text(figures).c_str());
}

void add_figures(const FrameFigures& figures, std::vector<std::string>& row) {
  row.push_back(share_cell(figures));
  row.push_back(figures.wrong == 0 ? "0" : format("<span class='bad'>%zu</span>", figures.wrong));
  row.push_back(known(figures.median_mm, 2, "–"));
  row.push_back(known(figures.rms_mm, 2, "–"));
  row.push_back(known(figures.median_deg, 3, "–"));
  row.push_back(known(figures.rms_deg, 3, "–"));
  row.push_back(known(figures.nees, 1, "–"));
}

std::string phases_table(const HeadComparison& comparison) {
  HtmlTable html;
  html.head = {"", "light", "pose available", "wrong", "position, mm: median", "rms", "attitude, deg: median", "rms", "NEES of 6"};
  for (const HeadResult& head : comparison.heads) {
    std::string title = escape(head.head.title);
    for (const LightPhase phase : kLightPhases) {
      const FrameFigures figures = figures_in(head.approach, phase);
      if (figures.frames == 0) continue;
      html.rows.push_back({title, phase_name(phase)});
      add_figures(figures, html.rows.back());
      title.clear();
    }
  }
  return to_html(html);
}

std::string orbits_table(const HeadComparison& comparison) {
  HtmlTable html;
  html.head = {"pose available", "all orbits", "95 % limits", "wrong"};
  const std::vector<double> betas = betas_of(comparison.heads.front().orbits);
  for (const double beta_rad : betas) html.head.push_back(format("beta %g°", beta_rad / kRadPerDeg));
  for (const HeadResult& head : comparison.heads) {
    const FrameFigures all = figures_of(frames_of(head.orbits));
    html.rows.push_back({escape(head.head.title), share_cell(all), limits_text(all.limits()), format("%zu", all.wrong)});
    for (const double beta_rad : betas) html.rows.back().push_back(share_cell(figures_of(frames_at(head.orbits, beta_rad))));
  }
  html.rows.push_back({"camera systems, in the 2005 paper", format("%.0f %%", 100 * kPaperCameraAvailability)});
  html.rows.back().resize(html.head.size(), "–");
  return to_html(html);
}

// time, value; a gap where there is no pose.
std::string errors_over_time(const std::vector<SeenFrame>& frames, bool position) {
  std::string text;
  for (const SeenFrame& seen : frames) {
    const PoseError& error = seen.error.registration;
    if (is_available(seen.error))
      text += format("%.6g %.5g\n", seen.error.t_s / 60, position ? 1e3 * error.translation_m.norm() : error.rotation_rad / kRadPerDeg);
    else
      text += "\n";
  }
  return text;
}

std::string light_over_time(const std::vector<SeenFrame>& frames) {
  std::string text;
  for (const SeenFrame& seen : frames)
    text += format("%.6g %.4g %.4g %.4g\n", seen.error.t_s / 60, seen.light.sun_share, seen.light.earth_lit, seen.light.sun_off_rad / kPi);
  return text;
}

// x, row; of frames with, or without, an available pose.
template <class Items, class X>
std::string strip(const Items& items, bool available, double row, X x) {
  std::string text;
  for (const auto& item : items) {
    if (is_available(item.error) == available) text += format("%.6g %.6g\n", x(item), row);
  }
  return text;
}

void plot_light(const HeadComparison& comparison, Drawing& drawing) {
  const std::string light = light_over_time(comparison.heads.front().approach);
  drawing.set("set title 'light' font ',11'\nset yrange [-0.05:1.05]\nset ytics 0.5\nset key outside right top vertical samplen 1.4\n");
  drawing.plot({{light, 2, " with lines lw 2 lc rgb '#d9a300' title 'Sun that is seen'"},
                {light, 3, " with lines lw 2 lc rgb '#1e9aa8' title 'light of the Earth'"},
                {light, 4, " with lines dt 2 lw 1 lc rgb '#8a94a3' title 'Sun off boresight / 180 deg'"}},
               "no frame");
}

void plot_strips(const HeadComparison& comparison, Drawing& drawing) {
  std::vector<Curve> curves;
  const auto minutes = [](const SeenFrame& seen) { return seen.error.t_s / 60; };
  for (std::size_t i = 0; i < comparison.heads.size(); ++i) {
    const HeadResult& head = comparison.heads[i];
    const double row = -static_cast<double>(i);
    const auto errors = head.approach;
    curves.push_back({strip(errors, true, row, minutes), 2,
                      format(" with points pt 5 ps 0.6 lc rgb '%s' title '%s'", head_colour(i), head.head.title.c_str())});
    curves.push_back({strip(errors, false, row, minutes), 2, " with points pt 2 ps 0.5 lc rgb '#8a94a3' notitle"});
  }
  drawing.set("set title 'pose available (cross: none)'\nset yrange [-2.6:0.6]\nunset ytics\n");
  drawing.plot(curves, "no frame");
  drawing.set("set ytics auto\nset yrange [*:*]\n");
}

void plot_errors(const HeadComparison& comparison, bool position, Drawing& drawing) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < comparison.heads.size(); ++i)
    curves.push_back({errors_over_time(comparison.heads[i].approach, position), 2,
                      format(" with linespoints pt 7 ps 0.35 lw 1 lc rgb '%s' notitle", head_colour(i))});
  drawing.set(format("set logscale y\nset format y '%%g'\nset title '%s'\n", position ? "position error, mm" : "attitude error, deg"));
  drawing.plot(curves, "no pose", Axis::kLogarithmic);
  drawing.set("unset logscale y\n");
}

std::string approach_figure(Plotter& plotter, const HeadComparison& comparison) {
  Drawing drawing(plotter);
  drawing.set("set multiplot layout 4,1 margins 0.07,0.78,0.09,0.95 spacing 0,0.085\n");
  const std::vector<SeenFrame>& frames = comparison.heads.front().approach;
  drawing.set(format("set xrange [0:%g]\n", frames.back().error.t_s / 60));
  plot_light(comparison, drawing);
  plot_strips(comparison, drawing);
  plot_errors(comparison, true, drawing);
  drawing.set("set xlabel 'minutes since the begin' textcolor '#46505f'\n");
  plot_errors(comparison, false, drawing);
  return drawing.svg(1080, 760);
}

// The samples of one head at one beta, in a row: with a pose, and without.
void add_orbit_row(const HeadComparison& comparison, std::size_t i, double beta_rad, double row, bool named, std::vector<Curve>& curves) {
  std::string with, without;
  for (const OrbitSample& sample : comparison.heads[i].orbits) {
    if (sample.beta_rad != beta_rad) continue;
    (is_available(sample.seen.error) ? with : without) += format("%.6g %g\n", sample.angle_rad / kRadPerDeg, row);
  }
  const std::string title = named ? "title '" + comparison.heads[i].head.title + "'" : "notitle";
  curves.push_back({with, 2, format(" with points pt 5 ps 0.9 lc rgb '%s' ", head_colour(i)) + title});
  curves.push_back({without, 2, " with points pt 2 ps 0.7 lc rgb '#8a94a3' notitle"});
}

std::string orbits_figure(Plotter& plotter, const HeadComparison& comparison) {
  Drawing drawing(plotter);
  const std::vector<double> betas = betas_of(comparison.heads.front().orbits);
  drawing.set("set xrange [-180:180]\nset xtics 45\nset xlabel 'degrees of the orbit past its noon' textcolor '#46505f'\n");
  drawing.set("set key outside right top vertical samplen 1\nset lmargin 12\n");
  std::string tics;
  std::vector<Curve> curves;
  for (std::size_t b = 0; b < betas.size(); ++b) {
    const double top = -4.0 * static_cast<double>(b);
    tics += format("%s'beta %g deg' %g", tics.empty() ? "" : ", ", betas[b] / kRadPerDeg, top - 1);
    for (std::size_t i = 0; i < comparison.heads.size(); ++i)
      add_orbit_row(comparison, i, betas[b], top - static_cast<double>(i), b == 0, curves);
  }
  drawing.set("set ytics (" + tics + format(")\nset yrange [%g:1]\n", -4.0 * static_cast<double>(betas.size())));
  drawing.plot(curves, "no sample");
  return drawing.svg(1080, 360);
}

std::string approach_section(Plotter& plotter, const HeadComparison& comparison) {
  std::string html = "<section>\n<h2>One approach through day and night</h2>\n";
  html += format(
      "<p class='note'>Scenario %s, a scan every %g s, flown with each head through the component. A pose is available where it says that "
      "it "
      "is valid, and is not wrong. Day: %s; terminator: %s; eclipse: %s. A track that is lost is started again near the true pose.</p>\n",
      escape(comparison.approach).c_str(), comparison.period_s, phase_meaning(LightPhase::kDay), phase_meaning(LightPhase::kTerminator),
      phase_meaning(LightPhase::kEclipse));
  html += phases_table(comparison);
  html += figure(approach_figure(plotter, comparison), "Light, poses and their errors over the approach; registrations of single scans.");
  return html + "</section>\n";
}

std::string orbits_section(Plotter& plotter, const HeadComparison& comparison) {
  if (comparison.heads.front().orbits.empty()) return "";
  std::string html = "<section>\n<h2>Whole orbits, by samples</h2>\n";
  html +=
      "<p class='note'>Places are evenly spread over each orbit, beta is the Sun's elevation above its plane. In each place one scan of "
      "scenario " +
      escape(comparison.hold) +
      " is taken, of the target in another attitude, started near the true pose. The shares are those of the samples; penumbra, 8 s to 30 "
      "s long, "
      "is hardly among them. " +
      laser_text(comparison.laser) + "</p>\n";
  html += orbits_table(comparison);
  html +=
      "<p class='note'>The 2005 paper gives camera systems 80 %. What it counts is not known here: it stands beside, and is no "
      "measure.</p>\n";
  html += figure(orbits_figure(plotter, comparison), "Squares: a pose is available; crosses: none. Each row is a head at one beta.");
  return html + "</section>\n";
}

std::string pictures_section(const std::vector<SeenPicture>& pictures) {
  if (pictures.empty()) return "";
  std::string html =
      "<section>\n<h2>What the heads see</h2>\n<p class='note'>In the middle of each stretch of one light. Cameras: the left picture, as "
      "its "
      "matcher gets it, coarser, with the exposure that the head chooses. Laser: its scan; green rays returned, grey ones did "
      "not.</p>\n<div "
      "class='seen'>\n";
  for (const SeenPicture& picture : pictures)
    html += figure("<img alt='" + escape(picture.caption) + "' src='data:image/png;base64," + base64(picture.png) + "'>",
                   escape(picture.caption));
  return html + "</div>\n</section>\n";
}

}  // namespace

std::string comparison_html(Plotter& plotter, const HeadComparison& comparison, const std::vector<SeenPicture>& pictures) {
  const std::string title = escape(comparison.mission) + ": a laser camera and stereo cameras in the light of an orbit";
  std::string body = "<h1>" + title + "</h1>\n";
  body += format("<p class='lead'>mdat %s%s%s, %.0f s. All of it is simulated.</p>\n", kVersion,
                 comparison.commit.empty() ? "" : ", commit ", escape(comparison.commit).c_str(), comparison.seconds);
  body += approach_section(plotter, comparison) + orbits_section(plotter, comparison) + pictures_section(pictures);
  return page(title, body);
}

}  // namespace lasso::mdat
