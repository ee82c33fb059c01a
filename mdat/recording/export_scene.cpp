#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fsw/geometry/se3.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/mcap/bytes.hpp"
#include "mdat/recording/foreign_cloud.hpp"
#include "mdat/recording/recording_export.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;
using mcap::MessageValue;
using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kUint32 = 5125, kUint8 = 5121;  // component types of glTF
constexpr int kPointsMode = 0;

// What a frame looks like.
struct SceneFrame {
  MessageValue scan, missed, transforms;
  std::uint64_t t_ns = 0;
  std::vector<MessageValue> surfaces;  // entities of the scenes so far
};

// A glTF file that grows: accessors into one buffer.
class GlbFile {
 public:
  GlbFile()
      : json_({{"asset", {{"version", "2.0"}, {"generator", "mdat"}}}, {"scene", 0}, {"scenes", Json::array()}, {"nodes", Json::array()}}) {
    // Its y axis is down, and glTF's up: half a turn about x.
    json_["nodes"].push_back({{"name", "sensor"}, {"rotation", {1, 0, 0, 0}}, {"children", Json::array()}});
    json_["scenes"].push_back({{"nodes", {0}}});
  }

  template <class T>
  std::size_t add(const std::vector<T>& values, int component, const char* type, std::size_t width) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size() * sizeof(T)}});
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    Json accessor = {
        {"bufferView", json_["bufferViews"].size() - 1}, {"componentType", component}, {"count", values.size() / width}, {"type", type}};
    if (component == kUint8) accessor["normalized"] = true;
    json_["accessors"].push_back(accessor);
    return json_["accessors"].size() - 1;
  }

  // Positions have to say their extent.
  std::size_t add_places(const std::vector<float>& places) {
    const std::size_t accessor = add(places, kFloat, "VEC3", 3);
    Json low = Json::array(), high = Json::array();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float least = std::numeric_limits<float>::max(), most = std::numeric_limits<float>::lowest();
      for (std::size_t i = axis; i < places.size(); i += 3) {
        least = std::min(least, places[i]);
        most = std::max(most, places[i]);
      }
      low.push_back(least);
      high.push_back(most);
    }
    json_["accessors"][accessor]["min"] = low;
    json_["accessors"][accessor]["max"] = high;
    return accessor;
  }

  void add_node(const std::string& name, const Json& primitive, const Pose& pose) {
    json_["meshes"].push_back({{"primitives", {primitive}}});
    const Quat& q = pose.q;
    json_["nodes"].push_back({{"name", name},
                              {"mesh", json_["meshes"].size() - 1},
                              {"translation", {pose.p.x(), pose.p.y(), pose.p.z()}},
                              {"rotation", {q.x(), q.y(), q.z(), q.w()}}});
    json_["nodes"][0]["children"].push_back(json_["nodes"].size() - 1);
  }

  std::size_t add_material(const MessageValue& color) {
    const Json factor = {color.at("r"), color.at("g"), color.at("b"), color.at("a")};
    const bool clear = color.at("a").get<double>() < 1;
    json_["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorFactor", factor}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}}},
                                  {"alphaMode", clear ? "BLEND" : "OPAQUE"},
                                  {"doubleSided", true}});
    return json_["materials"].size() - 1;
  }

  std::string bytes() {
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    json_["buffers"].push_back({{"byteLength", bytes_.size()}});
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string file("glTF");
    mcap::put(std::uint32_t{2}, file);
    mcap::put(static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + bytes_.size()), file);
    mcap::put(static_cast<std::uint32_t>(text.size()), file);
    file += "JSON" + text;
    mcap::put(static_cast<std::uint32_t>(bytes_.size()), file);
    return file + std::string("BIN\0", 4) + bytes_;
  }

 private:
  Json json_;
  std::string bytes_;
};

Vec3 vector_in(const MessageValue& value) {
  return {value.at("x").get<double>(), value.at("y").get<double>(), value.at("z").get<double>()};
}

// The pose of a frame in the root of its tree; unknown ones are at it.
Pose in_root(const MessageValue& transforms, std::string frame) {
  constexpr int kDeepest = 32;
  Pose T_root_frame;
  for (int depth = 0; depth < kDeepest; ++depth) {
    const auto found = std::find_if(transforms.begin(), transforms.end(), [&](const MessageValue& transform) {
      return transform.at("child_frame_id").get<std::string>() == frame;
    });
    if (found == transforms.end()) return T_root_frame;
    const MessageValue& q = found->at("transform").at("rotation");
    const Pose T_parent_frame{Quat(q.at("w").get<double>(), q.at("x").get<double>(), q.at("y").get<double>(), q.at("z").get<double>()),
                              vector_in(found->at("transform").at("translation"))};
    T_root_frame = T_parent_frame * T_root_frame;
    frame = found->at("header").at("frame_id").get<std::string>();
  }
  return T_root_frame;
}

// Blue where the range is too short, red where too long, white at none; full at three times the root mean square.
std::vector<std::uint8_t> residual_colors(const std::vector<double>& residuals_m) {
  double sum = 0;
  std::size_t known = 0;
  for (const double residual_m : residuals_m) {
    if (!std::isfinite(residual_m)) continue;
    sum += residual_m * residual_m;
    ++known;
  }
  const double full_m = known > 0 && sum > 0 ? 3 * std::sqrt(sum / static_cast<double>(known)) : 1;
  std::vector<std::uint8_t> colors;
  for (const double residual_m : residuals_m) {
    const double share = std::isfinite(residual_m) ? std::clamp(residual_m / full_m, -1.0, 1.0) : 0;
    const auto faded = static_cast<std::uint8_t>(std::lround(255 * (1 - std::abs(share))));
    const std::uint8_t red = share < 0 ? faded : 255, blue = share > 0 ? faded : 255;
    colors.insert(colors.end(), {red, faded, blue, 255});
  }
  return colors;
}

void add_cloud(const MessageValue& message, const std::string& name, GlbFile& glb) {
  const ForeignCloud cloud = foreign_cloud(message);
  const CloudField* const residual = cloud.find("residual");
  std::vector<float> places;
  std::vector<double> residuals_m;
  for (std::size_t i = 0; i < cloud.points; ++i) {
    if (!cloud.has_place(i)) continue;
    for (const char* axis : {"x", "y", "z"}) places.push_back(static_cast<float>(cloud.value(*cloud.find(axis), i)));
    if (residual != nullptr) residuals_m.push_back(cloud.value(*residual, i));
  }
  if (places.empty()) return;
  Json primitive = {{"mode", kPointsMode}, {"attributes", {{"POSITION", glb.add_places(places)}}}};
  if (residual != nullptr) primitive["attributes"]["COLOR_0"] = glb.add(residual_colors(residuals_m), kUint8, "VEC4", 4);
  glb.add_node(name, primitive, Pose{});
}

void add_surface(const MessageValue& entity, const Pose& T_scan_root, const SceneFrame& frame, GlbFile& glb) {
  for (const MessageValue& triangles : entity.at("triangles")) {
    std::vector<float> places;
    for (const MessageValue& point : triangles.at("points")) {
      for (const char* axis : {"x", "y", "z"}) places.push_back(static_cast<float>(point.at(axis).get<double>()));
    }
    if (places.empty()) continue;
    Json primitive = {{"attributes", {{"POSITION", glb.add_places(places)}}}, {"material", glb.add_material(triangles.at("color"))}};
    const auto indices = triangles.at("indices").get<std::vector<std::uint32_t>>();
    if (!indices.empty()) primitive["indices"] = glb.add(indices, kUint32, "SCALAR", 1);
    glb.add_node(entity.at("id").get<std::string>(), primitive,
                 T_scan_root * in_root(frame.transforms, entity.at("frame_id").get<std::string>()));
  }
}

bool is_of_scene(const TopicName& name) {
  return name.schema == "foxglove_msgs/msg/SceneUpdate" || name.schema == "tf2_msgs/msg/TFMessage";
}

void add_to_scene(const TopicMessage& message, SceneFrame& frame) {
  if (message.schema == "tf2_msgs/msg/TFMessage") frame.transforms = message.value.at("transforms");
  if (message.schema != "foxglove_msgs/msg/SceneUpdate") return;
  for (const MessageValue& entity : message.value.at("entities")) frame.surfaces.push_back(entity);
}

SceneFrame frame_of(const fs::path& file, const ExportOptions& options, const std::string& topic) {
  SceneFrame frame;
  const auto done = [&](std::uint64_t t_ns) { return frame.t_ns != 0 && t_ns > frame.t_ns; };
  const auto wanted = [&](const TopicName& name) { return is_of_scene(name) || name.topic == topic || name.topic == "/rays_missed"; };
  const auto take_scan = [&](const TopicMessage& message) {
    if (!options.span.holds(message.t_ns) || frame.t_ns != 0) return;
    frame.scan = message.value;
    frame.t_ns = message.t_ns;
  };
  (void)read_topics(file, {0, options.span.end_ns}, wanted, [&](const TopicMessage& message) {
    if (done(message.t_ns)) return;
    if (is_of_scene({message.topic, message.schema})) return add_to_scene(message, frame);
    if (message.topic != "/rays_missed") return take_scan(message);
    if (message.t_ns == frame.t_ns) frame.missed = message.value;
  });
  if (frame.t_ns == 0) throw InputError(file.string() + ": " + topic + ": no scan in this span");
  return frame;
}

}  // namespace

std::string export_glb(const fs::path& file, const ExportOptions& options) {
  const std::string topic = choose_topic(file, options.topic, {"sensor_msgs/msg/PointCloud2"}, "/scan");
  const SceneFrame frame = frame_of(file, options, topic);
  GlbFile glb;
  try {
    add_cloud(frame.scan, "scan", glb);
    if (!frame.missed.is_null()) add_cloud(frame.missed, "rays that missed", glb);
    const Pose T_scan_root = inverse(in_root(frame.transforms, frame.scan.at("header").at("frame_id").get<std::string>()));
    for (const MessageValue& entity : frame.surfaces) add_surface(entity, T_scan_root, frame, glb);
  } catch (const std::invalid_argument& error) {
    throw InputError(file.string() + ": " + topic + ": " + error.what());
  }
  return glb.bytes();
}

}  // namespace lasso::mdat
