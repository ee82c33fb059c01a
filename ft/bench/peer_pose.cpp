#include "ft/bench/peer_pose.hpp"

namespace lasso::bench {

PeerPose to_peer_pose(const Pose& pose) {
  const Mat3 R = to_matrix(pose.q);
  PeerPose result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.R.at(static_cast<std::size_t>(3 * i + j)) = R(i, j);
    result.p_m.at(static_cast<std::size_t>(i)) = pose.p[i];
  }
  return result;
}

Pose from_peer_pose(const PeerPose& pose) {
  Mat3 R;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) R(i, j) = pose.R.at(static_cast<std::size_t>(3 * i + j));
  }
  return {to_quaternion(R), Vec3(pose.p_m.data())};
}

}  // namespace lasso::bench
