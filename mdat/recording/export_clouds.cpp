#include <cstdio>
#include <stdexcept>

#include "mdat/common/errors.hpp"
#include "mdat/mcap/bytes.hpp"
#include "mdat/recording/foreign_cloud.hpp"
#include "mdat/recording/recording_export.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlyTypes[] = {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"};

// Points that have a place, as they lie in the message, but without what lies between their fields and with the low byte first.
std::string point_bytes(const ForeignCloud& cloud, std::size_t& points) {
  std::string bytes;
  points = 0;
  for (std::size_t i = 0; i < cloud.points; ++i) {
    if (!cloud.has_place(i)) continue;
    ++points;
    for (const CloudField& field : cloud.fields) {
      const std::uint8_t* const at = cloud.data.data() + i * cloud.step + field.offset;
      std::string value(reinterpret_cast<const char*>(at), field.type.bytes);
      if (cloud.big_endian) value.assign(value.rbegin(), value.rend());
      bytes += value;
    }
  }
  return bytes;
}

std::string seconds(std::int64_t ns) {
  char text[40];
  (void)std::snprintf(text, sizeof text, "%.9f", static_cast<double>(ns) * 1e-9);
  return text;
}

std::string ply_of(const ForeignCloud& cloud) {
  std::size_t points = 0;
  const std::string bytes = point_bytes(cloud, points);
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment frame " + cloud.frame + ", at " + seconds(cloud.stamp_ns) +
                     " s\nelement vertex " + std::to_string(points) + "\n";
  for (const CloudField& field : cloud.fields) text += "property " + std::string(kPlyTypes[field.datatype - 1]) + " " + field.name + "\n";
  return text + "end_header\n" + bytes;
}

std::string pcd_of(const ForeignCloud& cloud) {
  constexpr const char* kKinds = "IUF";
  std::size_t points = 0;
  const std::string bytes = point_bytes(cloud, points);
  std::string names = "FIELDS", sizes = "SIZE", types = "TYPE", counts = "COUNT";
  for (const CloudField& field : cloud.fields) {
    const int kind = field.type.kind == sim::ScalarType::Kind::kReal ? 2 : field.type.kind == sim::ScalarType::Kind::kUnsigned ? 1 : 0;
    names += " " + field.name;
    sizes += " " + std::to_string(field.type.bytes);
    types += std::string(" ") + kKinds[kind];
    counts += " 1";
  }
  const std::string number = std::to_string(points);
  return "# frame " + cloud.frame + ", at " + seconds(cloud.stamp_ns) + " s\nVERSION 0.7\n" + names + "\n" + sizes + "\n" + types + "\n" +
         counts + "\nWIDTH " + number + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + number + "\nDATA binary\n" + bytes;
}

ExportedFiles export_clouds(const fs::path& file, const ExportOptions& options, const std::string& extension,
                            std::string (*text_of)(const ForeignCloud&)) {
  const std::string topic = choose_topic(file, options.topic, {"sensor_msgs/msg/PointCloud2"}, "/scan");
  ExportedFiles result;
  (void)read_topics(
      file, options.span, [&](const TopicName& name) { return name.topic == topic; },
      [&](const TopicMessage& message) {
        char name[40];
        (void)std::snprintf(name, sizeof name, "scan%05zu", result.files.size());
        try {
          result.files[name + extension] = text_of(foreign_cloud(message.value));
        } catch (const std::invalid_argument& error) {
          throw InputError(file.string() + ": " + topic + ", at " + seconds(static_cast<std::int64_t>(message.t_ns)) +
                           " s: " + error.what());
        }
      });
  if (result.files.empty()) throw InputError(file.string() + ": " + topic + ": no message in this span");
  return result;
}

}  // namespace

ExportedFiles export_ply(const fs::path& file, const ExportOptions& options) { return export_clouds(file, options, ".ply", ply_of); }
ExportedFiles export_pcd(const fs::path& file, const ExportOptions& options) { return export_clouds(file, options, ".pcd", pcd_of); }

}  // namespace lasso::mdat
