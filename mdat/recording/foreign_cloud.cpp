#include "mdat/recording/foreign_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lasso::mdat {
namespace {

using mcap::MessageValue;
using Kind = sim::ScalarType::Kind;

constexpr sim::ScalarType kTypes[] = {{Kind::kSigned, 1}, {Kind::kUnsigned, 1}, {Kind::kSigned, 2}, {Kind::kUnsigned, 2},
                                      {Kind::kSigned, 4}, {Kind::kUnsigned, 4}, {Kind::kReal, 4},   {Kind::kReal, 8}};

CloudField cloud_field(const MessageValue& value, std::uint32_t step) {
  CloudField field{
      value.at("name").get<std::string>(), value.at("offset").get<std::uint32_t>(), value.at("datatype").get<std::uint8_t>(), {}};
  if (field.datatype < 1 || field.datatype > std::size(kTypes))
    throw std::invalid_argument("field " + field.name + " is of kind " + std::to_string(int{field.datatype}) + ", expected 1 to 8");
  field.type = kTypes[field.datatype - 1];
  if (std::uint64_t{field.offset} + field.type.bytes > step)
    throw std::invalid_argument("field " + field.name + " ends beyond its point, of " + std::to_string(step) + " bytes");
  return field;
}

// Without what rows have behind their points.
std::vector<std::uint8_t> packed(const MessageValue& message, std::uint64_t width, std::uint64_t height, std::uint64_t step) {
  const auto& bytes = message.at("data").get_binary();
  const std::uint64_t row = width * step, pitch = height > 1 ? message.at("row_step").get<std::uint64_t>() : row;
  if (pitch < row || (height > 0 && bytes.size() < (height - 1) * pitch + row))
    throw std::invalid_argument("its data has " + std::to_string(bytes.size()) + " bytes, expected those of " + std::to_string(height) +
                                " x " + std::to_string(width) + " points of " + std::to_string(step));
  std::vector<std::uint8_t> data;
  for (std::uint64_t i = 0; i < height && row > 0; ++i)
    data.insert(data.end(), bytes.begin() + static_cast<std::ptrdiff_t>(i * pitch),
                bytes.begin() + static_cast<std::ptrdiff_t>(i * pitch + row));
  return data;
}

}  // namespace

const CloudField* ForeignCloud::find(const std::string& name) const {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const CloudField& field) { return field.name == name; });
  return found != fields.end() ? &*found : nullptr;
}

double ForeignCloud::value(const CloudField& field, std::size_t point) const {
  return sim::scalar_at(reinterpret_cast<const char*>(data.data()) + point * step + field.offset, field.type, big_endian);
}

bool ForeignCloud::has_place(std::size_t point) const {
  return std::isfinite(value(*find("x"), point)) && std::isfinite(value(*find("y"), point)) && std::isfinite(value(*find("z"), point));
}

ForeignCloud foreign_cloud(const MessageValue& message) {
  ForeignCloud cloud;
  const MessageValue& header = message.at("header");
  cloud.frame = header.at("frame_id").get<std::string>();
  cloud.stamp_ns = header.at("stamp").at("sec").get<std::int64_t>() * 1'000'000'000 + header.at("stamp").at("nanosec").get<std::int64_t>();
  cloud.step = message.at("point_step").get<std::uint32_t>();
  cloud.big_endian = message.at("is_bigendian").get<bool>();
  for (const MessageValue& field : message.at("fields")) {
    if (field.at("count").get<std::uint32_t>() <= 1) cloud.fields.push_back(cloud_field(field, cloud.step));
  }
  for (const char* name : {"x", "y", "z"}) {
    if (cloud.find(name) == nullptr) throw std::invalid_argument(std::string("its points have no field ") + name);
  }
  cloud.data = packed(message, message.at("width").get<std::uint64_t>(), message.at("height").get<std::uint64_t>(), cloud.step);
  cloud.points = cloud.data.size() / cloud.step;
  return cloud;
}

}  // namespace lasso::mdat
