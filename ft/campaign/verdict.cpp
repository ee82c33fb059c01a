#include "ft/campaign/verdict.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <csignal>

#include "mdat/common/errors.hpp"

namespace lasso::campaign {
namespace {

// The worst of all valid poses.
PoseVerdict judge_all(const std::vector<PoseTelemetry>& poses, const sim::Trajectory& truth) {
  PoseVerdict worst = PoseVerdict::kRight;
  for (const PoseTelemetry& pose : poses) worst = std::max(worst, judge_valid(pose, truth.at(pose.t_measurement_us).T_sensor_target));
  return worst;
}

bool equal(ConstBytes a, ConstBytes b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }

Outcome stopped(End end) {
  if (end == End::kInvariant) return Outcome::kInvariant;
  return end == End::kHang ? Outcome::kHang : Outcome::kCrash;
}

}  // namespace

End end_of(pid_t pid) {
  int status = 0;
  if (waitpid(pid, &status, 0) != pid) throw mdat::RunError("a child is lost");
  if (WIFEXITED(status)) return WEXITSTATUS(status) == 0 ? End::kDone : End::kCrash;
  if (WTERMSIG(status) == SIGABRT) return End::kInvariant;
  return WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL ? End::kHang : End::kCrash;
}

Outcome outcome(ConstBytes telemetry, ConstBytes golden, const sim::Trajectory& truth, End end) {
  const Decoded decoded = decode(telemetry);
  const PoseVerdict worst = judge_all(decoded.poses, truth);
  if (worst == PoseVerdict::kWrong) return Outcome::kSilent;
  if (end != End::kDone) return stopped(end);
  if (equal(telemetry, golden)) return Outcome::kMasked;
  const auto valid = std::count_if(decoded.poses.begin(), decoded.poses.end(), [](const PoseTelemetry& pose) { return pose.valid != 0; });
  const bool complete = decoded.broken == 0 && static_cast<std::size_t>(valid) >= decode(golden).poses.size();
  if (!complete) return Outcome::kDetected;
  return worst == PoseVerdict::kCovered ? Outcome::kCovered : Outcome::kHarmless;
}

}  // namespace lasso::campaign
