// Packets of the dictionary as ROS 2 messages, by its rows: a topic and a definition for each packet of telemetry.
#pragma once

#include <string>
#include <vector>

#include "fsw/core/time.hpp"
#include "mdat/link/decode.hpp"
#include "mdat/recording/ros_schemas.hpp"

namespace lasso::mdat {

// Those that have a topic: all of telemetry, events among them, in the dictionary's order.
const std::vector<const PacketRow*>& told_packets();

// "/telemetry/mode_changed".
std::string packet_topic(const PacketRow& packet);

// "lasso_msgs/msg/ModeChanged": a header, whose stamp is the boundary at which the packet left the component; the packet's sequence_count;
// then its items by their names and types. The values of an enumeration are constants before its item, such as MODE_TRACKING.
RosSchema packet_schema(const PacketRow& packet);

// The message of a packet that the dictionary knows.
std::string packet_message(TimeUs boundary_us, const DecodedPacket& packet);

}  // namespace lasso::mdat
