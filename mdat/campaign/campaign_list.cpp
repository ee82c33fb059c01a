#include "mdat/campaign/campaign_list.hpp"

#include <algorithm>
#include <vector>

#include "mdat/campaign/conclusion_text.hpp"
#include "mdat/campaign/law_text.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

using Lines = std::vector<std::string>;

// The dispersion's key as the campaign has it, without "campaign.NAME.", and without the place in a list; of columns that are together
// their names.
std::string name_of(const Dispersion& dispersion, const std::string& campaign) {
  const std::string prefix = "campaign." + campaign + ".";
  const bool alone = dispersion.key.rfind(prefix, 0) == 0 && dispersion.key.rfind(prefix + "together", 0) != 0;
  if (alone) return dispersion.key.substr(prefix.size(), dispersion.key.find('[') - prefix.size());
  std::string names;
  for (const std::string& column : dispersion.columns) names += (names.empty() ? "" : ", ") + column;
  return names;
}

std::string joined(const Lines& texts, const char* between) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : between) + text;
  return all;
}

bool all_fixed(const Lines& laws, const std::string& ending) {
  return std::all_of(laws.begin(), laws.end(), [&](const std::string& law) { return law.ends_with(ending); });
}

// Of the numbers of one key. What is alike is said once.
std::string laws_text(Lines laws) {
  const std::string ending = " in every case";  // of a number that does not vary (law_text)
  if (all_fixed(laws, ending)) {
    for (std::string& law : laws) law.resize(law.size() - ending.size());
    return joined(laws, ", ") + ending;
  }
  const bool alike = std::all_of(laws.begin(), laws.end(), [&](const std::string& law) { return law == laws.front(); });
  return alike && laws.size() > 1 ? "each " + laws.front() : joined(laws, "; ");
}

Lines varied(const CampaignSource& campaign) {
  Lines lines, laws;
  for (std::size_t i = 0; i < campaign.dispersions.size(); ++i) {
    const std::string name = name_of(campaign.dispersions[i], campaign.name);
    laws.push_back(law_text(campaign.dispersions[i].law));
    if (i + 1 < campaign.dispersions.size() && name_of(campaign.dispersions[i + 1], campaign.name) == name) continue;
    lines.push_back(name + ": " + laws_text(laws));
    laws.clear();
  }
  return lines;
}

Lines asked(const CampaignSource& campaign) {
  Lines lines;
  for (const Criterion& criterion : campaign.criteria) lines.push_back(criterion_text(criterion));
  return lines;
}

std::string cases_of(const CampaignSource& campaign) {
  const std::string most = campaign.look_every > 0 ? "at most " : "";
  const std::string frames = campaign.frames > 0 ? format(" of %u frames", campaign.frames) : "";
  return most + format("%u cases", campaign.cases) + frames;
}

std::string block(const char* label, const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += format("  %-6s  ", text.empty() ? label : "") + line + "\n";
  return text;
}

}  // namespace

std::string campaign_list(const std::map<std::string, CampaignSource>& campaigns) {
  if (campaigns.empty()) return "no campaign: add a section [campaign.NAME] with scenario and cases\n";
  std::string text;
  for (const auto& [name, campaign] : campaigns)
    text += name + ": " + cases_of(campaign) + ", scenario " + campaign.scenario + "\n" + block("varies", varied(campaign)) +
            block("asks", asked(campaign));
  return text;
}

std::string campaign_table(const std::map<std::string, CampaignSource>& campaigns) {
  if (campaigns.empty()) return "";
  std::string text = "| campaign | scenario | cases | varies | asks |\n| --- | --- | --- | --- | --- |\n";
  for (const auto& [name, campaign] : campaigns)
    text += "| `" + name + "` | `" + campaign.scenario + "` | " + cases_of(campaign) + " | " + joined(varied(campaign), "<br>") + " | " +
            joined(asked(campaign), "<br>") + " |\n";
  return text;
}

}  // namespace lasso::mdat
