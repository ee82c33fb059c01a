#include "mdat/stereo/stereo_maker.hpp"

#include <mutex>
#include <optional>
#include <utility>

#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/render/scene.hpp"
#include "mdat/stereo/depth_window.hpp"
#include "mdat/stereo/fitted_stereo.hpp"
#include "mdat/stereo/matcher.hpp"
#include "mdat/stereo/stereo_sensor.hpp"

namespace lasso::mdat {
namespace {

std::string stereo_camera_name(const MissionSource& source) {
  const std::vector<std::string> names = sensor_names(source);
  if (source.sensor == SensorKind::kStereo) return names.front();
  for (std::size_t i = 0; i < source.further_sensors.size(); ++i) {
    if (source.further_sensors[i].kind == SensorKind::kStereo) return names[i + 1];
  }
  return "";
}

// Whose pairs are taken, and of what.
struct PairedCase {
  const MissionInput& mission;
  const CaseSetup& setup;
  std::uint64_t target_seed, seed;
};

// The scene of a case as its stereo head sees it.
class StereoScene {
 public:
  explicit StereoScene(const PairedCase& of)
      : depths(stated_depths(of.mission.mesh, of.setup, of.mission.source.stereo.baseline_m)),
        mission_(of.mission),
        scene_(scene_of_case(of.mission, of.setup, of.target_seed, stereo_camera_name(of.mission.source), 0)),
        materials_(stereo_materials(of.mission.source.stereo, scene_.materials)) {}

  StereoHead head() const { return make_head(mission_.source.stereo, scene_.fov_half_x_rad, scene_.fov_half_y_rad); }

  // At a time since frame 0; until the next is asked for.
  const StereoView& view_at(TimeUs t_us) {
    move_scene(mission_, t_us, scene_);
    view_.emplace(StereoView{*scene_.surface, materials_, stereo_lights(mission_.source.stereo, scene_.orbit_lights, scene_.lamps),
                             scene_.T_sensor_target});
    return *view_;
  }

  const MatchDepths depths;

 private:
  const MissionInput& mission_;
  Scene scene_;
  std::vector<Material> materials_;
  std::optional<StereoView> view_;
};

// Renders, writes and matches pair after pair of one case.
class Photographer {
 public:
  Photographer(const PairedCase& of, unsigned jobs) : scene_(of), camera_(scene_.head(), of.seed), jobs_(jobs) {
    write_file(files_.calibration, stereo_pair_text(camera_.head().stated));
  }

  PairRanges pair_at(TimeUs t_us) {
    const StereoPictures pictures = camera_.take(scene_.view_at(t_us), jobs_);
    TakenPair pair{kEpochUs + t_us, camera_.head().stated, grey_png(pictures.left), grey_png(pictures.right)};
    write_file(files_.left, pair.left_png);
    write_file(files_.right, pair.right_png);
    keep(std::move(pair));
    return ranges_in(match_files(matcher_program(), files_, scene_.depths));
  }

  std::vector<TakenPair> take_pairs() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(pairs_, {});
  }

 private:
  void keep(TakenPair pair) {
    const std::lock_guard<std::mutex> lock(mutex_);
    pairs_.push_back(std::move(pair));
  }

  StereoScene scene_;
  StereoCamera camera_;
  unsigned jobs_;
  std::mutex mutex_;  // pairs_: the component's threads ask for scans, another one for these
  std::vector<TakenPair> pairs_;
  ScratchFolder folder_;
  PairFiles files_{folder_.path() / "left.png", folder_.path() / "right.png", folder_.path() / "calibration.toml"};
};

// Pairs by their errors alone.
class Estimated {
 public:
  explicit Estimated(const PairedCase& of) : scene_(of), stereo_(scene_.head(), of.seed) {}

  PairRanges pair_at(TimeUs t_us) {
    stereo_.take(scene_.view_at(t_us), scene_.depths);
    return [this](const Vec3& direction, TimeUs at_us) { return stereo_.sample(direction, at_us); };
  }

  static std::vector<TakenPair> take_pairs() { return {}; }  // there are no pictures

 private:
  StereoScene scene_;
  FittedStereo stereo_;
};

template <class Pairs>
class StereoOfCase final : public MadeSensor {
 public:
  template <class... Arguments>
  explicit StereoOfCase(const Arguments&... arguments)
      : pairs_(arguments...), sensor_([this](TimeUs t_us) { return pairs_.pair_at(t_us); }) {}
  Sensor& sensor() override { return sensor_; }
  std::string failure() const override { return sensor_.failure(); }
  std::vector<TakenPair> take_pairs() override { return pairs_.take_pairs(); }

 private:
  Pairs pairs_;
  StereoSensor sensor_;
};

}  // namespace

bool has_stereo_head(const MissionSource& source) { return !stereo_camera_name(source).empty(); }

MakeStereo stereo_maker(const MissionInput& mission, std::uint64_t target_seed, unsigned jobs) {
  return [&mission, target_seed, jobs](const CaseSetup& setup, std::uint64_t seed) -> std::unique_ptr<MadeSensor> {
    const PairedCase of{mission, setup, target_seed, seed};
    if (mission.source.stereo.is_fitted()) return std::make_unique<StereoOfCase<Estimated>>(of);
    return std::make_unique<StereoOfCase<Photographer>>(of, jobs);
  };
}

void refuse_pictures(const MissionSource& source, const std::string& what) {
  if (!has_stereo_head(source) || source.stereo.is_fitted()) return;
  throw InputError(source.file.string() + ": stereo.model: rendered: pictures take seconds a frame, and " + what +
                   " fly stereo cameras by fitted errors alone: --set stereo.model=fitted, or another sensor.kind");
}

MakeStereo stereo_without_pictures(const MissionInput& mission, std::uint64_t target_seed, const std::string& what) {
  refuse_pictures(mission.source, what);
  return has_stereo_head(mission.source) ? stereo_maker(mission, target_seed, 1) : MakeStereo{};
}

}  // namespace lasso::mdat
