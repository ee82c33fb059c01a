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
LASSO_PEER std::unique_ptr<Peer> make_embree_peer(const PeerMesh& mesh);
// nanoflann's k-d tree over a sampled mesh, and the same Gauss-Newton.
LASSO_PEER std::unique_ptr<Peer> make_nanoflann_peer(const PeerCloud& cloud);
// PCL's IterativeClosestPointWithNormals over a sampled mesh.
LASSO_PEER std::unique_ptr<Peer> make_pcl_peer(const PeerCloud& cloud);

}  // namespace lasso::bench
