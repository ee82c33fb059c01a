#include "mdat/paper/stand.hpp"

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/so3.hpp"

namespace lasso::mdat {
namespace {

// Steps of the mean on the rotation group: estimates of a stand are within degrees, and each step leaves the cube of that.
constexpr int kMeanSteps = 3;

Vec3 mean_turn(std::span<const Pose> estimates, const Quat& about) {
  Vec3 sum = Vec3::Zero();
  for (const Pose& estimate : estimates) sum += log_so3(normalized(about.conjugate() * estimate.q));
  return sum / static_cast<double>(estimates.size());
}

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2 * kPi); }

}  // namespace

StandMean mean_of_stand(std::span<const Pose> estimates) {
  StandMean mean;
  mean.pose.q = estimates.front().q;
  for (int step = 0; step < kMeanSteps; ++step) mean.pose.q = normalized(mean.pose.q * exp_so3(mean_turn(estimates, mean.pose.q)));
  const auto count = static_cast<double>(estimates.size());
  for (const Pose& estimate : estimates) mean.pose.p += estimate.p / count;
  double z_m2 = 0, turn_rad2 = 0;
  for (const Pose& estimate : estimates) {
    const double z_m = estimate.p.z() - mean.pose.p.z(), turn_rad = turn_about_x(mean.pose.q, estimate.q);
    z_m2 += z_m * z_m / count;
    turn_rad2 += turn_rad * turn_rad / count;
  }
  mean.z_std_m = std::sqrt(z_m2);
  mean.turn_std_rad = std::sqrt(turn_rad2);
  return mean;
}

double turn_about_x(const Quat& from, const Quat& to) {
  const Quat turn = from.conjugate() * to;
  return wrapped(2 * std::atan2(turn.x(), turn.w()));
}

double turn_error(const Quat& from, const Quat& to, double commanded_rad) { return wrapped(turn_about_x(from, to) - commanded_rad); }

}  // namespace lasso::mdat
