#include "mdat/campaign/plan.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "mdat/campaign/case_table.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "mdat/run/simulation.hpp"
#include "mdat/source/nearest.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

using PlanJson = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr int kPlanForm = 2;
constexpr char kPlanFile[] = "plan.json", kCasesFile[] = "cases.csv";
constexpr const char* kSamplings[] = {"random", "latin_hypercube", "sobol"};
constexpr std::size_t kPlanDigestShown = 12;

PlanJson bound_json(double bound) { return std::isfinite(bound) ? PlanJson(bound) : PlanJson(nullptr); }

PlanJson criteria_json(const CampaignSource& campaign) {
  PlanJson json = PlanJson::object();
  for (const Criterion& criterion : campaign.criteria) {
    json[criterion.name] = {{"figure", criterion.figure},
                            {"at_least", bound_json(criterion.at_least)},
                            {"at_most", bound_json(criterion.at_most)},
                            {"share_min", criterion.share_min},
                            {"confidence", criterion.confidence}};
  }
  return json;
}

std::string digest_of_file(const fs::path& file) {
  try {
    return sha256_of_file(file);
  } catch (const std::runtime_error& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

std::string shown_digest(const std::string& digest) { return digest.substr(0, kPlanDigestShown); }

void require_same(const fs::path& file, const std::string& found, const std::string& planned, const std::string& remedy) {
  if (found == planned) return;
  throw InputError(file.string() + ": is not what the campaign was expanded from (SHA-256 " + shown_digest(found) + "..., planned " +
                   shown_digest(planned) + "...): " + remedy);
}

// The line of an edited table is named, by drawing all cases again; where none is wrong its text still is not the plan's.
void require_drawn(const fs::path& table, const CampaignPlan& plan, const CampaignSource& campaign) {
  const std::string digest = digest_of_file(table);
  if (digest == plan.cases_sha256) return;
  check_cases(table, CaseDraws(campaign), plan.cases);
  require_same(table, digest, plan.cases_sha256, "restore it, or expand the campaign into another folder (--out DIR)");
}

CampaignPlan plan_of(const PlanJson& json) {
  CampaignPlan plan;
  json.at("mission").get_to(plan.mission);
  json.at("campaign").get_to(plan.campaign);
  json.at("settings").get_to(plan.settings);
  json.at("figures").get_to(plan.figures);
  if (json.contains("counts")) json.at("counts").get_to(plan.counts);
  json.at("cases").get_to(plan.cases);
  if (const PlanJson& look_every = json.at("look_every"); !look_every.is_null()) look_every.get_to(plan.look_every);
  const PlanJson& digests = json.at("sha256");
  digests.at("files").get_to(plan.files);
  digests.at("image").get_to(plan.image_sha256);
  digests.at("program").get_to(plan.program_sha256);
  digests.at("cases").get_to(plan.cases_sha256);
  json.at("program").at("version").get_to(plan.version);
  json.at("program").at("commit").get_to(plan.commit);
  return plan;
}

}  // namespace

std::string plan_json(const CampaignPlan& plan, const CampaignSource& campaign) {
  PlanJson json;
  json["form"] = kPlanForm;
  json["mission"] = plan.mission;
  json["campaign"] = plan.campaign;
  json["settings"] = plan.settings;
  json["figures"] = plan.figures;
  json["counts"] = plan.counts;
  json["scenario"] = campaign.scenario;
  json["cases"] = plan.cases;
  json["frames"] = campaign.frames == 0 ? PlanJson(nullptr) : PlanJson(campaign.frames);
  json["seed"] = campaign.seed;
  json["sampling"] = kSamplings[static_cast<std::size_t>(campaign.sampling)];
  json["look_every"] = plan.look_every == 0 ? PlanJson(nullptr) : PlanJson(plan.look_every);
  json["criteria"] = criteria_json(campaign);
  json["program"] = {{"version", plan.version}, {"commit", plan.commit}};
  json["sha256"] = {{"files", plan.files}, {"image", plan.image_sha256}, {"program", plan.program_sha256}, {"cases", plan.cases_sha256}};
  return json.dump(2) + "\n";
}

bool has_plan(const fs::path& folder) { return fs::exists(folder / kPlanFile); }

LoadedPlan load_plan(const fs::path& folder) {
  const std::string file = (folder / kPlanFile).string();
  if (!has_plan(folder)) throw InputError(file + ": there is none; mdat campaign expand MISSION --campaign NAME --out DIR writes it");
  const std::string text = file_content(file);
  const PlanJson json = PlanJson::parse(text, nullptr, false);
  const int form = json.is_object() && json.contains("form") && json["form"].is_number_integer() ? json["form"].get<int>() : 0;
  if (form != kPlanForm)
    throw InputError(file + ": is not a plan of this version of mdat (form " + std::to_string(form) + ", expected " +
                     std::to_string(kPlanForm) + "): restore it, or expand the campaign into another folder");
  try {
    return {plan_of(json), sha256_of(text)};
  } catch (const PlanJson::exception& error) {
    throw InputError(file + ": is not whole (" + std::string(error.what()) + "): restore it, or expand the campaign into another folder");
  }
}

std::string program_sha256() { return digest_of_file("/proc/self/exe"); }

std::string image_sha256(const CompiledMission& mission, const CampaignSource& campaign) {
  const CaseSetup setup = plain_case(mission.source, scenario_of(mission.source, campaign.scenario), 0, 0);
  const std::vector<std::uint8_t> image = image_bytes(mission, setup.parameters);
  return sha256_of({reinterpret_cast<const char*>(image.data()), image.size()});
}

MissionInput load_planned(const fs::path& folder, const CampaignPlan& plan) {
  for (const auto& [name, digest] : plan.files)
    require_same(folder / name, digest_of_file(folder / name), digest,
                 "restore it, or expand the campaign into another folder (--out DIR)");
  MissionInput input = load_mission_input(folder / plan.mission, plan.settings);
  require_drawn(folder / kCasesFile, plan, campaign_of(input.source, plan.campaign));
  return input;
}

void check_image(const CampaignPlan& plan, const CompiledMission& mission) {
  const std::string found = image_sha256(mission, campaign_of(mission.source, plan.campaign));
  require_same(mission.source.file.string() + ", compiled", found, plan.image_sha256,
               "what it names by an absolute path has changed, or this machine computes otherwise; expand the campaign anew into another "
               "folder (--out DIR)");
}

void check_program(const CampaignPlan& plan) {
  if (program_sha256() == plan.program_sha256) return;
  throw InputError("this mdat is another one than that which expanded the campaign (" + plan.version + ", commit " + plan.commit +
                   "): its cases might differ; use that one, or expand the campaign anew into another folder");
}

const CampaignSource& campaign_of(const MissionSource& source, const std::string& name) {
  const auto campaign = source.campaigns.find(name);
  if (campaign != source.campaigns.end()) return campaign->second;
  std::string names;
  std::vector<std::string> known;
  for (const auto& [other, value] : source.campaigns) {
    names += (names.empty() ? "" : ", ") + other;
    known.push_back(other);
  }
  throw InputError(source.file.string() + ": " + (name.empty() ? "--campaign NAME is needed" : "has no campaign " + name) +
                   (names.empty() ? "; the mission has none: write one as [campaign.NAME]" : "; there are " + names) +
                   did_you_mean(name, known));
}

}  // namespace lasso::mdat
