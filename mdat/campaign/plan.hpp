// A campaign that is about to be flown: plan.json and cases.csv in its folder, which all runners read and none writes again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mdat/common/flight_image.hpp"
#include "mdat/missiondb/campaign_source.hpp"

namespace lasso::mdat {

// What the cases of a folder depend on. Digests are SHA-256 in lower-case hexadecimal.
struct CampaignPlan {
  std::string mission;                // file, below the folder
  std::string campaign;               // its name there
  std::vector<std::string> settings;  // KEY=VALUE of the command line
  std::vector<std::string> figures;   // of a case, in the order of its record
  std::vector<std::string> counts;    // behind them; none where an earlier mdat expanded it
  std::uint32_t cases = 0;
  std::uint32_t look_every = 0;              // of the stopping rule; 0: none
  std::map<std::string, std::string> files;  // of the mission, kept below the folder: digests by name
  std::string image_sha256, program_sha256, cases_sha256;
  std::string version, commit;  // of the program, for a person
};

// plan.json of a campaign, ends with a line feed: the same campaign of the same program gives the same text.
std::string plan_json(const CampaignPlan& plan, const CampaignSource& campaign);

// A folder's plan, and the digest of its text, by which chunks know it.
struct LoadedPlan {
  CampaignPlan plan;
  std::string digest;
};
// Throws InputError: no plan there, not whole, of another version of this form.
LoadedPlan load_plan(const std::filesystem::path& folder);
bool has_plan(const std::filesystem::path& folder);

// The program that is running.
std::string program_sha256();
// Throws InputError where the mission's image, compiled here, is not the plan's.
void check_image(const CampaignPlan& plan, const CompiledMission& mission);
// The flight image of the campaign's scenario, as no case varies it.
std::string image_sha256(const CompiledMission& mission, const CampaignSource& campaign);

// The mission that the folder keeps, with the plan's settings. Throws InputError where one of its files or the table of cases is not that
// of the plan, each with its remedy, and MissionError.
MissionInput load_planned(const std::filesystem::path& folder, const CampaignPlan& plan);

// Throws InputError where this program is another one than that of the plan: its cases might not be the same.
void check_program(const CampaignPlan& plan);

// The campaign of that name. Throws InputError with the names that there are.
const CampaignSource& campaign_of(const MissionSource& source, const std::string& name);

}  // namespace lasso::mdat
