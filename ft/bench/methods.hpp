// What is timed: the estimator as shipped, and each peer, behind one interface.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fsw/pose/scan/result.hpp"
#include "ft/bench/scans.hpp"

namespace lasso::bench {

struct Outcome {
  Pose T_sensor_target;
  Mat6 covariance = Mat6::Zero();  // as Registration; zero where the method has none
  bool valid = true;               // by the method's own word
  int iterations = 0;
};

class Method {
 public:
  explicit Method(std::string name) : name_(std::move(name)) {}
  virtual ~Method() = default;
  const std::string& name() const { return name_; }
  virtual bool is_peer() const = 0;
  // Hands the scan over in the method's own form. Not timed.
  virtual void set_scan(const Scan& scan) = 0;
  // Registers it. Timed.
  virtual Outcome run(const Pose& start) = 0;

 private:
  std::string name_;
};

constexpr const char* kHits = "lasso_hits";
constexpr const char* kSilhouettes = "lasso_silhouettes";
constexpr const char* kEmbree = "embree_closest_point";
constexpr const char* kNanoflann = "nanoflann_point_to_plane";
constexpr const char* kPcl = "pcl_icp_with_normals";

// All of them, the estimator first.
std::vector<std::unique_ptr<Method>> make_methods(const mdat::CompiledMission& mission, const std::string& scenario);

}  // namespace lasso::bench
