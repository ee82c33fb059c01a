#include "ft/bench/methods.hpp"

#include "fsw/pose/estimator/estimator.hpp"
#include "ft/bench/peer_pose.hpp"
#include "ft/bench/sampling.hpp"

namespace lasso::bench {
namespace {

constexpr std::size_t kModelPoints = 81000;  // of the peers that need the mesh as points: 3 mm apart on the tenth-scale Hubble

class Lasso final : public Method {
 public:
  Lasso(std::string name, std::unique_ptr<mdat::LoadedImage> image) : Method(std::move(name)), image_(std::move(image)) {}

  bool is_peer() const override { return false; }
  void set_scan(const Scan& scan) override { to_range_image(scan, *range_image_); }

  Outcome run(const Pose& start) override {
    const Registration result = estimator_->estimate(image_->mission(), *range_image_, {start, Twist(), false});
    return {result.T_sensor_target, result.covariance, result.valid(), int{result.iterations}};
  }

 private:
  std::unique_ptr<mdat::LoadedImage> image_;
  std::unique_ptr<Estimator> estimator_ = std::make_unique<Estimator>();
  std::unique_ptr<RangeImage> range_image_ = std::make_unique<RangeImage>();
};

class PeerMethod final : public Method {
 public:
  PeerMethod(std::string name, std::unique_ptr<Peer> peer) : Method(std::move(name)), peer_(std::move(peer)) {}

  bool is_peer() const override { return true; }

  void set_scan(const Scan& scan) override {
    std::vector<Triple> points_m;
    for (const RangeSample& sample : scan.samples) {
      if (sample.state != RayState::kHit) continue;
      const Vec3 p = double{sample.range_m} * Vec3(sample.direction[0], sample.direction[1], sample.direction[2]);
      points_m.push_back({p[0], p[1], p[2]});
    }
    peer_->set_scan(points_m);
  }

  Outcome run(const Pose& start) override {
    const PeerResult result = peer_->align(to_peer_pose(start));
    Outcome outcome;
    outcome.T_sensor_target = from_peer_pose(result.T_sensor_target);
    outcome.iterations = result.iterations;
    return outcome;
  }

 private:
  std::unique_ptr<Peer> peer_;
};

}  // namespace

std::vector<std::unique_ptr<Method>> make_methods(const mdat::CompiledMission& mission, const std::string& scenario) {
  const PeerCloud cloud = sample_evenly(mission.mesh, kModelPoints);
  std::vector<std::unique_ptr<Method>> methods;
  methods.push_back(std::make_unique<Lasso>(kHits, make_image(mission, scenario, false)));
  methods.push_back(std::make_unique<Lasso>(kSilhouettes, make_image(mission, scenario, true)));
  methods.push_back(std::make_unique<PeerMethod>(kEmbree, make_embree_peer(to_peer_mesh(mission.mesh))));
  methods.push_back(std::make_unique<PeerMethod>(kNanoflann, make_nanoflann_peer(cloud)));
  methods.push_back(std::make_unique<PeerMethod>(kPcl, make_pcl_peer(cloud)));
  return methods;
}

}  // namespace lasso::bench
