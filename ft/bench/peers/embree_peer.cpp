// Closest point on the exact mesh by Embree's point query: the fastest exact search that Debian packages.
#include <embree3/rtcore.h>

#include <stdexcept>

#include "ft/bench/peers/point_to_plane.hpp"

namespace lasso::bench {
namespace {

using Float3 = Eigen::Vector3f;

// A triangle ready for the closest-point test, one cache line.
struct alignas(64) Facet {
  Float3 a, ab, ac, normal;
};

// Ericson, Real-Time Collision Detection (2005), 5.1.5: the Voronoi region of the triangle that the point lies in.
Float3 closest_point(const Facet& f, const Float3& p) {
  const Float3 ap = p - f.a;
  const float d1 = f.ab.dot(ap), d2 = f.ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return f.a;
  const Float3 bp = ap - f.ab;
  const float d3 = f.ab.dot(bp), d4 = f.ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return f.a + f.ab;
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return f.a + d1 / (d1 - d3) * f.ab;
  const Float3 cp = ap - f.ac;
  const float d5 = f.ab.dot(cp), d6 = f.ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return f.a + f.ac;
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return f.a + d2 / (d2 - d6) * f.ac;
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return f.a + f.ab + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (f.ac - f.ab);
  const float scale = 1 / (va + vb + vc);
  return f.a + vb * scale * f.ab + vc * scale * f.ac;
}

struct Query {
  const Facet* facets;
  Float3 p, ray, closest;
  unsigned facet = RTC_INVALID_GEOMETRY_ID;
};

// Called for each triangle that may be within the radius. Triangles that face away from the sensor are passed over during the search.
bool visit(RTCPointQueryFunctionArguments* arguments) {
  Query& query = *static_cast<Query*>(arguments->userPtr);
  const Facet& facet = query.facets[arguments->primID];
  if (facet.normal.dot(query.ray) > 0) return false;
  const Float3 closest = closest_point(facet, query.p);
  const float distance2 = (closest - query.p).squaredNorm();
  const float radius = arguments->query->radius;
  if (!(distance2 < radius * radius)) return false;
  arguments->query->radius = std::sqrt(distance2);
  query.closest = closest;
  query.facet = arguments->primID;
  return true;
}

Float3 to_float(const Triple& p) { return Eigen::Map<const Eigen::Vector3d>(p.data()).cast<float>(); }

// A mesh that is asked for closest points.
class Surfaces {
 public:
  explicit Surfaces(const PeerMesh& mesh) : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    make_facets(mesh);
    attach(mesh);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree refuses the mesh");
  }
  ~Surfaces() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Surfaces(const Surfaces&) = delete;
  Surfaces& operator=(const Surfaces&) = delete;

  bool closest_facing(const Eigen::Vector3d& p, const Eigen::Vector3d& origin, double gate_m, Surface& surface) const {
    Query query{facets_.data(), p.cast<float>(), (p - origin).cast<float>(), Float3::Zero()};
    RTCPointQuery where{query.p[0], query.p[1], query.p[2], 0, static_cast<float>(gate_m)};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_, &where, &context, visit, &query);
    if (query.facet == RTC_INVALID_GEOMETRY_ID) return false;
    surface.point = query.closest.cast<double>();
    surface.normal = facets_[query.facet].normal.cast<double>();
    return true;
  }

 private:
  void make_facets(const PeerMesh& mesh) {
    for (const auto& triangle : mesh.triangles) {
      const Float3 a = to_float(mesh.vertices_m[triangle[0]]);
      const Float3 ab = to_float(mesh.vertices_m[triangle[1]]) - a;
      const Float3 ac = to_float(mesh.vertices_m[triangle[2]]) - a;
      facets_.push_back({a, ab, ac, ab.cross(ac).normalized()});
    }
  }

  void attach(const PeerMesh& mesh) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(float[3]), mesh.vertices_m.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(std::uint32_t[3]), mesh.triangles.size()));
    if (vertices == nullptr || indices == nullptr) throw std::runtime_error("Embree has no memory for the mesh");
    for (const Triple& v : mesh.vertices_m) vertices = std::transform(v.begin(), v.end(), vertices, [](double x) { return float(x); });
    for (const auto& triangle : mesh.triangles) indices = std::copy(triangle.begin(), triangle.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }

  RTCDevice device_;
  RTCScene scene_;
  std::vector<Facet> facets_;
};

class EmbreePeer final : public Peer {
 public:
  EmbreePeer(const PeerMesh& mesh, const PeerSettings& settings) : surfaces_(mesh), settings_(settings) {}

  void set_scan(const std::vector<Triple>& points_m) override { points_m_ = to_vectors(points_m); }

  PeerResult align(const PeerPose& start) override {
    const auto find = [this](const auto& p, const auto& origin, double gate_m, Surface& surface) {
      return surfaces_.closest_facing(p, origin, gate_m, surface);
    };
    return register_points(points_m_, start, settings_, find);
  }

 private:
  Surfaces surfaces_;
  PointToPlane settings_;
  std::vector<Eigen::Vector3d> points_m_;
};

class EmbreeCheck final : public SurfaceCheck {
 public:
  explicit EmbreeCheck(const PeerMesh& mesh) : surfaces_(mesh) {}

  std::size_t count_near(const std::vector<Triple>& points_m, const std::vector<double>& gates_m, const PeerPose& pose) const override {
    const Eigen::Isometry3d T_target_sensor = from_peer_pose(pose).inverse();
    const Eigen::Vector3d origin = T_target_sensor.translation();
    std::size_t count = 0;
    Surface surface;
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      const Eigen::Vector3d p = T_target_sensor * Eigen::Map<const Eigen::Vector3d>(points_m[i].data());
      count += surfaces_.closest_facing(p, origin, gates_m[i], surface) ? 1U : 0U;
    }
    return count;
  }

 private:
  Surfaces surfaces_;
};

}  // namespace

std::unique_ptr<Peer> make_embree_peer(const PeerMesh& mesh, const PeerSettings& settings) {
  return std::make_unique<EmbreePeer>(mesh, settings);
}

std::unique_ptr<SurfaceCheck> make_surface_check(const PeerMesh& mesh) { return std::make_unique<EmbreeCheck>(mesh); }

}  // namespace lasso::bench
