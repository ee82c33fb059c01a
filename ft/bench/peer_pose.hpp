// Poses as the peers take and give them.
#pragma once

#include "fsw/geometry/se3.hpp"
#include "ft/bench/peers/peer.hpp"

namespace lasso::bench {

PeerPose to_peer_pose(const Pose& pose);
Pose from_peer_pose(const PeerPose& pose);

}  // namespace lasso::bench
