#include "mdat/modelc/embree_scene.hpp"

#include <limits>

#include "mdat/modelc/compile_error.hpp"

namespace lasso::mdat {

EmbreeScene::EmbreeScene() : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void EmbreeScene::attach(RTCGeometry geometry) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
}

void EmbreeScene::add_triangles(const Surface& surface) {
  const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  std::vector<std::array<std::uint32_t, 3>> kept;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.sliver[t] == 0) kept.push_back(surface.triangles[t]);
  }
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), surface.vertices.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), kept.size()));
  if (vertices == nullptr || indices == nullptr) fail("no memory for ", kept.size(), " triangles");
  for (const Vec3d& v : surface.vertices) {
    for (int i = 0; i < 3; ++i) *vertices++ = static_cast<float>(v[i]);
  }
  for (const auto& triangle : kept) indices = std::copy(triangle.begin(), triangle.end(), indices);
  attach(geometry);
}

void EmbreeScene::add_user(unsigned count, RTCBoundsFunction bounds, RTCPointQueryFunction query, void* user) {
  const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, count);
  rtcSetGeometryUserData(geometry, user);
  rtcSetGeometryBoundsFunction(geometry, bounds, user);
  rtcSetGeometryPointQueryFunction(geometry, query);
  attach(geometry);
}

void EmbreeScene::commit() {
  rtcCommitScene(scene_);
  const RTCError error = rtcGetDeviceError(device_);
  if (error != RTC_ERROR_NONE) fail("the search structure could not be built (Embree error ", static_cast<int>(error), ")");
}

namespace {

RTCRay make_ray(const Vec3d& from, const Vec3d& direction) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(from.x());
  ray.org_y = static_cast<float>(from.y());
  ray.org_z = static_cast<float>(from.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0u;
  return ray;
}

}  // namespace

bool EmbreeScene::escapes(const Vec3d& from, const Vec3d& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(from, direction);
  rtcOccluded1(scene_, &context, &ray);
  return ray.tfar >= 0;
}

double EmbreeScene::first_hit(const Vec3d& from, const Vec3d& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray{};
  ray.ray = make_ray(from, direction);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_, &context, &ray);
  return static_cast<double>(ray.ray.tfar);
}

}  // namespace lasso::mdat
