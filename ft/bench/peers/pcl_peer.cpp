// PCL's point-to-plane ICP, set up so that it does its best: the model's tree is kept from scan to scan, matches that face away from the
// sensor are rejected, and it stops where the others stop.
#include <pcl/console/print.h>
#include <pcl/point_types.h>
#include <pcl/registration/correspondence_rejection_surface_normal.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>
#include <pcl/search/kdtree.h>

#include "ft/bench/peers/point_to_plane.hpp"

namespace lasso::bench {
namespace {

using Point = pcl::PointNormal;
using Cloud = pcl::PointCloud<Point>;
using Base = pcl::IterativeClosestPointWithNormals<Point, Point>;

// Of returns that leave a direction open PCL's step is not a number, and its search ends the program at the next one: the scan stays where
// it is instead.
class FiniteSteps : public pcl::registration::TransformationEstimationPointToPlaneLLS<Point, Point> {
 public:
  using Steps = pcl::registration::TransformationEstimationPointToPlaneLLS<Point, Point>;
  using Steps::estimateRigidTransformation;
  void estimateRigidTransformation(const Cloud& source, const Cloud& target, const pcl::Correspondences& matches,
                                   Matrix4& step) const override {
    Steps::estimateRigidTransformation(source, target, matches, step);
    if (step.allFinite()) return;
    step.setIdentity();
    failed_ = true;
  }
  // Since the last call.
  bool has_failed() const { return std::exchange(failed_, false); }

 private:
  mutable bool failed_ = false;
};

struct Icp : Base {
  int iterations() const { return nr_iterations_; }
  // By its steps, not by its iterations.
  bool has_settled() const {
    const auto state = convergence_criteria_->getConvergenceState();
    return converged_ && state != Criteria::CONVERGENCE_CRITERIA_ITERATIONS && state != Criteria::CONVERGENCE_CRITERIA_NO_CORRESPONDENCES;
  }

 private:
  using Criteria = pcl::registration::DefaultConvergenceCriteria<float>;
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
  PclPeer(const PeerCloud& model, const PeerSettings& settings) : settings_(settings), target_(to_cloud(model)), source_(new Cloud) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // a scan that finds no match is counted, not printed
    const PointToPlane stop;
    icp_.setMaximumIterations(settings.iterations_max);
    icp_.setTransformationEpsilon(stop.stop_m * stop.stop_m);
    icp_.setTransformationRotationEpsilon(std::cos(stop.stop_rad));
    icp_.setEuclideanFitnessEpsilon(1e-14);
    icp_.setTransformationEstimation(steps_);
    reject_averted_matches();
    keep_tree();
  }

  // A return's normal is the direction to the sensor, for the facing test.
  void set_scan(const std::vector<Triple>& points_m) override {
    source_.reset(new Cloud);
    for (const Triple& p : points_m) source_->push_back(to_point(p, -Eigen::Map<const Eigen::Vector3d>(p.data()).normalized()));
  }

  PeerResult align(const PeerPose& start) override {
    Eigen::Matrix4f T_target_sensor = from_peer_pose(start).inverse().matrix().cast<float>();
    PeerResult result;
    for (double gate_m = settings_.gate_max_m;; gate_m = std::max(gate_m / 2, settings_.sampled_gate_min_m)) {
      result.converged = align_within(gate_m, T_target_sensor);
      result.iterations += icp_.iterations();
      if (!settings_.coarse_to_fine || gate_m <= settings_.sampled_gate_min_m) break;
    }
    Eigen::Isometry3d aligned = Eigen::Isometry3d::Identity();
    aligned.matrix() = T_target_sensor.cast<double>();
    result.T_sensor_target = to_peer_pose(aligned.inverse());
    return result;
  }

 private:
  bool align_within(double gate_m, Eigen::Matrix4f& T_target_sensor) {
    icp_.setMaxCorrespondenceDistance(gate_m);
    icp_.setInputSource(source_);
    icp_.align(aligned_, T_target_sensor);
    T_target_sensor = icp_.getFinalTransformation();
    return !steps_->has_failed() && icp_.has_settled();
  }

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

  PeerSettings settings_;
  Cloud::Ptr target_, source_;
  Cloud aligned_;
  std::shared_ptr<FiniteSteps> steps_ = std::make_shared<FiniteSteps>();
  Icp icp_;
};

}  // namespace

std::unique_ptr<Peer> make_pcl_peer(const PeerCloud& cloud, const PeerSettings& settings) {
  return std::make_unique<PclPeer>(cloud, settings);
}

}  // namespace lasso::bench
