// The target's surface as binary glTF 2.0 (Khronos): triangles with flat normals, in the target's own frame, metres.
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "mdat/serve/answers.hpp"
#include "mdat/serve/bits.hpp"

namespace lasso::mdat::serve {
namespace {

using Json = nlohmann::ordered_json;
using Point = std::array<float, 3>;

constexpr std::uint32_t kGlbMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kFloat = 5126, kArrayBuffer = 34962;

Point normal_of(const Point& a, const Point& b, const Point& c) {
  const double u[3] = {double(b[0]) - double(a[0]), double(b[1]) - double(a[1]), double(b[2]) - double(a[2])};
  const double v[3] = {double(c[0]) - double(a[0]), double(c[1]) - double(a[1]), double(c[2]) - double(a[2])};
  const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) return {0, 0, 1};
  return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length), static_cast<float>(n[2] / length)};
}

struct Corners {
  std::vector<Point> points, normals;
  Point low{}, high{};
};

Corners corners_of(const SurfaceTriangles& surface) {
  Corners corners;
  for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    const Point a = surface.points[surface.indices[i]], b = surface.points[surface.indices[i + 1]],
                c = surface.points[surface.indices[i + 2]];
    corners.points.insert(corners.points.end(), {a, b, c});
    corners.normals.insert(corners.normals.end(), 3, normal_of(a, b, c));
  }
  corners.low = corners.high = corners.points.front();
  for (const Point& point : corners.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      corners.low[i] = std::min(corners.low[i], point[i]);
      corners.high[i] = std::max(corners.high[i], point[i]);
    }
  }
  return corners;
}

Json accessor(int view, const Corners& corners) {
  return {{"bufferView", view}, {"componentType", kFloat}, {"count", corners.points.size()}, {"type", "VEC3"}};
}

Json buffer_view(std::size_t offset, std::size_t size) {
  return {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}, {"target", kArrayBuffer}};
}

std::string scene_json(const Corners& corners) {
  const std::size_t size = corners.points.size() * sizeof(Point);
  Json positions = accessor(0, corners);
  positions["min"] = corners.low;
  positions["max"] = corners.high;
  const Json primitive = {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"mode", 4}};
  const Json json = {{"asset", {{"version", "2.0"}, {"generator", "mdat"}}},
                     {"scene", 0},
                     {"scenes", Json::array({{{"nodes", Json::array({0})}}})},
                     {"nodes", Json::array({{{"name", "target"}, {"mesh", 0}}})},
                     {"meshes", Json::array({{{"primitives", Json::array({primitive})}}})},
                     {"accessors", Json::array({positions, accessor(1, corners)})},
                     {"bufferViews", Json::array({buffer_view(0, size), buffer_view(size, size)})},
                     {"buffers", Json::array({{{"byteLength", 2 * size}}})}};
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return text;
}

void put_chunk(std::uint32_t type, const std::string& content, std::string& bytes) {
  mcap::put(static_cast<std::uint32_t>(content.size()), bytes);
  mcap::put(type, bytes);
  bytes += content;
}

}  // namespace

Response model_answer(const Shown& shown) {
  const std::optional<SurfaceTriangles> surface = read_surface(shown.recording->first_message("/scene"));
  if (!surface || surface->indices.empty())
    throw Refusal{404, "this recording holds no surface of the target", "record it with mdat run --record"};
  return surface_answer(*surface);
}

Response surface_answer(const SurfaceTriangles& surface) {
  const Corners corners = corners_of(surface);
  std::string binary, chunks, bytes;
  put_all(corners.points, binary);
  put_all(corners.normals, binary);
  put_chunk(kJsonChunk, scene_json(corners), chunks);
  put_chunk(kBinaryChunk, binary, chunks);
  constexpr std::uint32_t kVersion2 = 2, kHead = 12;
  mcap::put(kGlbMagic, bytes);
  mcap::put(kVersion2, bytes);
  mcap::put(static_cast<std::uint32_t>(chunks.size() + kHead), bytes);
  Response response = binary_response(bytes + chunks);
  response.type = "model/gltf-binary";
  return response;
}

}  // namespace lasso::mdat::serve
