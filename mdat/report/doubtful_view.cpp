#include "mdat/report/doubtful_view.hpp"

#include <algorithm>
#include <iterator>

#include "mdat/common/text.hpp"
#include "mdat/report/page.hpp"
#include "mdat/report/scan_view.hpp"
#include "mdat/run/results.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kOpen = 12;    // lines that are not folded away
constexpr std::size_t kListed = 60;  // lines of the list
constexpr std::size_t kPanels = 6;   // scans that are shown
constexpr const char* kWrongColour = "#d4001a";
constexpr const char* kInvalidColour = "#d9a300";

bool is_doubtful(const FrameError& frame) { return frame.wrong || !frame.valid; }

std::string reason_of(const FrameError& frame) {
  if (frame.wrong) return "wrong";
  return frame.told ? plain(to_string(frame.reason)) : "no packet";
}

// Frames in a row with the same trouble.
struct Stretch {
  const FrameError* first = nullptr;
  const FrameError* last = nullptr;
  double worst_mm = 0, worst_deg = 0;
};

void add(const FrameError& frame, std::vector<Stretch>& stretches) {
  const bool goes_on =
      !stretches.empty() && stretches.back().last->frame + 1 == frame.frame && reason_of(*stretches.back().last) == reason_of(frame);
  if (!goes_on) stretches.push_back({&frame, &frame});
  Stretch& stretch = stretches.back();
  stretch.last = &frame;
  if (!frame.reported) return;
  stretch.worst_mm = std::max(stretch.worst_mm, 1e3 * frame.registration.translation_m.norm());
  stretch.worst_deg = std::max(stretch.worst_deg, frame.registration.rotation_rad / kRadPerDeg);
}

std::vector<std::string> row_of(const std::string& run, const Stretch& stretch) {
  const std::uint32_t first = stretch.first->frame, last = stretch.last->frame;
  const bool reported = stretch.first->reported;
  return {run,
          first == last ? format("%u", first) : format("%u–%u", first, last),
          format("%u", last - first + 1),
          reason_of(*stretch.first),
          format("%.3g", stretch.first->range_m),
          reported ? format("%.1f", stretch.worst_mm) : "–",
          reported ? format("%.2f", stretch.worst_deg) : "–"};
}

std::vector<std::vector<std::string>> rows_of(const TableResult& table) {
  std::vector<std::vector<std::string>> rows;
  for (const VariantResult& variant : table.variants) {
    for (std::size_t run = 0; run < variant.cases.size(); ++run) {
      std::vector<Stretch> stretches;
      for (const FrameError& frame : variant.cases[run].frames) {
        if (is_doubtful(frame)) add(frame, stretches);
      }
      for (const Stretch& stretch : stretches)
        rows.push_back(row_of(std::string(variant.variant.title) + ", " + run_text(table.scenario, run), stretch));
    }
  }
  // What is wrong is what a reader has to see.
  std::vector<std::vector<std::string>> sorted;
  for (const bool wrong : {true, false}) {
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(sorted), [&](const auto& row) { return (row[3] == "wrong") == wrong; });
  }
  return sorted;
}

std::string list(std::vector<std::vector<std::string>> rows) {
  HtmlTable html;
  html.head = {"variant, run", "frames", "how many", "why", "range, m", "worst error, mm", "deg"};
  const std::size_t more = rows.size() > kListed ? rows.size() - kListed : 0;
  rows.resize(rows.size() - more);
  html.rows = std::move(rows);
  std::string text =
      to_html(html) + (more > 0 ? format("<p class='note'>And %zu more lines: frames.csv has a row for each frame.</p>\n", more) : "");
  if (html.rows.size() <= kOpen) return text;
  return format("<details><summary>%zu lines</summary>", html.rows.size() + more) + text + "</details>\n";
}

ScanPanel panel_of(const KeptScan& scan, const std::string& title, const Scenario& scenario, std::size_t run) {
  const PoseError error = pose_error(registration_pose(scan.telemetry), scan.truth);
  const std::string why = scan.telemetry.valid != 0 ? "wrong" : plain(to_string(static_cast<PoseReason>(scan.telemetry.reason)));
  return {&scan,
          format("%s: frame %u, %s\\n%s, %.0f mm and %.1f° off", title.c_str(), scan.frame, run_text(scenario, run).c_str(), why.c_str(),
                 1e3 * error.translation_m.norm(), error.rotation_rad / kRadPerDeg),
          Vec3(scenario.center_m.data())};
}

void add_panels(const VariantResult& variant, const Scenario& scenario, bool valid, std::vector<ScanPanel>& panels) {
  for (std::size_t run = 0; run < variant.cases.size(); ++run) {
    for (const KeptScan& scan : variant.cases[run].doubtful) {
      if ((scan.telemetry.valid != 0) == valid && panels.size() < kPanels)
        panels.push_back(panel_of(scan, variant.variant.title, scenario, run));
    }
  }
}

// Wrong ones first, each with the run that it is of.
std::vector<ScanPanel> panels_of(const TableResult& table) {
  std::vector<ScanPanel> panels;
  for (const bool valid : {true, false}) {
    for (const VariantResult& variant : table.variants) add_panels(variant, table.scenario, valid, panels);
  }
  return panels;
}

}  // namespace

std::string doubtful_section(Plotter& plotter, const sim::RayCaster& target, const TableResult& table) {
  std::vector<std::vector<std::string>> rows = rows_of(table);
  if (rows.empty()) return "";
  std::string html = "<h3>Frames that are wrong, or without a valid pose</h3>\n" + list(std::move(rows));
  const std::vector<ScanPanel> panels = panels_of(table);
  if (panels.empty()) return html;
  return html + figure(scan_view(plotter, target, panels, false),
                       std::string("The first of these scans, wrong ones first. The model is drawn at the estimated pose. ") + kScanLegend);
}

std::vector<Curve> doubtful_marks(const VariantResult& variant, double abscissa_step) {
  std::string wrong, invalid;
  for (const CaseResult& run : variant.cases) {
    for (const FrameError& frame : run.frames) {
      const double abscissa = abscissa_step * static_cast<double>(&frame - run.frames.data());
      if (frame.wrong) wrong += format("%g 0.975\n", abscissa);
      if (!frame.valid) invalid += format("%g 0.025\n", abscissa);
    }
  }
  return {{wrong, 2, format(" axes x1y2 with points pt 11 ps 0.5 lc rgb '%s' title 'wrong'", kWrongColour), true},
          {invalid, 2, format(" axes x1y2 with points pt 9 ps 0.5 lc rgb '%s' title 'no valid pose'", kInvalidColour), true}};
}

}  // namespace lasso::mdat
