#include "mdat/replay/replay.hpp"

#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

#include "fsw/mode/tracker.hpp"
#include "mdat/common/cpu_clock.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/run/statistics.hpp"

namespace lasso::mdat {
namespace {

ReplayedScan register_scan(const Mission& mission, Estimator& estimator, const RangeImage& image, const StartPoint& start) {
  ReplayedScan result;
  const double begin_us = thread_cpu_us();
  result.registration = estimator.estimate(mission, image, start);
  result.estimate_us = thread_cpu_us() - begin_us;
  return result;
}

// Tracks the scans as the flight component does, from a pose given for the first of them. Files without times, or with times that do not
// rise, follow each other by the mission's period.
class ClosedLoop {
 public:
  ClosedLoop(const Mission& mission, const Pose& initial, bool wide) : mission_(mission) {
    if (wide) mission_.parameters.wide_start = 1;
    const StartRefusal refusal = start_track(mission_, StartWay::kUplink, rough_offer(mission_.parameters, initial, Twist(), 0), 0, state_);
    if (refusal != StartRefusal::kNone) throw RunError(std::string("the tracker refused the initial pose: ") + to_string(refusal));
  }

  ReplayedScan step(const RangeImage& recorded) {
    const TimeUs recorded_us = recorded.reference_time_us();
    move_clock(recorded_us);
    ReplayedScan result;
    const double begin_us = thread_cpu_us();
    const TrackStep step =
        properties(state_.mode).scans ? track_scan(mission_, *estimator_, at_clock(recorded), state_) : no_track(recorded.scan_id, state_);
    result.estimate_us = thread_cpu_us() - begin_us;
    state_ = step.after;
    result.registration = step.registration;
    result.registration.t_us = recorded_us;
    return result;
  }

 private:
  void move_clock(TimeUs recorded_us) {
    const auto period_us = static_cast<DurationUs>(std::llround(mission_.parameters.period_s * 1e6));
    if (begun_) clock_us_ += recorded_us > last_us_ ? recorded_us - last_us_ : period_us;
    begun_ = true;
    last_us_ = recorded_us;
  }

  const RangeImage& at_clock(const RangeImage& recorded) {
    *image_ = recorded;
    const DurationUs shift_us = clock_us_ - recorded.reference_time_us();
    for (RangeSample& sample : image_->samples) sample.t_us += shift_us;
    return *image_;
  }

  Mission mission_;
  std::unique_ptr<Estimator> estimator_ = std::make_unique<Estimator>();
  std::unique_ptr<RangeImage> image_ = std::make_unique<RangeImage>();
  TrackState state_;
  TimeUs clock_us_ = 0, last_us_ = 0;
  bool begun_ = false;
};

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

ReplayInput read_replay_input(const ReplayOptions& options) {
  ReplayInput input{read_initial_poses(options.initial), sim::RecordedScans(options.scans)};
  for (std::size_t i = 0; i < input.scans.size(); ++i) {
    if (!options.closed_loop) (void)pose_of(input.poses, input.scans.stem(i), options.initial);
  }
  input.scans.check();
  return input;
}

std::vector<ReplayedScan> replay(const Mission& mission, const ReplayOptions& options, const ReplayInput& input) {
  if (options.closed_loop) {
    ClosedLoop loop(mission, input.poses.front().T_sensor_target, options.wide);
    return for_each_scan(input.scans, [&](const RangeImage& image, const std::string&) { return loop.step(image); });
  }
  const auto estimator = std::make_unique<Estimator>();
  return for_each_scan(input.scans, [&](const RangeImage& image, const std::string& stem) {
    return register_scan(mission, *estimator, image, {pose_of(input.poses, stem, options.initial), {}, options.wide});
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
