#include "mdat/missiondb/campaign_reader.hpp"

#include <algorithm>
#include <limits>

#include "mdat/missiondb/beside.hpp"
#include "mdat/missiondb/camera_faults.hpp"
#include "mdat/missiondb/campaign_columns.hpp"
#include "mdat/missiondb/campaign_rows.hpp"
#include "mdat/missiondb/dispersions.hpp"
#include "mdat/missiondb/law_reader.hpp"
#include "mdat/missiondb/old_keys.hpp"
#include "mdat/missiondb/sections.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

constexpr char kDirection[] = "any_direction";

std::vector<std::string> keys_of(const std::vector<ValueRow>& rows) {
  std::vector<std::string> keys;
  for (const ValueRow& row : rows) keys.push_back(row.key);
  return keys;
}

double number_in(const FoundValues& found, const ValueRow& row, double absent) {
  const auto value = found.find(row.key);
  return value == found.end() ? (row.preset.empty() ? absent : row.preset[0]) : value->second.numbers[0];
}

// One campaign: plain values, then what it disperses and asks.
class CampaignReader {
 public:
  CampaignReader(const std::string& name, const toml::table& table, const toml::table& root, MissionSource& source, ProblemList& problems)
      : table_(table),
        root_(root),
        source_(source),
        problems_(problems),
        prefix_("campaign." + name + "."),
        dispersions_(source, problems) {
    campaign_.name = name;
  }

  void read() {
    read_values();
    if (const toml::table* truth = sub_table("truth")) read_truth(*truth);
    if (const toml::table* mission = sub_table("mission")) read_mission(*mission, "");
    read_all_together();
    if (const toml::table* criteria = sub_table("criteria")) read_criteria(*criteria);
    campaign_.dispersions = dispersions_.take();
    source_.campaigns[campaign_.name] = std::move(campaign_);
  }

 private:
  void read_values() {
    const FoundValues found = read_table(table_, prefix_, campaign_rows(), {"truth", "mission", "together", "criteria"}, problems_);
    for (const ValueRow& row : campaign_rows()) note_origin(prefix_ + row.key, found, row.key);
    const auto number = [&](const char* key) { return number_in(found, *find_row(campaign_rows(), key), 0); };
    campaign_.cases = static_cast<std::uint32_t>(number("cases"));
    campaign_.seed = static_cast<std::uint64_t>(number("seed"));
    campaign_.frames = static_cast<std::uint32_t>(number("frames"));
    campaign_.sampling = static_cast<Sampling>(static_cast<int>(number("sampling")));
    campaign_.sensor = find_row(campaign_rows(), "sensor")->choices.at(static_cast<std::size_t>(number("sensor")));
    campaign_.look_every = static_cast<std::uint32_t>(number("look_every"));
    if (const std::vector<std::string> scenario = texts_of(found, "scenario"); !scenario.empty()) check_scenario(scenario.front(), found);
  }
  void note_origin(const std::string& key, const FoundValues& found, const std::string& found_key) {
    const auto value = found.find(found_key);
    source_.origins[key] = value == found.end() ? Origin{} : value->second.origin;
  }
  void check_scenario(const std::string& name, const FoundValues& found) {
    campaign_.scenario = name;
    std::vector<std::string> names;
    if (const toml::table* scenarios = root_["scenario"].as_table()) {
      for (const auto& [key, node] : *scenarios) names.emplace_back(key.str());
    }
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    std::string known;
    for (const std::string& each : names) known += (known.empty() ? "; the mission has " : ", ") + each;
    const std::string meant = did_you_mean(name, names);
    problems_.add(found.at("scenario").origin, prefix_ + "scenario", '"' + name + '"',
                  "no such scenario" + (meant.empty() ? known : meant));
  }

  const toml::table* sub_table(const std::string& name) {
    const toml::node* node = table_.get(name);
    if (node != nullptr && !node->is_table()) problems_.add(*node, prefix_ + name, "wrong type: expected a table [" + prefix_ + name + "]");
    return node == nullptr ? nullptr : node->as_table();
  }

  void read_truth(const toml::table& table) {
    for (const auto& [key, node] : table) {
      const std::string name(key.str()), whole = prefix_ + "truth." + name;
      if (name == "attitude") {
        read_attitude(node, whole);
      } else if (name == kFaultsKey) {
        read_faults(node, whole);
      } else if (const ValueRow* row = find_row(truth_rows(), name)) {
        read_key(node, *row, "truth." + name, whole);
      } else {
        std::vector<std::string> known = keys_of(truth_rows());
        known.emplace_back("attitude");
        known.emplace_back(kFaultsKey);
        refuse_key(key, name, whole, known, "a key of a scenario, range_m or attitude");
      }
    }
  }
  void read_attitude(const toml::node& node, const std::string& whole) {
    if (node.value_exact<std::string>() != "any")
      return problems_.add(
          node, whole,
          "expected \"any\": each attitude is as likely as any other; or write roll_deg, tilt_deg and boresight_deg, each with a law");
    dispersions_.add({attitude_columns(), AnyAttitude{}}, whole, origin_of(node.source()));
  }
  // Scripts, each as likely as any other.
  void read_faults(const toml::node& node, const std::string& whole) {
    ValueRow row;
    row.kind = ValueKind::kText;
    row.pattern = "[^\\x00-\\x1f]+";
    row.count_max = 1000;
    row.meaning = "scripts of camera faults (docs/user-guide.md), from the mission's folder or the one above: each case has one of them";
    const auto found = read_value(node, row, whole, problems_);
    if (!found) return;
    if (campaign_.sensor == "simulated")
      problems_.add(found->origin, whole, "", "only a camera on its line fails by a script: add sensor = \"lcs-wire\" to the campaign");
    OneOf law;
    for (const std::string& written : found->texts) {
      add_script(written, whole, found->origin);
      law.values.push_back(static_cast<double>(law.values.size()));
    }
    law.weights.assign(law.values.size(), 1);
    dispersions_.add({{std::string("truth.") + kFaultsKey}, NumberLaw(law)}, whole, found->origin);
  }
  void add_script(const std::string& written, const std::string& whole, Origin origin) {
    std::filesystem::path file;
    const bool is_there = find_beside(source_, written, file);
    campaign_.fault_scripts.push_back(file.string());
    if (!is_there) return problems_.add(origin, whole, '"' + written + '"', "no such file beside the mission or in the folder above");
    try {
      static_cast<void>(load_camera_faults(file));
    } catch (const MissionError& error) {
      problems_.add(error);
    }
  }
  void refuse_key(const toml::key& key, const std::string& name, const std::string& whole, const std::vector<std::string>& known,
                  const char* expected) {
    const std::string old = remedy_of_old_key(name);
    if (!old.empty()) return problems_.add(origin_of(key.source()), whole, "", old);
    const char* const remedy = not_varied(name);
    const std::string meant = did_you_mean(name, known);
    problems_.add(origin_of(key.source()), whole, "",
                  remedy != nullptr ? std::string("does not vary from case to case: ") + remedy
                                    : "unknown key" + (meant.empty() ? std::string("; expected ") + expected : meant));
  }

  // Dotted keys are tables in tables.
  void read_mission(const toml::table& table, const std::string& path) {
    for (const auto& [key, node] : table) {
      const std::string name = path + std::string(key.str()), whole = prefix_ + "mission." + name;
      if (const ValueRow* row = find_row(belief_rows(), name)) {
        read_key(node, *row, "mission." + name, whole);
      } else if (is_section(name) && node.is_table()) {
        read_mission(*node.as_table(), name + ".");
      } else {
        refuse_key(key, name, whole, keys_of(belief_rows()), "a flight parameter, such as estimation.surface_sigma_m");
      }
    }
  }
  static bool is_section(const std::string& name) {
    return std::any_of(flight_rows().begin(), flight_rows().end(), [&](const ValueRow& row) { return row.key.rfind(name + ".", 0) == 0; });
  }

  // One law; of a list one for each of its numbers, or one of its direction.
  void read_key(const toml::node& node, const ValueRow& row, const std::string& column, const std::string& whole) {
    const std::vector<std::string> columns = columns_of(column, row);
    const toml::table* table = node.as_table();
    if (row.kind != ValueKind::kReals) {
      read_number(node, row, column, whole);
    } else if (table != nullptr && table->contains(kDirection)) {
      read_direction(*table, row, columns, whole);
    } else {
      read_list(node, row, columns, whole);
    }
  }
  void read_number(const toml::node& node, const ValueRow& row, const std::string& column, const std::string& whole) {
    if (const auto law = read_law(node, row, whole, problems_)) dispersions_.add({{column}, *law}, whole, origin_of(node.source()));
  }
  void read_list(const toml::node& node, const ValueRow& row, const std::vector<std::string>& columns, const std::string& whole) {
    const toml::array* items = node.as_array();
    if (items == nullptr || items->size() != columns.size())
      return problems_.add(node, whole,
                           "expected a list of " + std::to_string(columns.size()) + ", each a number or a law" +
                               (columns.size() == 3 ? ", or { any_direction = LAW }" : ""));
    for (std::size_t i = 0; i < columns.size(); ++i) read_number((*items)[i], row, columns[i], whole + "[" + std::to_string(i) + "]");
  }
  void read_direction(const toml::table& table, const ValueRow& row, const std::vector<std::string>& columns, const std::string& whole) {
    if (columns.size() != 3 || table.size() != 1)
      return problems_.add(table, whole, "expected { any_direction = LAW }, of a list of three numbers, and nothing else in it");
    ValueRow length = row;
    length.minimum = 0;
    length.meaning = "length of the vector";
    if (const auto law = read_law(*table.get(kDirection), length, whole + "." + kDirection, problems_))
      dispersions_.add({columns, AnyDirection{*law}}, whole, origin_of(table.source()));
  }

  void read_all_together() {
    const toml::node* node = table_.get("together");
    if (node == nullptr) return;
    const toml::array* entries = node->as_array();
    if (entries == nullptr || !entries->is_array_of_tables())
      return problems_.add(*node, prefix_ + "together", "wrong type: expected [[" + prefix_ + "together]], a table for each law");
    for (std::size_t i = 0; i < entries->size(); ++i)
      read_together(*(*entries)[i].as_table(), prefix_ + "together[" + std::to_string(i) + "]", dispersions_);
  }

  void read_criteria(const toml::table& table) {
    for (const auto& [key, node] : table) {
      const std::string name(key.str()), whole = prefix_ + "criteria." + name;
      if (const toml::table* criterion = node.as_table()) {
        read_criterion(name, *criterion, whole + ".");
      } else {
        problems_.add(node, whole, "wrong type: expected a table [" + whole + "]");
      }
    }
  }
  void read_criterion(const std::string& name, const toml::table& table, const std::string& prefix) {
    const FoundValues found = read_table(table, prefix, criterion_rows(), {}, problems_);
    for (const ValueRow& row : criterion_rows()) note_origin(prefix + row.key, found, row.key);
    constexpr double kNone = std::numeric_limits<double>::infinity();
    const auto number = [&](const char* key, double absent) { return number_in(found, *find_row(criterion_rows(), key), absent); };
    Criterion criterion{name, "", number("at_least", -kNone), number("at_most", kNone), number("share_min", 0.5), number("confidence", 0)};
    const auto figure = found.find("figure");
    if (figure != found.end()) criterion.figure = criterion_rows()[0].choices.at(static_cast<std::size_t>(figure->second.numbers[0]));
    check_criterion(criterion, found, table, prefix);
    campaign_.criteria.push_back(criterion);
  }
  void check_criterion(const Criterion& c, const FoundValues& found, const toml::table& table, const std::string& prefix) {
    const auto complain = [&](const char* key, double value, const std::string& why) {
      problems_.add(found.at(key).origin, prefix + key, number_text(value), why);
    };
    if (c.figure == "first_wrong")
      problems_.add(
          found.at("figure").origin, prefix + "figure", c.figure,
          "has no number where no pose is wrong, so that good cases would count as outside: ask for figure = \"wrong\", at_most = 0");
    const bool least = found.count("at_least") != 0, most = found.count("at_most") != 0;
    if (!least && !most)
      problems_.add(origin_of(table.source()), prefix + "at_most", "",
                    "is missing: expected a bound of the figure, at_least, at_most or both");
    if (least && most && c.at_least > c.at_most)
      complain("at_least", c.at_least, "expected at most at_most, which is " + number_text(c.at_most));
    if (!(c.share_min > 0 && c.share_min < 1))
      complain("share_min", c.share_min, "expected more than 0 and less than 1: no number of cases shows that all possible ones are good");
    if (!(c.confidence > 0.5 && c.confidence < 1))
      complain("confidence", c.confidence, "expected more than 0.5 and less than 1, such as 0.95");
  }

  const toml::table& table_;
  const toml::table& root_;
  MissionSource& source_;
  ProblemList& problems_;
  std::string prefix_;
  Dispersions dispersions_;
  CampaignSource campaign_;
};

bool is_plain_name(std::string_view name) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
  return !name.empty() && name.size() <= 64 && name.find_first_not_of(kPlain) == std::string_view::npos;
}

}  // namespace

void Dispersions::add(Dispersion dispersion, const std::string& key, Origin origin) {
  source_.origins[key] = origin;
  for (const std::string& column : dispersion.columns) {
    const auto [other, is_new] = keys_.emplace(column, key);
    if (!is_new) problems_.add(origin, key, column, "has a law already, of " + other->second + ": delete one of the two");
  }
  dispersion.key = key;
  all_.push_back(std::move(dispersion));
}

void read_campaigns(const toml::table& root, MissionSource& source, ProblemList& problems) {
  const toml::node* node = root.get("campaign");
  if (node == nullptr) return;
  if (!node->is_table()) return problems.add(*node, "campaign", "wrong type: expected tables [campaign.NAME]");
  for (const auto& [name, entry] : *node->as_table()) {
    const std::string key = "campaign." + std::string(name.str());
    if (!is_plain_name(name.str())) {
      problems.add(origin_of(name.source()), "campaign", '"' + std::string(name.str()) + '"',
                   "expected a name of letters, digits, - and _, at most 64: it becomes that of a folder");
    } else if (const toml::table* table = entry.as_table()) {
      CampaignReader(std::string(name.str()), *table, root, source, problems).read();
    } else {
      problems.add(entry, key, "wrong type: expected a table [" + key + "]");
    }
  }
}

}  // namespace lasso::mdat
