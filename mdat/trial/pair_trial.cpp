#include "mdat/trial/pair_trial.hpp"

#include <cmath>

#include "fsw/geometry/so3.hpp"
#include "fsw/sense/pattern.hpp"
#include "fsw/sense/planner.hpp"
#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/common/text.hpp"
#include "mdat/replay/single_scans.hpp"
#include "mdat/run/verdict.hpp"
#include "mdat/stereo/depth_window.hpp"
#include "mdat/stereo/fitted_stereo.hpp"
#include "mdat/stereo/stereo_sensor.hpp"

namespace lasso::mdat {
namespace {

constexpr int kFitStep_px = 6;  // between pixels that a fit is made of
constexpr double kGoldenRatio = 0.6180339887498949;

Vec3 drawn_direction(sim::Random& random) {
  Vec3 direction;
  for (int axis = 0; axis < 3; ++axis) direction[axis] = random.gaussian();
  return direction.normalized();
}

Pose start_beside(const Pose& truth, std::uint64_t seed) {
  sim::Random random(seed);
  Pose start = truth;
  start.q = normalized(exp_so3(kTrialTurn_rad * drawn_direction(random)) * truth.q);
  start.p += kTrialShift_m * drawn_direction(random);
  return start;
}

// One head, one folder, all pairs.
class PairTrial {
 public:
  PairTrial(const CompiledMission& mission, const TrialOptions& options)
      : mission_(mission), options_(options), scene_(make_scene(mission, {options.scenario, options.range_m, 0, {}, "", {}})) {
    image_ = std::make_unique<LoadedImage>("the mission", image_bytes(mission, scene_.setup.parameters));
    singles_ = std::make_unique<SingleScans>(image_->mission());
    depths_ = stated_depths(mission.mesh, scene_.setup, mission.source.stereo.baseline_m);
  }

  TrialResult run() {
    const double duration_s = scene_.setup.scenario.frames * scene_.setup.parameters.period_s;
    const std::vector<double> times_s = view_times_s(options_.views, duration_s);
    result_.scenario = scene_.scenario;
    result_.range_m = scene_.setup.range_m;
    result_.lights = options_.lights;
    ProgressBar bar("pairs", options_.lights.size() * times_s.size(), "pairs");
    for (std::uint32_t view = 0; view < times_s.size(); ++view) {
      move_scene(mission_, to_us(times_s[view]), scene_);
      for (std::size_t light = 0; light < options_.lights.size(); ++light) {
        try_pair(light, view, times_s[view]);
        bar.show(view * options_.lights.size() + light + 1);
      }
    }
    bar.finish();
    result_.fit = counts_.fit();
    return std::move(result_);
  }

 private:
  struct Which {
    std::size_t light;
    std::uint32_t view;
  };

  void try_pair(std::size_t light, std::uint32_t view, double time_s) {
    const StereoSource source = lit_by(options_.lights[light], mission_.source.stereo);
    const StereoView seen{*scene_.surface, stereo_materials(source, scene_.materials), stereo_lights(source, std::nullopt, {}),
                          scene_.T_sensor_target};
    const StereoHead head = make_head(source, scene_.fov_half_x_rad, scene_.fov_half_y_rad);
    if (options_.rendered) try_rendered({light, view}, time_s, head, seen);
    for (std::uint32_t draw = 0; draw < options_.draws; ++draw) {
      FittedStereo model(head, 1 + view + 1000 * draw);
      model.take(seen, depths_);
      register_scans(
          {light, view}, draw, [&](const Vec3& direction) { return model.sample(direction, kEpochUs); }, result_.fitted);
    }
  }

  void try_rendered(const Which& which, double time_s, const StereoHead& head, const StereoView& seen) {
    StereoCamera camera(head, 1 + which.view);
    const StereoPictures pictures = camera.take(seen, options_.jobs);
    write_file(files_.left, grey_png(pictures.left));
    write_file(files_.right, grey_png(pictures.right));
    write_file(files_.calibration, stereo_pair_text(head.stated));
    const DisparityMap map = match_files(matcher_program(), files_, depths_);
    const std::vector<double> truth_px = true_disparities(map, *scene_.surface, scene_.T_sensor_target);
    result_.pairs.push_back({which.light, which.view, time_s, pictures.exposure_s, disparity_errors(map, truth_px)});
    count(map, PairSight(head, seen), pictures.exposure_s);
    register_scans(
        which, 0, [&](const Vec3& direction) { return stereo_sample(map, direction, kEpochUs); }, result_.poses);
  }

  void count(const DisparityMap& map, const PairSight& sight, double exposure_s) {
    for (int row = kFitStep_px / 2; row < map.codes.height; row += kFitStep_px) {
      for (int column = kFitStep_px / 2; column < map.codes.width; column += kFitStep_px)
        counts_.add(sight.at(column, row, exposure_s), map.disparity_px(map.index(column, row)));
    }
  }

  template <class Sampled>
  void register_scans(const Which& which, std::uint32_t draw, const Sampled& sampled, std::vector<TrialPose>& poses) {
    for (std::uint32_t scan = 0; scan < options_.scans; ++scan) {
      poses.push_back(registered(which.view, draw, scan, sampled));
      poses.back().light = which.light;
    }
  }

  template <class Sampled>
  TrialPose registered(std::uint32_t view, std::uint32_t draw, std::uint32_t scan, const Sampled& sampled) {
    const Mission& mission = image_->mission();
    const Pose& truth = scene_.T_sensor_target;
    ScanPlan plan;
    if (plan_scan(mission.parameters, {mission.hull, mission.center_m}, truth, scan, plan) != Status::kOk)
      throw RunError(format("view %u: the target is not in the field of view", view));
    RangeImage image;
    image.scan_id = scan;
    for (std::uint16_t ray = 0; ray < plan.points; ++ray) static_cast<void>(image.samples.push_back(sampled(pattern_direction(plan, ray))));
    StartPoint start;
    start.T_sensor_target = start_beside(truth, 1000 * (1 + view) + 100 * draw + scan);
    TrialPose pose = trial_pose(singles_->estimate(image, start), truth);
    pose.view = view;
    pose.draw = draw;
    pose.scan = scan;
    return pose;
  }

  const CompiledMission& mission_;
  const TrialOptions& options_;
  Scene scene_;
  std::unique_ptr<LoadedImage> image_;
  std::unique_ptr<SingleScans> singles_;
  MatchDepths depths_;
  ScratchFolder folder_;
  PairFiles files_{folder_.path() / "left.png", folder_.path() / "right.png", folder_.path() / "calibration.toml"};
  FitCounts counts_;
  TrialResult result_;
};

}  // namespace

std::vector<double> view_times_s(std::uint32_t views, double duration_s) {
  std::vector<double> times_s;
  for (std::uint32_t view = 0; view < views; ++view) times_s.push_back(duration_s * std::fmod(view * kGoldenRatio, 1.0));
  return times_s;
}

TrialPose trial_pose(const Registration& registration, const Pose& truth) {
  TrialPose pose;
  pose.reason = registration.reason;
  pose.returns = registration.returns;
  const Vec6 error = pose_difference(registration.T_sensor_target, truth);
  const Mat6& covariance = registration.covariance;
  const Vec3 turn = error.head<3>(), shift = error.tail<3>();
  pose.off_m = shift.norm();
  pose.off_rad = turn.norm();
  if (!registration.valid()) return pose;
  const Mat3 of_turn = covariance.topLeftCorner<3, 3>(), of_shift = covariance.bottomRightCorner<3, 3>();
  pose.sigma_rad = std::sqrt(of_turn.trace());
  pose.sigma_m = std::sqrt(of_shift.trace());
  pose.squared_attitude = turn.dot(of_turn.ldlt().solve(turn)) / 3;
  pose.squared_position = shift.dot(of_shift.ldlt().solve(shift)) / 3;
  pose.nees = nees(registration.T_sensor_target, truth, covariance);
  pose.wrong = judge(registration.T_sensor_target, truth, covariance) == PoseVerdict::kWrong;
  return pose;
}

TrialResult try_pairs(const CompiledMission& mission, const TrialOptions& options) { return PairTrial(mission, options).run(); }

}  // namespace lasso::mdat
