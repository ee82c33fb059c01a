// A campaign's folder from its expansion to its results: what the commands of mdat campaign do.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mdat/campaign/engine.hpp"
#include "mdat/campaign/plan.hpp"
#include "mdat/campaign/records.hpp"
#include "mdat/campaign/result_table.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// A campaign that has been expanded.
struct CampaignFolder {
  std::filesystem::path path;
  CampaignPlan plan;
  std::string digest;  // of the plan
  MissionInput input;  // the plan's
  bool cached = true;  // models are taken from the user's cache, and kept there
  const CampaignSource& campaign() const { return input.source.campaigns.at(plan.campaign); }
};

// Draws all cases, keeps the mission's files in the folder, which is made, and writes cases.csv, then plan.json. The mission is compiled in
// a process of its own. `commit`: the program's, for a person. `replace`: what a campaign has left in the folder goes, as soon as the new
// one is drawn; refused while a runner flies it. Throws InputError, MissionError, RunError.
void expand_campaign(const MissionInput& input, const std::string& campaign, bool cached, const std::string& commit,
                     const std::filesystem::path& folder, bool replace);

// Throws as load_plan and load_planned.
CampaignFolder open_campaign(const std::filesystem::path& folder, bool cached);

// Flies what is missing (engine.hpp), or as much of it as the stopping rule needs where all is one chunk.
EngineResult fly_campaign(const CampaignFolder& folder, EngineOptions options);

// Rows of all finished cases, up to the one at which the stopping rule ends the campaign. `partial`: with cases missing, with a rule up
// to the first of them; otherwise throws InputError where some are.
ResultTable merged(const CampaignFolder& folder, bool partial);

// The number of cases after which the stopping rule has ended the campaign; nothing where it has not, or where there is none.
std::optional<std::uint32_t> ended_after(const CampaignFolder& folder);

// results.csv, results.h5, times.csv, summary.json, junit.xml. Returns the summary for the terminal.
std::string write_results(const CampaignFolder& folder, const ResultTable& table);

// report.html, after all else. Returns its file. Throws PictureError where a picture is missing in it.
std::filesystem::path write_report(const CampaignFolder& folder, const ResultTable& table);

// A run of its own of one case: settings and results as those of mdat run.
struct FlownCase {
  CompiledMission mission;
  SimulationResult result;
  std::string fields;  // as its record has them
};
FlownCase fly_case(const CampaignFolder& folder, std::uint32_t number);

}  // namespace lasso::mdat
