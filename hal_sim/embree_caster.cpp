#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal_sim/ray_caster.hpp"

namespace lasso::sim {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Centre and radius of a sphere around all vertices (not the smallest one).
struct Ball {
  Vec3 center_m = Vec3::Zero();
  double radius_m = 0;
};

Ball enclosing_ball(std::span<const Vec3> vertices) {
  Vec3 low = vertices[0];
  Vec3 high = vertices[0];
  for (const Vec3& v : vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  Ball ball{(low + high) / 2, 0};
  for (const Vec3& v : vertices) ball.radius_m = std::max(ball.radius_m, (v - ball.center_m).norm());
  return ball;
}

void check_vertices(std::span<const Vec3> vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!vertices[i].allFinite()) throw std::invalid_argument("ray caster: vertex " + std::to_string(i) + " is not finite");
  }
}

Vec3 area_normal(std::span<const Vec3> v, const Triangle& t) { return (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]); }

void check_triangles(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  if (triangles.empty()) throw std::invalid_argument("ray caster: the mesh has no triangle");
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    if (std::max({t[0], t[1], t[2]}) >= vertices.size()) {
      throw std::invalid_argument("ray caster: triangle " + std::to_string(i) + " names a vertex that does not exist");
    }
    if (!(area_normal(vertices, t).norm() > 0)) throw std::invalid_argument("ray caster: triangle " + std::to_string(i) + " has no area");
  }
}

struct Plane {
  Vec3 normal;  // unit
  double offset_m;
};

std::vector<Plane> planes_of(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  std::vector<Plane> planes;
  planes.reserve(triangles.size());
  for (const auto& t : triangles) {
    const Vec3 normal = area_normal(vertices, t).normalized();
    planes.push_back({normal, normal.dot(vertices[t[0]])});
  }
  return planes;
}

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using Scene = std::unique_ptr<RTCSceneTy, SceneRelease>;

// Vertices relative to `center_m`: single precision is finest around zero.
void fill_geometry(RTCGeometry geometry, std::span<const Vec3> vertices, std::span<const Triangle> triangles, const Vec3& center_m) {
  void* const v = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices.size());
  void* const t =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles.size());
  if (v == nullptr || t == nullptr) throw std::runtime_error("ray caster: no memory for the mesh");
  auto* coordinate = static_cast<float*>(v);
  for (const Vec3& vertex : vertices) {
    for (int axis = 0; axis < 3; ++axis) *coordinate++ = static_cast<float>(vertex[axis] - center_m[axis]);
  }
  std::copy(triangles.begin(), triangles.end(), static_cast<Triangle*>(t));
}

Scene build_scene(RTCDevice device, std::span<const Vec3> vertices, std::span<const Triangle> triangles, const Vec3& center_m) {
  Scene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  fill_geometry(geometry, vertices, triangles, center_m);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error("ray caster: Embree could not build the scene");
  return scene;
}

RTCRayHit single_precision_ray(const Vec3& origin, const Vec3& direction) {
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(origin.x());
  query.ray.org_y = static_cast<float>(origin.y());
  query.ray.org_z = static_cast<float>(origin.z());
  query.ray.dir_x = static_cast<float>(direction.x());
  query.ray.dir_y = static_cast<float>(direction.y());
  query.ray.dir_z = static_cast<float>(direction.z());
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

class EmbreeCaster final : public RayCaster {
 public:
  EmbreeCaster(std::span<const Vec3> vertices, std::span<const Triangle> triangles, std::span<const LaserReflection> reflections)
      : ball_(enclosing_ball(vertices)),
        planes_(planes_of(vertices, triangles)),
        reflections_(reflections.begin(), reflections.end()),
        device_(rtcNewDevice("threads=1,isa=sse2")) {
    if (!device_) throw std::runtime_error("ray caster: Embree gives no device");
    scene_ = build_scene(device_.get(), vertices, triangles, ball_.center_m);
  }

  RayHit cast(const Vec3& origin_m, const Vec3& direction) const override {
    if (passes_by(origin_m, direction)) return {};
    const double skipped_m = skipped(origin_m, direction);
    RTCRayHit query = single_precision_ray(origin_m - ball_.center_m + skipped_m * direction, direction);
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const Plane& plane = planes_[query.hit.primID];
    return {true, exact_range(plane, origin_m, direction, skipped_m + static_cast<double>(query.ray.tfar)), query.hit.primID, plane.normal,
            reflections_.empty() ? nullptr : &reflections_[query.hit.primID]};
  }

  bool is_blocked(const Vec3& origin_m, const Vec3& direction) const override {
    if (passes_by(origin_m, direction)) return false;
    RTCRayHit query = single_precision_ray(origin_m - ball_.center_m + skipped(origin_m, direction) * direction, direction);
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_.get(), &context, &query.ray);
    return query.ray.tfar < 0;
  }

 private:
  // The search starts where the ray enters the ball, so that a distant origin does not coarsen its single-precision coordinates.
  double skipped(const Vec3& origin_m, const Vec3& direction) const {
    return std::max(0.0, (ball_.center_m - origin_m).dot(direction) - 1.01 * ball_.radius_m);
  }

  // Whether the ray is clear of the ball: most rays are, of the smaller bodies of a scene.
  bool passes_by(const Vec3& origin_m, const Vec3& direction) const {
    const Vec3 to_center = ball_.center_m - origin_m;
    const double ahead_m = to_center.dot(direction), reach_m = 1.01 * ball_.radius_m;
    return ahead_m < -reach_m || (to_center - ahead_m * direction).squaredNorm() > reach_m * reach_m;
  }

  // The plane's range, unless the ray all but lies in the plane: then the search's own range is the better conditioned one.
  double exact_range(const Plane& plane, const Vec3& origin_m, const Vec3& direction, double found_m) const {
    const double range_m = (plane.offset_m - plane.normal.dot(origin_m)) / plane.normal.dot(direction);
    return std::abs(range_m - found_m) <= 1e-3 * ball_.radius_m ? range_m : found_m;
  }

  Ball ball_;
  std::vector<Plane> planes_;
  std::vector<LaserReflection> reflections_;  // of the triangles, or none
  Device device_;
  Scene scene_;
};

}  // namespace

std::unique_ptr<RayCaster> make_ray_caster(std::span<const Vec3> vertices_m, std::span<const Triangle> triangles,
                                           std::span<const LaserReflection> reflections) {
  check_vertices(vertices_m);
  check_triangles(vertices_m, triangles);
  if (!reflections.empty() && reflections.size() != triangles.size())
    throw std::invalid_argument("ray caster: " + std::to_string(reflections.size()) + " reflections of " +
                                std::to_string(triangles.size()) + " triangles");
  return std::make_unique<EmbreeCaster>(vertices_m, triangles, reflections);
}

}  // namespace lasso::sim
