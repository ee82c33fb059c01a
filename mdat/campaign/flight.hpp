// The cases of one campaign, flown.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mdat/common/flight_image.hpp"
#include "mdat/missiondb/campaign_source.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// What all cases share is made once: the compiled mission, its image, the target's surface. Only a case that varies what the component
// believes gets an image, and one whose target differs from the model gets a surface, of its own.
class CampaignFlight {
 public:
  // `columns` are those of the table of cases. Keeps references: both outlive it. Throws MissionError where there is no such scenario, and
  // InputError where stereo cameras would be rendered.
  CampaignFlight(const CompiledMission& mission, const CampaignSource& campaign, std::vector<std::string> columns);

  // The case of these values, in the order of the columns, and of the noise of `seed`. Throws RunError where the component refuses its
  // image or its start.
  CaseResult fly(std::uint64_t seed, const std::vector<double>& values) const;

  // The mission with the case's values in the place of its scenario's, for simulate with options(): a run of its own of the same case, bit
  // for bit, which has a report.
  CompiledMission mission_of(const std::vector<double>& values) const;
  SimulationOptions options(std::uint64_t seed, const std::vector<double>& values) const;

 private:
  Scenario scenario_with(const std::vector<double>& values) const;
  MakeStereo stereo_of(std::uint64_t seed) const;
  sim::LcsFaults faults_of(const Scenario& scenario) const;

  const CompiledMission& mission_;
  const CampaignSource& campaign_;
  std::vector<std::string> columns_;
  Scenario scenario_;
  std::uint32_t frames_;
  std::optional<lcs::Device> wire_;
  std::vector<sim::LcsFaults> faults_;  // by the scripts of the campaign
  MissionParameters parameters_;        // of a case that varies none of them ...
  std::vector<std::uint8_t> image_;     // ... and its image
  std::unique_ptr<sim::RayCaster> target_;
};

}  // namespace lasso::mdat
