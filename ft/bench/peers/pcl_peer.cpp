// PCL's point-to-plane ICP, set up so that it does its best: the model's tree is kept from scan to scan, matches that face away from the
// sensor are rejected, and it stops where the others stop.
#include <pcl/point_types.h>
#include <pcl/registration/correspondence_rejection_surface_normal.h>
#include <pcl/registration/icp.h>
#include <pcl/search/kdtree.h>

#include "ft/bench/peers/point_to_plane.hpp"

namespace lasso::bench {
namespace {

using Point = pcl::PointNormal;
using Cloud = pcl::PointCloud<Point>;
using Base = pcl::IterativeClosestPointWithNormals<Point, Point>;

struct Icp : Base {
  int iterations() const { return nr_iterations_; }
};

Point to_point(const Triple& p, const Eigen::Vector3d& normal) {
  Point point;
  point.getVector3fMap() = Eigen::Map<const Eigen::Vector3d>(p.data()).cast<float>();
  point.getNormalVector3fMap() = normal.cast<float>();
  return point;
}

Cloud::Ptr to_cloud(const PeerCloud& model) {
  const Cloud::Ptr cloud(new Cloud);
  for (std::size_t i = 0; i < model.points_m.size(); ++i) {
    cloud->push_back(to_point(model.points_m[i], Eigen::Map<const Eigen::Vector3d>(model.normals[i].data())));
  }
  return cloud;
}

class PclPeer final : public Peer {
 public:
  explicit PclPeer(const PeerCloud& model) : target_(to_cloud(model)), source_(new Cloud) {
    const PointToPlane settings;
    icp_.setMaxCorrespondenceDistance(settings.gate_max_m);
    icp_.setMaximumIterations(settings.iterations_max);
    icp_.setTransformationEpsilon(settings.stop_m * settings.stop_m);
    icp_.setTransformationRotationEpsilon(std::cos(settings.stop_rad));
    icp_.setEuclideanFitnessEpsilon(1e-14);
    reject_averted_matches();
    keep_tree();
  }

  // A return's normal is the direction to the sensor, for the facing test.
  void set_scan(const std::vector<Triple>& points_m) override {
    source_.reset(new Cloud);
    for (const Triple& p : points_m) source_->push_back(to_point(p, -Eigen::Map<const Eigen::Vector3d>(p.data()).normalized()));
  }

  PeerResult align(const PeerPose& start) override {
    const Eigen::Isometry3d T_target_sensor = from_peer_pose(start).inverse();
    icp_.setInputSource(source_);
    icp_.align(aligned_, T_target_sensor.matrix().cast<float>());
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    result.matrix() = icp_.getFinalTransformation().cast<double>();
    return {to_peer_pose(result.inverse()), icp_.iterations()};
  }

 private:
  void reject_averted_matches() {
    const pcl::registration::CorrespondenceRejectorSurfaceNormal::Ptr rejector(new pcl::registration::CorrespondenceRejectorSurfaceNormal);
    rejector->setThreshold(0);
    icp_.addCorrespondenceRejector(rejector);
  }

  void keep_tree() {
    const pcl::search::KdTree<Point>::Ptr tree(new pcl::search::KdTree<Point>(false));
    tree->setInputCloud(target_);
    icp_.setInputTarget(target_);
    icp_.setSearchMethodTarget(tree, true);
  }

  Cloud::Ptr target_, source_;
  Cloud aligned_;
  Icp icp_;
};

}  // namespace

std::unique_ptr<Peer> make_pcl_peer(const PeerCloud& cloud) { return std::make_unique<PclPeer>(cloud); }

}  // namespace lasso::bench
