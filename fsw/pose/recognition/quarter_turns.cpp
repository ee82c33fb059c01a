#include "fsw/pose/recognition/quarter_turns.hpp"

#include "fsw/core/invariant.hpp"

namespace lasso {
namespace {

constexpr double kHalf = 0.70710678118654752;  // sine and cosine of half a quarter

// w, x, y, z: each face of the cube to the top, and the top turned.
constexpr double kFaces[6][4] = {{1, 0, 0, 0},          {0, 1, 0, 0},         {kHalf, kHalf, 0, 0},
                                 {kHalf, -kHalf, 0, 0}, {kHalf, 0, kHalf, 0}, {kHalf, 0, -kHalf, 0}};
constexpr double kTops[4][4] = {{1, 0, 0, 0}, {0, 0, 0, 1}, {kHalf, 0, 0, kHalf}, {kHalf, 0, 0, -kHalf}};

Quat to_quat(const double (&q)[4]) { return {q[0], q[1], q[2], q[3]}; }

}  // namespace

Pose quarter_turned(const Pose& T_target_sensor, std::size_t turn, const Vec3& center_m) {
  invariant(turn < kQuarterTurns, "no such quarter turn");
  const Quat q = to_quat(kFaces[turn / 4]) * to_quat(kTops[turn % 4]);
  Pose turned;
  turned.q = normalized(q * T_target_sensor.q);
  turned.p = rotate(q, T_target_sensor.p - center_m) + center_m;
  return turned;
}

}  // namespace lasso
