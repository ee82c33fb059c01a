#include "mdat/replay/replay.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include "fsw/link/choices.hpp"
#include "fsw/pose/estimator/estimator.hpp"
#include "mdat/common/cpu_clock.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/common/text.hpp"
#include "mdat/replay/closed_loop.hpp"
#include "mdat/replay/single_scans.hpp"
#include "mdat/run/statistics.hpp"

namespace lasso::mdat {
namespace {

ReplayedScan register_scan(SingleScans& scans, const RangeImage& image, const StartPoint& start) {
  ReplayedScan result;
  const double begin_us = thread_cpu_us();
  result.registration = scans.estimate(image, start);
  result.estimate_us = thread_cpu_us() - begin_us;
  return result;
}

ReplayedScan track(ClosedLoop& loop, const RangeImage& image) {
  ReplayedScan result;
  const double begin_us = thread_cpu_us();
  result.registration = loop.step(image).registration;
  result.estimate_us = thread_cpu_us() - begin_us;
  return result;
}

using Register = std::function<ReplayedScan(const RangeImage&, const std::string& stem)>;

std::vector<ReplayedScan> for_each_scan(const ReplayInput& input, const Register& registered) {
  const sim::RecordedScans& scans = input.scans;
  std::vector<ReplayedScan> results;
  ProgressBar bar("replay", scans.size(), "scans", kQuietReplay_s);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    results.push_back(registered(scans.read(i), scans.stem(i)));
    ReplayedScan& result = results.back();
    result.scan = scans.stem(i);
    result.errors = error_of(input.truth, result.scan, result.registration.T_sensor_target);
    bar.show(i + 1);
  }
  bar.finish();
  return results;
}

void append(const Notes& more, Notes& notes) { notes.insert(notes.end(), more.begin(), more.end()); }

Notes pose_notes(const std::vector<InitialPose>& poses, const std::filesystem::path& file) {
  const auto invalid = std::count_if(poses.begin(), poses.end(), [](const InitialPose& pose) { return !pose.valid; });
  if (invalid == 0) return {};
  return {format("note: %s: %td of %zu poses are not valid there; as starts they may be far off", file.c_str(), invalid, poses.size())};
}

std::string row(const ReplayedScan& scan) {
  const Registration& r = scan.registration;
  const Quat& q = r.T_sensor_target.q;
  const Vec3& p = r.T_sensor_target.p;
  const Vec6 sigma = r.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  char text[700];
  std::snprintf(text, sizeof text, "%.12g,%.12g,%.12g,%.12g,%.9g,%.9g,%.9g,%.6f,%d,%s,%d,%d,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.1f", q.x(),
                q.y(), q.z(), q.w(), p.x(), p.y(), p.z(), to_seconds(r.t_us), r.valid() ? 1 : 0, to_string(r.reason), int{r.iterations},
                int{r.inliers}, r.rms_m, sigma[3], sigma[4], sigma[5], sigma[0], sigma[1], sigma[2], scan.estimate_us);
  return scan.scan + "," + text;
}

bool has_errors(const std::vector<ReplayedScan>& scans) {
  return std::any_of(scans.begin(), scans.end(), [](const ReplayedScan& scan) { return scan.errors.has_value(); });
}

// At least one scan's true pose is there.
void check_truth(const std::filesystem::path& file, const ReplayInput& input) {
  if (file.empty()) return;
  for (std::size_t i = 0; i < input.scans.size(); ++i) {
    if (find_pose(input.truth, input.scans.stem(i)) != nullptr) return;
  }
  throw InputError(file.string() + ": no row for any scan, such as '" + input.scans.stem(0) + "'");
}

// The dictionary's.
std::string meaning_of(const std::string& reason) {
  for (const Choice& choice : kPoseReasons) {
    if (reason == choice.name) return choice.meaning;
  }
  return "unknown";
}

}  // namespace

ReplayInput read_replay_input(const ReplayOptions& options) {
  const bool search = options.initial == "search";
  ReplayInput input{
      search ? std::vector<InitialPose>() : read_initial_poses(options.initial),
      options.truth.empty() ? std::vector<InitialPose>() : read_initial_poses(options.truth),
      options.source ? sim::RecordedScans(options.source, options.frame) : sim::RecordedScans(options.scans, options.frame, options.camera),
      {}};
  for (std::size_t i = 0; i < input.scans.size(); ++i) {
    if (!search && !options.closed_loop) (void)pose_of(input.poses, input.scans.stem(i), options.initial);
  }
  check_truth(options.truth, input);
  input.facts = input.scans.survey();
  return input;
}

Notes settle_times(const ReplayOptions& options, double duration_s, ReplayInput& input) {
  const double unit_s = options.unit_s > 0 ? options.unit_s : time_unit_s(input.facts, duration_s);
  input.scans.set_time_unit(unit_s, input.facts);
  Notes notes = row_notes(input.facts);
  if (!(options.unit_s > 0)) append(time_unit_note(input.facts, duration_s, unit_s), notes);
  append(mixed_unit_notes(input.scans, input.facts, unit_s), notes);
  append(order_notes(input.scans, input.facts, unit_s), notes);
  append(pose_notes(input.poses, options.initial), notes);
  return notes;
}

std::vector<ReplayedScan> replay(const Mission& mission, const ReplayOptions& options, const ReplayInput& input) {
  if (options.closed_loop) {
    ClosedLoop loop(mission, input.poses.front().T_sensor_target, options.wide);
    return for_each_scan(input, [&](const RangeImage& image, const std::string&) { return track(loop, image); });
  }
  SingleScans singles(mission);
  return for_each_scan(input, [&](const RangeImage& image, const std::string& stem) {
    return register_scan(singles, image, {pose_of(input.poses, stem, options.initial), {}, options.wide});
  });
}

std::vector<FoundPose> judged(const std::vector<ReplayedScan>& scans) {
  std::vector<FoundPose> found;
  for (const ReplayedScan& scan : scans) {
    if (scan.registration.valid()) found.push_back({scan.scan, scan.registration.T_sensor_target});
  }
  return found;
}

std::string replay_csv(const std::vector<ReplayedScan>& scans) {
  std::string text =
      "scan,qx,qy,qz,qw,x_m,y_m,z_m,t_s,valid,reason,iterations,inliers,rms_m,sigma_x_m,sigma_y_m,sigma_z_m,sigma_rx_rad,sigma_ry_rad,"
      "sigma_rz_rad,estimate_us";
  const bool errors = has_errors(scans);
  text += errors ? std::string(kErrorColumns) + "\n" : "\n";
  for (const ReplayedScan& scan : scans) text += row(scan) + (errors ? error_fields(scan.errors) : "") + "\n";
  return text;
}

std::string replay_summary(const std::vector<ReplayedScan>& scans) {
  std::map<std::string, std::size_t> reasons;
  std::vector<double> times_us;
  std::vector<JudgedScan> judged;
  std::size_t valid = 0;
  for (const ReplayedScan& scan : scans) {
    if (scan.registration.valid()) judged.push_back({scan.scan, scan.errors});
    valid += scan.registration.valid() ? 1U : 0U;
    if (!scan.registration.valid()) ++reasons[to_string(scan.registration.reason)];
    times_us.push_back(scan.estimate_us);
  }
  const TimeStatistics time = time_statistics(times_us);
  std::string result = format("%zu of %s gave a valid pose; processor time of each: median %.0f us, 99th percentile %.0f us\n", valid,
                              amount(scans.size(), "scan").c_str(), time.median_us, time.p99_us);
  for (const auto& [reason, count] : reasons)
    result += "  not valid, " + reason + ": " + std::to_string(count) + " (" + meaning_of(reason) + ")\n";
  return result + error_summary(judged);
}

}  // namespace lasso::mdat
