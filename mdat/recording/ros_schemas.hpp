// The definitions of the messages that recordings hold, as ROS 2 writes them (interface definitions of common_interfaces, and of
// foxglove_msgs for /scene): a reader that knows none of them decodes by these.
#pragma once

#include <string>

namespace lasso::mdat {

struct RosSchema {
  std::string name;  // "package/msg/Type"
  std::string text;  // its fields, and the definitions that these need (encoding "ros2msg")
};

namespace ros {

// Of a message that has these fields, one a line; `name`: "package/Type". Its definitions are those of the fields' types, which this file
// knows.
RosSchema schema_with(const std::string& name, const std::string& fields);

RosSchema tf_message();            // tf2_msgs
RosSchema point_cloud();           // sensor_msgs/PointCloud2
RosSchema compressed_image();      // sensor_msgs/CompressedImage
RosSchema camera_info();           // sensor_msgs/CameraInfo
RosSchema pose_stamped();          // geometry_msgs
RosSchema pose_array();            // geometry_msgs/PoseArray
RosSchema pose_with_covariance();  // geometry_msgs/PoseWithCovarianceStamped
RosSchema odometry();              // nav_msgs
RosSchema log();                   // rcl_interfaces
RosSchema scene_update();          // foxglove_msgs
RosSchema packet();                // lasso_msgs/Packet: a CCSDS packet as it was received

}  // namespace ros
}  // namespace lasso::mdat
