// A method that others use for the same task, behind plain C++: peers live in shared libraries of their own, compiled for this machine's
// processor, so that neither their compiler settings nor their copies of Eigen reach the flight component (nor the other way round).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#define LASSO_PEER [[gnu::visibility("default")]]

namespace lasso::bench {

using Triple = std::array<double, 3>;

// T_sensor_target, metres; R row by row.
struct PeerPose {
  std::array<double, 9> R{};
  Triple p_m{};
};

struct PeerResult {
  PeerPose T_sensor_target;
  int iterations = 0;
  bool converged = false;  // the last step was below the limits before the iterations ended
};

// What depends on the target and on how far starts are off. The presets are those of the benchmark's comparison (docs/benchmarks.md).
struct PeerSettings {
  double gate_max_m = 0.015;          // farthest surface that counts as a return's, at the start
  double gate_min_m = 0.001;          // the same at the end, of the exact mesh
  double sampled_gate_min_m = 0.004;  // the same of a sampled one: below it the spacing of its points would shut out true matches
  int iterations_max = 20;
  bool coarse_to_fine = false;  // PCL, whose gate is fixed: once more with half of the gate, down to the least one
};

// The model in the target's frame, metres; triangles counter-clockwise seen from outside.
struct PeerMesh {
  std::vector<Triple> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// The model's surface as points with outward unit normals.
struct PeerCloud {
  std::vector<Triple> points_m, normals;
};

class Peer {
 public:
  virtual ~Peer() = default;
  // The returns of a scan, sensor frame: put into the library's own container. Not timed.
  virtual void set_scan(const std::vector<Triple>& points_m) = 0;
  // Registers them from `start`. Timed.
  virtual PeerResult align(const PeerPose& start) = 0;
};

// Embree's point query on the exact mesh and point-to-plane Gauss-Newton. Throws std::runtime_error where Embree refuses the mesh.
LASSO_PEER std::unique_ptr<Peer> make_embree_peer(const PeerMesh& mesh, const PeerSettings& settings = {});
// nanoflann's k-d tree over a sampled mesh, and the same Gauss-Newton.
LASSO_PEER std::unique_ptr<Peer> make_nanoflann_peer(const PeerCloud& cloud, const PeerSettings& settings = {});
// PCL's IterativeClosestPointWithNormals over a sampled mesh.
LASSO_PEER std::unique_ptr<Peer> make_pcl_peer(const PeerCloud& cloud, const PeerSettings& settings = {});

// How many returns lie on the surface: whose closest point, of the faces towards the sensor, is nearer than the gate of each.
class SurfaceCheck {
 public:
  virtual ~SurfaceCheck() = default;
  virtual std::size_t count_near(const std::vector<Triple>& points_m, const std::vector<double>& gates_m, const PeerPose& pose) const = 0;
};
LASSO_PEER std::unique_ptr<SurfaceCheck> make_surface_check(const PeerMesh& mesh);

}  // namespace lasso::bench
