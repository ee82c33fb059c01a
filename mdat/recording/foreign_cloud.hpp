// sensor_msgs/PointCloud2 of any program: its points' fields by their names.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal_sim/scan_text.hpp"
#include "mdat/mcap/message_value.hpp"

namespace lasso::mdat {

struct CloudField {
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 0;  // 1 int8 to 8 float64, as in sensor_msgs/PointField
  sim::ScalarType type;
};

struct ForeignCloud {
  std::string frame;
  std::int64_t stamp_ns = 0;       // seconds of a stamp have a sign
  std::vector<CloudField> fields;  // of one element each: others are left out
  std::uint32_t step = 0;          // bytes of a point
  std::size_t points = 0;
  bool big_endian = false;
  std::vector<std::uint8_t> data;  // points one behind the other

  const CloudField* find(const std::string& name) const;
  double value(const CloudField& field, std::size_t point) const;
  // x, y and z are numbers.
  bool has_place(std::size_t point) const;
};

// Throws std::invalid_argument: a field beyond its point, data shorter than its points, no x, y or z.
ForeignCloud foreign_cloud(const mcap::MessageValue& message);

}  // namespace lasso::mdat
