// Who takes the messages of a run while it flies, besides its recording.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mdat/recording/ros_schemas.hpp"

namespace lasso::mdat {

struct MessageTopic {
  std::string name;
  RosSchema schema;  // ros2msg; the messages are CDR
};

// Calls come from the run's own thread, in the order of the run.
class MessageTap {
 public:
  virtual ~MessageTap() = default;
  // `topic`: of recorded_topics(), from 0.
  virtual void on_message(std::size_t topic, std::uint64_t time_ns, std::string_view bytes) = 0;
};

}  // namespace lasso::mdat
