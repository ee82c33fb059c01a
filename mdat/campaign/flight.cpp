#include "mdat/campaign/flight.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "mdat/missiondb/camera_faults.hpp"
#include "mdat/missiondb/campaign_columns.hpp"
#include "mdat/run/camera.hpp"
#include "mdat/stereo/stereo_maker.hpp"

namespace lasso::mdat {
namespace {

bool are_same(const MissionParameters& a, const MissionParameters& b) {
  const auto rows = parameter_rows();
  return std::all_of(rows.begin(), rows.end(), [&](const ParameterRow& row) { return a.*row.member == b.*row.member; });
}

}  // namespace

CampaignFlight::CampaignFlight(const CompiledMission& mission, const CampaignSource& campaign, std::vector<std::string> columns)
    : mission_(mission),
      campaign_(campaign),
      columns_(std::move(columns)),
      scenario_(scenario_of(mission.source, campaign.scenario)),
      frames_(campaign.frames != 0 ? campaign.frames : static_cast<std::uint32_t>(scenario_.frames)),
      parameters_(plain_case(mission.source, scenario_, 0, 0).parameters),
      image_(image_bytes(mission, parameters_)),
      target_(make_target(mission.mesh, mission.source.target_laser)) {
  for (const lcs::Device device : {lcs::Device::kLaserCamera, lcs::Device::kLidar, lcs::Device::kTridar}) {
    if (campaign.sensor == wire_name(device)) wire_ = device;
  }
  for (const std::string& script : campaign.fault_scripts) faults_.push_back(load_camera_faults(script));
  check_simulation(mission.source, options(0, {}), false);
}

sim::LcsFaults CampaignFlight::faults_of(const Scenario& scenario) const {
  return scenario.fault_script < 0 ? sim::LcsFaults{} : faults_.at(static_cast<std::size_t>(scenario.fault_script));
}

Scenario CampaignFlight::scenario_with(const std::vector<double>& values) const {
  Scenario scenario = scenario_;
  for (std::size_t i = 0; i < columns_.size(); ++i) set_column(scenario, columns_[i], values.at(i));
  return scenario;
}

CaseResult CampaignFlight::fly(std::uint64_t seed, const std::vector<double>& values) const {
  CaseSetup setup = plain_case(mission_.source, scenario_with(values), seed, frames_);
  setup.alone = true;
  setup.wire = wire_;
  setup.camera_faults = faults_of(setup.scenario);
  setup.make_stereo = stereo_of(seed);
  std::vector<std::uint8_t> image;
  if (!are_same(setup.parameters, parameters_)) image = image_bytes(mission_, setup.parameters);
  setup.image = image.empty() ? &image_ : &image;
  std::unique_ptr<sim::RayCaster> target;
  if (has_model_error(setup.scenario)) target = simulated_target(mission_.mesh, setup.scenario, seed, mission_.source.target_laser);
  setup.target = target ? target.get() : target_.get();
  std::atomic<std::size_t> frames_done{0};
  return run_case(setup, frames_done);
}

MakeStereo CampaignFlight::stereo_of(std::uint64_t seed) const { return stereo_without_pictures(mission_, seed, "campaigns"); }

CompiledMission CampaignFlight::mission_of(const std::vector<double>& values) const {
  CompiledMission mission = mission_;
  Scenario& scenario = mission.source.scenarios[campaign_.scenario] = scenario_with(values);
  if (!scenario.has_profile()) scenario.ranges_m.resize(1);  // which a case flies
  return mission;
}

SimulationOptions CampaignFlight::options(std::uint64_t seed, const std::vector<double>& values) const {
  SimulationOptions options;
  options.scenario = campaign_.scenario;
  options.seed = seed;
  options.frames = frames_;
  options.plain = true;
  options.wire = wire_;
  options.make_stereo = stereo_of(seed);
  if (!values.empty()) options.camera_faults = faults_of(scenario_with(values));
  return options;
}

}  // namespace lasso::mdat
