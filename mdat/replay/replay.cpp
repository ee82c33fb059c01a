#include "mdat/replay/replay.hpp"

#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

#include "fsw/pose/estimator.hpp"
#include "fsw/pose/filter.hpp"
#include "hal_sim/scan_file.hpp"
#include "mdat/common/cpu_clock.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/replay/initial_poses.hpp"
#include "mdat/run/statistics.hpp"

namespace lasso::mdat {
namespace {

// The track of a closed loop: the initial pose until a scan confirms it, then the filter.
class Track {
 public:
  Track(const Mission& mission, const Pose& initial) : parameters_(mission.parameters) { initial_.T_sensor_target = initial; }

  // Moves to the next scan and gives its starting point.
  StartPoint next(TimeUs reference_us) {
    const auto period_us = static_cast<DurationUs>(std::llround(parameters_.period_s * 1e6));
    if (begun_) now_us_ += reference_us > last_us_ ? reference_us - last_us_ : period_us;
    begun_ = true;
    last_us_ = reference_us;
    if (!filter_.initialised) return {initial_.T_sensor_target, {}, parameters_.wide_start != 0};
    const FilterNoise noise{parameters_.acceleration_mps2, parameters_.angular_acceleration_radps2};
    expect(predict_filter(filter_, now_us_, noise));
    return {filter_.T_sensor_target, filter_.rates, false};
  }

  void join(const Registration& result) {
    invalid_ = result.valid() ? 0 : invalid_ + 1;
    if (!result.valid()) return;
    if (filter_.initialised) {
      expect(update_filter(filter_, {now_us_, result.T_sensor_target, result.covariance}, kNoGate).status);
    } else {
      expect(start_filter(
          filter_,
          {now_us_, result.T_sensor_target, {}, result.covariance, parameters_.initial_angular_rate_radps, parameters_.initial_rate_mps}));
    }
  }

  bool lost() const { return invalid_ > parameters_.coast_frames; }

 private:
  static void expect(Status status) {
    if (status != Status::kOk) throw RunError(std::string("the filter refused a step: ") + to_string(status));
  }

  const MissionParameters& parameters_;
  StartPoint initial_;
  FilterState filter_;
  TimeUs now_us_ = 0, last_us_ = 0;
  bool begun_ = false;
  int invalid_ = 0;  // in a row
};

ReplayedScan register_scan(const Mission& mission, Estimator& estimator, const RangeImage& image, const StartPoint& start) {
  ReplayedScan result;
  const double begin_us = thread_cpu_us();
  result.registration = estimator.estimate(mission, image, start);
  result.estimate_us = thread_cpu_us() - begin_us;
  return result;
}

ReplayedScan without_track(const RangeImage& image, const Pose& last) {
  ReplayedScan result;
  result.registration.T_sensor_target = last;
  result.registration.t_us = image.reference_time_us();
  return result;  // its reason is kNoTrack
}

using Register = std::function<ReplayedScan(const RangeImage&, const std::string& stem)>;

std::vector<ReplayedScan> for_each_scan(const sim::RecordedScans& scans, const Register& registered) {
  std::vector<ReplayedScan> results;
  ProgressBar bar("replay", scans.size(), "scans");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    results.push_back(registered(scans.read(i), scans.stem(i)));
    results.back().scan = scans.stem(i);
    bar.show(i + 1);
  }
  bar.finish();
  return results;
}

std::string row(const ReplayedScan& scan) {
  const Registration& r = scan.registration;
  const Quat& q = r.T_sensor_target.q;
  const Vec3& p = r.T_sensor_target.p;
  const Vec6 sigma = r.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  char text[700];
  std::snprintf(text, sizeof text, "%.12g,%.12g,%.12g,%.12g,%.9g,%.9g,%.9g,%.6f,%d,%s,%d,%d,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.1f\n",
                q.x(), q.y(), q.z(), q.w(), p.x(), p.y(), p.z(), to_seconds(r.t_us), r.valid() ? 1 : 0, to_string(r.reason),
                int{r.iterations}, int{r.inliers}, r.rms_m, sigma[3], sigma[4], sigma[5], sigma[0], sigma[1], sigma[2], scan.estimate_us);
  return scan.scan + "," + text;
}

}  // namespace

std::vector<ReplayedScan> replay(const Mission& mission, const ReplayOptions& options) {
  const std::vector<InitialPose> poses = read_initial_poses(options.initial);
  const sim::RecordedScans scans(options.scans);
  const auto estimator = std::make_unique<Estimator>();
  if (!options.closed_loop) {
    for (std::size_t i = 0; i < scans.size(); ++i) (void)pose_of(poses, scans.stem(i), options.initial);  // before any work
    return for_each_scan(scans, [&](const RangeImage& image, const std::string& stem) {
      return register_scan(mission, *estimator, image, {pose_of(poses, stem, options.initial), {}, options.wide});
    });
  }
  Track track(mission, poses.front().T_sensor_target);
  Pose last = poses.front().T_sensor_target;
  return for_each_scan(scans, [&](const RangeImage& image, const std::string&) {
    if (track.lost()) return without_track(image, last);
    StartPoint start = track.next(image.reference_time_us());
    start.wide = start.wide || options.wide;
    const ReplayedScan result = register_scan(mission, *estimator, image, start);
    track.join(result.registration);
    last = result.registration.T_sensor_target;
    return result;
  });
}

std::string replay_csv(const std::vector<ReplayedScan>& scans) {
  std::string text =
      "scan,qx,qy,qz,qw,x_m,y_m,z_m,t_s,valid,reason,iterations,inliers,rms_m,sigma_x_m,sigma_y_m,sigma_z_m,sigma_rx_rad,sigma_ry_rad,"
      "sigma_rz_rad,estimate_us\n";
  for (const ReplayedScan& scan : scans) text += row(scan);
  return text;
}

std::string replay_summary(const std::vector<ReplayedScan>& scans) {
  std::map<std::string, std::size_t> reasons;
  std::vector<double> times_us;
  std::size_t valid = 0;
  for (const ReplayedScan& scan : scans) {
    valid += scan.registration.valid() ? 1U : 0U;
    if (!scan.registration.valid()) ++reasons[to_string(scan.registration.reason)];
    times_us.push_back(scan.estimate_us);
  }
  const TimeStatistics time = time_statistics(times_us);
  char text[160];
  std::snprintf(text, sizeof text, "%zu of %zu scans gave a valid pose; time of an estimate: median %.0f us, 99th percentile %.0f us\n",
                valid, scans.size(), time.median_us, time.p99_us);
  std::string result = text;
  for (const auto& [reason, count] : reasons) result += "  not valid, " + reason + ": " + std::to_string(count) + "\n";
  return result;
}

}  // namespace lasso::mdat
