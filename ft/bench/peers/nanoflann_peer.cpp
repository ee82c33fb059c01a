// Closest model point by nanoflann's k-d tree.
#include <nanoflann.hpp>

#include "ft/bench/peers/point_to_plane.hpp"

namespace lasso::bench {
namespace {

constexpr std::size_t kLeafPoints = 10;

// The model as nanoflann reads it.
struct CloudAdaptor {
  std::vector<float> coordinates;
  std::size_t kdtree_get_point_count() const { return coordinates.size() / 3; }
  float kdtree_get_pt(std::size_t point, std::size_t axis) const { return coordinates[3 * point + axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

CloudAdaptor to_adaptor(const PeerCloud& cloud) {
  CloudAdaptor adaptor;
  for (const Triple& p : cloud.points_m) {
    for (const double x : p) adaptor.coordinates.push_back(static_cast<float>(x));
  }
  return adaptor;
}

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, CloudAdaptor>, CloudAdaptor, 3>;

class NanoflannPeer final : public Peer {
 public:
  NanoflannPeer(const PeerCloud& cloud, const PeerSettings& settings)
      : settings_(settings),
        model_points_m_(to_vectors(cloud.points_m)),
        model_normals_(to_vectors(cloud.normals)),
        adaptor_(to_adaptor(cloud)),
        tree_(3, adaptor_, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafPoints)) {
    settings_.gate_min_m = settings.sampled_gate_min_m;
    tree_.buildIndex();
  }

  void set_scan(const std::vector<Triple>& points_m) override { points_m_ = to_vectors(points_m); }

  PeerResult align(const PeerPose& start) override {
    const auto find = [this](const auto& p, const auto&, double gate_m, Surface& surface) { return closest(p, gate_m, surface); };
    return register_points(points_m_, start, settings_, find);
  }

 private:
  bool closest(const Eigen::Vector3d& p, double gate_m, Surface& surface) const {
    const float place[3] = {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
    std::uint32_t index = 0;
    float distance2 = 0;
    if (tree_.knnSearch(place, 1, &index, &distance2) == 0 || double{distance2} > gate_m * gate_m) return false;
    surface = {model_points_m_[index], model_normals_[index]};
    return true;
  }

  PointToPlane settings_;
  std::vector<Eigen::Vector3d> model_points_m_, model_normals_, points_m_;
  CloudAdaptor adaptor_;
  Tree tree_;
};

}  // namespace

std::unique_ptr<Peer> make_nanoflann_peer(const PeerCloud& cloud, const PeerSettings& settings) {
  return std::make_unique<NanoflannPeer>(cloud, settings);
}

}  // namespace lasso::bench
