#include "mdat/availability/heads.hpp"

#include <algorithm>
#include <utility>

#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"
#include "mdat/render/light.hpp"
#include "mdat/run/simulation.hpp"
#include "mdat/stereo/stereo_maker.hpp"

namespace lasso::mdat {
namespace {

constexpr char kKindKey[] = "sensor.kind", kLampKey[] = "stereo.lamp_Wpsr";

bool sets(const std::string& setting, const std::string& key) { return setting.rfind(key + "=", 0) == 0; }

// A head's own settings take the place of the user's.
std::vector<std::string> settings_for(const HeadsMission& mission, const Head& head, const std::vector<std::string>& more) {
  std::vector<std::string> settings = head.settings;
  for (const std::string& setting : mission.settings) {
    if (!sets(setting, kLampKey)) settings.push_back(setting);
  }
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

void require_orbit(const MissionInput& input, const std::string& scenario) {
  const SceneRun* run = scenario_of(input.source, scenario).scene.get();
  if (run != nullptr && run->orbit) return;
  throw InputError(input.source.file.string() + ": scenario " + scenario +
                   " has no light of an orbit: expected nodes without ranges_m, and [orbit], as in " + "cfg/missions/day_and_night.toml");
}

}  // namespace

std::vector<Head> heads_with(double lamp_Wpsr) {
  const std::string kind = std::string(kKindKey) + "=", lamp = std::string(kLampKey) + "=";
  return {{"laser_camera", "laser camera", {kind + kind_name(SensorKind::kLaserCamera), lamp + "0"}},
          {"stereo", "stereo cameras", {kind + kind_name(SensorKind::kStereo), lamp + "0"}},
          {"stereo_lamp", "stereo cameras, lamp", {kind + kind_name(SensorKind::kStereo), lamp + format("%.17g", lamp_Wpsr)}}};
}

std::vector<Head> heads_of(const HeadsMission& mission) {
  for (const std::string& setting : mission.settings) {
    if (sets(setting, kKindKey))
      throw InputError("--set " + setting + ": this command flies each kind that it compares; leave it out, or fly one by mdat run");
  }
  const double lamp_Wpsr = load_mission(mission.file, mission.settings).stereo.lamp_Wpsr;
  return heads_with(lamp_Wpsr > 0 ? lamp_Wpsr : kLamp_Wpsr);
}

MissionInput input_of_head(const HeadsMission& mission, const Head& head, const std::string& scenario,
                           const std::vector<std::string>& more) {
  MissionInput input = load_mission_input(mission.file, settings_for(mission, head, more), scenario);
  require_orbit(input, scenario);
  return input;
}

HeadFlights::HeadFlights(const HeadsMission& mission, const Head& head, const std::string& scenario)
    : head_(head),
      scenario_(scenario),
      mission_(compile_mission(input_of_head(mission, head, scenario), ModelCache::of_user_if(mission.cached))),
      image_(image_bytes(mission_, plain_case(mission_.source, this->scenario(), 0, 0).parameters)),
      target_(simulated_target(mission_.mesh, this->scenario(), static_cast<std::uint64_t>(this->scenario().seed),
                               mission_.source.target_laser)) {}

const Scenario& HeadFlights::scenario() const { return scenario_of(mission_.source, scenario_); }

CaseSetup HeadFlights::flight(const MissionInput& flown, std::uint64_t seed, std::uint32_t frames, unsigned picture_jobs) const {
  CaseSetup setup = plain_case(flown.source, scenario_of(flown.source, scenario_), seed, frames);
  setup.image = &image_;
  setup.target = target_.get();
  if (has_stereo_head(flown.source)) setup.make_stereo = stereo_maker(flown, seed, picture_jobs);
  return setup;
}

}  // namespace lasso::mdat
