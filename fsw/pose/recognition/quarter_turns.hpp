// The poses that a start is most easily mistaken for: axes that are named or signed otherwise turn it by quarters.
#pragma once

#include "fsw/geometry/se3.hpp"

namespace lasso {

constexpr std::size_t kQuarterTurns = 24;  // of a cube onto itself, none included

// T_target_sensor of a pose to that of the same one turned about the target's axes through `center_m` (target frame). turn < kQuarterTurns;
// 0 is none.
Pose quarter_turned(const Pose& T_target_sensor, std::size_t turn, const Vec3& center_m);

}  // namespace lasso
