#include "mdat/campaign/figures.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace lasso::mdat {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kPercentile = 0.95;

using Frames = std::vector<FrameError>;

template <class Test>
double count_if(const Frames& frames, const Test& test) {
  return static_cast<double>(std::count_if(frames.begin(), frames.end(), test));
}

double translation_mm(const FrameError& frame) { return 1e3 * frame.registration.translation_m.norm(); }
double rotation_deg(const FrameError& frame) { return frame.registration.rotation_rad / kRadPerDeg; }
double nees_of(const FrameError& frame) { return frame.nees; }
double level_mm(const FrameError& frame) { return 1e3 * frame.level.position_m; }
double level_deg(const FrameError& frame) { return frame.level.attitude_rad / kRadPerDeg; }

// Of the frames with a valid pose, ascending.
std::vector<double> sorted_of_valid(const CaseResult& result, double (*value)(const FrameError&)) {
  std::vector<double> values;
  for (const FrameError& frame : result.frames) {
    if (frame.valid) values.push_back(value(frame));
  }
  std::sort(values.begin(), values.end());
  return values;
}

double root_mean_square(const CaseResult& result, double (*value)(const FrameError&)) {
  double sum = 0, count = 0;
  for (const FrameError& frame : result.frames) {
    if (!frame.valid) continue;
    sum += value(frame) * value(frame);
    ++count;
  }
  return count == 0 ? kUnknown : std::sqrt(sum / count);
}

double mean(const CaseResult& result, double (*value)(const FrameError&)) {
  double sum = 0, count = 0;
  for (const FrameError& frame : result.frames) {
    if (!frame.valid) continue;
    sum += value(frame);
    ++count;
  }
  return count == 0 ? kUnknown : sum / count;
}

double worst(const CaseResult& result, double (*value)(const FrameError&)) {
  const std::vector<double> values = sorted_of_valid(result, value);
  return values.empty() ? kUnknown : values.back();
}

double at_share(const CaseResult& result, double (*value)(const FrameError&), double share) {
  const std::vector<double> values = sorted_of_valid(result, value);
  if (values.empty()) return kUnknown;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

double percentile(const CaseResult& result, double (*value)(const FrameError&)) { return at_share(result, value, kPercentile); }
double median(const CaseResult& result, double (*value)(const FrameError&)) { return at_share(result, value, 0.5); }

double last(const CaseResult& result, double (*value)(const FrameError&)) {
  return result.frames.empty() || !result.frames.back().valid ? kUnknown : value(result.frames.back());
}

template <class Test>
const FrameError* first_of(const CaseResult& result, const Test& test) {
  const auto frame = std::find_if(result.frames.begin(), result.frames.end(), test);
  return frame == result.frames.end() ? nullptr : &*frame;
}

// Of a case that never had a valid pose to begin at, nothing is known of what would have followed.
double of_begun(const CaseResult& result, double count) { return result.frames.empty() ? kUnknown : count; }

AlertStatistics alerts(const CaseResult& result) { return alert_times(result.frames, result.end_s).statistics(); }

double worst_time_to_alert_s(const CaseResult& result) {
  const AlertStatistics alert = alerts(result);
  return alert.episodes == 0 ? 0 : alert.worst_s;  // a criterion asks for no more than some time
}

double misleading(const CaseResult& result) {
  return count_if(result.frames,
                  [](const FrameError& frame) { return frame.misleads_about_position() || frame.misleads_about_attitude(); });
}

double misleading_share(const CaseResult& result) {
  const double valid = count_if(result.frames, [](const FrameError& frame) { return frame.valid; });
  return valid == 0 ? kUnknown : misleading(result) / valid;
}

SettledStatistics settled(const CaseResult& result) { return settled_statistics(settled_frames(result.frames)); }
double known_or_nan(const CaseResult& result, double value) { return result.frames.size() > kSettlingFrames ? value : kUnknown; }

}  // namespace

const std::vector<Figure>& case_figures() {
  using R = const CaseResult&;
  using F = const FrameError&;
  // clang-format off
  static const std::vector<Figure> figures = {
    {"frames", "frames that were flown; without a pose to start from: since the first valid one", [](R r) { return static_cast<double>(r.frames.size()); }},
    {"valid", "frames with a valid pose", [](R r) { return count_if(r.frames, [](F f) { return f.valid; }); }},
    {"invalid", "frames with a registration that is not valid", [](R r) { return of_begun(r, count_if(r.frames, [](F f) { return f.reported && !f.valid; })); }},
    {"lost", "frames without a registration, or off by more than 50 mm or 5 deg", [](R r) { return of_begun(r, count_if(r.frames, [](F f) { return f.lost(); })); }},
    {"wrong", "frames with a valid pose that is wrong: off by more than 5 of its sigmas, and by more than 20 mm or 1 deg", [](R r) { return count_if(r.frames, [](F f) { return f.wrong; }); }},
    {"first_wrong", "number of the first frame with a wrong pose", [](R r) { const FrameError* f = first_of(r, [](F e) { return e.wrong; }); return f == nullptr ? kUnknown : static_cast<double>(f->frame); }},
    {"found_s", "time of the first valid pose", [](R r) { const FrameError* f = first_of(r, [](F e) { return e.valid; }); return f == nullptr ? kUnknown : f->t_s; }},
    {"rms_mm", "error of the position, root mean square", [](R r) { return root_mean_square(r, translation_mm); }},
    {"p95_mm", "error of the position, 95th percentile", [](R r) { return percentile(r, translation_mm); }},
    {"worst_mm", "error of the position, worst frame", [](R r) { return worst(r, translation_mm); }},
    {"rms_deg", "error of the attitude, root mean square", [](R r) { return root_mean_square(r, rotation_deg); }},
    {"p95_deg", "error of the attitude, 95th percentile", [](R r) { return percentile(r, rotation_deg); }},
    {"worst_deg", "error of the attitude, worst frame", [](R r) { return worst(r, rotation_deg); }},
    {"last_mm", "error of the position in the last frame, if its pose is valid", [](R r) { return last(r, translation_mm); }},
    {"last_deg", "error of the attitude in the last frame, if its pose is valid", [](R r) { return last(r, rotation_deg); }},
    {"nees", "normalised error squared, mean: 6 where the covariance is honest", [](R r) { return mean(r, nees_of); }},
    {"settled_invalid", "frames without a valid pose after the first 20", [](R r) { return known_or_nan(r, static_cast<double>(settled(r).invalid)); }},
    {"settled_degps", "error of the angular rate after the first 20 frames, root mean square", [](R r) { return known_or_nan(r, settled(r).rms_degps); }},
    {"settled_mmps", "error of the velocity after the first 20 frames, root mean square", [](R r) { return known_or_nan(r, settled(r).rms_mmps); }},
    {"episodes", "episodes: valid poses that are wrong, one after the other", [](R r) { return static_cast<double>(alerts(r).episodes); }},
    {"censored", "1 where the flight ended within an episode, which then lasted as long at least", [](R r) { return static_cast<double>(alerts(r).censored); }},
    {"time_to_alert_worst_s", "longest time from a wrong pose to the first frame without one; 0 where no pose is wrong", worst_time_to_alert_s},
    {"misleading", "frames with a misleading pose: valid, and farther off than its protection level in position or attitude", misleading},
    {"misleading_share", "of the valid poses, the share that is misleading", misleading_share},
    {"level_median_mm", "protection level of the position at 10^-4, median", [](R r) { return median(r, level_mm); }},
    {"level_worst_mm", "protection level of the position at 10^-4, worst frame", [](R r) { return worst(r, level_mm); }},
    {"level_median_deg", "protection level of the attitude at 10^-4, median", [](R r) { return median(r, level_deg); }},
    {"level_worst_deg", "protection level of the attitude at 10^-4, worst frame", [](R r) { return worst(r, level_deg); }},
  };
  // clang-format on
  return figures;
}

std::string cell_text(double value) {
  if (std::isnan(value)) return "";
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  static_cast<void>(error);  // the shortest text of a double has at most 24 characters
  return {text, end};
}

}  // namespace lasso::mdat
