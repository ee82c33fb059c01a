#include "mdat/missiondb/campaign_values.hpp"

#include <algorithm>
#include <cstring>

#include "mdat/missiondb/sections.hpp"

namespace lasso::mdat {
namespace {

constexpr char kTruth[] = "truth.", kBelief[] = "mission.", kRange[] = "range_m";
constexpr const char* kElements[] = {".x", ".y", ".z", ".4", ".5", ".6"};  // the first three have numbers as well

// What makes a scenario another one, or what the table of cases says in another way.
constexpr const char* kNotVaried[] = {"kind", "frames", "seed", "drawn", "paper_table", "ranges_m", "times_s"};

// What the simulated sensor, or the clock, takes from the image: the truth would follow the belief.
constexpr const char* kShared[] = {"sensor.range_min_m", "sensor.range_max_m", "sensor.fov_half_x_deg", "sensor.fov_half_y_deg",
                                   "filter.period_s"};

template <std::size_t n>
bool is_one_of(const std::string& key, const char* const (&keys)[n]) {
  return std::any_of(std::begin(keys), std::end(keys), [&](const char* other) { return key == other; });
}

const ScenarioField* field_of(const std::string& key) {
  const std::vector<ScenarioField>& fields = scenario_fields();
  const auto field = std::find_if(fields.begin(), fields.end(), [&](const ScenarioField& entry) { return entry.row.key == key; });
  return field == fields.end() || is_one_of(key, kNotVaried) ? nullptr : &*field;
}

const ParameterRow* parameter_of(const std::string& key) {
  const auto rows = parameter_rows();
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const ParameterRow& entry) { return key == entry.key; });
  return row == rows.end() || is_one_of(key, kShared) ? nullptr : &*row;
}

// "offset_m.y": "offset_m", 1.
CampaignColumn truth_column(const std::string& key) {
  if (key == kRange) return {true, key, 0};
  const ScenarioField* whole = field_of(key);
  if (whole != nullptr) return whole->list == nullptr ? CampaignColumn{true, key, 0} : CampaignColumn{};
  for (std::size_t element = 0; element < std::size(kElements); ++element) {
    const std::string list = key.substr(0, key.size() - std::min(key.size(), std::strlen(kElements[element])));
    const ScenarioField* field = key == list + kElements[element] ? field_of(list) : nullptr;
    if (field != nullptr && field->list != nullptr && element < field->row.count_max) return {true, list, element};
  }
  return {};
}

}  // namespace

CampaignColumn campaign_column(const std::string& column) {
  if (column.rfind(kTruth, 0) == 0) return truth_column(column.substr(std::strlen(kTruth)));
  if (column.rfind(kBelief, 0) != 0) return {};
  const std::string key = column.substr(std::strlen(kBelief));
  return parameter_of(key) == nullptr ? CampaignColumn{} : CampaignColumn{false, key, 0};
}

std::string campaign_column_name(bool truth, const std::string& key, std::size_t element) {
  return (truth ? kTruth : kBelief) + key + kElements[element];
}

void set_campaign_value(const std::string& column, double value, Scenario& scenario) {
  const CampaignColumn place = campaign_column(column);
  if (place.key.empty()) throw std::invalid_argument(column + ": names nothing that a campaign may vary");
  if (!place.truth) {
    scenario.overrides[place.key] = value;
  } else if (place.key == kRange) {
    scenario.ranges_m = {value};
  } else {
    const ScenarioField& field = *field_of(place.key);
    (field.list != nullptr ? (scenario.*field.list).at(place.element) : scenario.*field.number) = value * field.row.to_si;
  }
}

}  // namespace lasso::mdat
