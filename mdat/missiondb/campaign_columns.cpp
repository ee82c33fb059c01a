#include "mdat/missiondb/campaign_columns.hpp"

#include <algorithm>
#include <stdexcept>

#include "mdat/missiondb/sections.hpp"

namespace lasso::mdat {
namespace {

constexpr char kTruth[] = "truth.", kMission[] = "mission.", kRangeColumn[] = "truth.range_m";

struct NotVaried {
  const char* key;
  const char* remedy;
};
constexpr char kShared[] =
    "the simulated sensor and its clock follow it, so that belief and truth would vary together: write a mission for each value";
constexpr NotVaried kNotVaried[] = {
    {"autonomous", "such a flight is another scenario: write a campaign for each"},
    {"variants", "a case flies one: write a campaign for each"},
    {"frames", "write frames = NUMBER in the campaign itself: all its cases have as many"},
    {"seed", "each case has a seed of its own; write seed = NUMBER in the campaign itself for other cases"},
    {"drawn", "write attitude = \"any\", and spin_degps = { any_direction = LAW }"},
    {"paper_table", "it is of a report's pages"},
    {"ranges_m", "a case flies at one range: write range_m"},
    {"times_s", "it belongs to the profile of the scenario"},
    {"sensor.range_min_m", kShared},
    {"sensor.range_max_m", kShared},
    {"sensor.fov_half_x_deg", kShared},
    {"sensor.fov_half_y_deg", kShared},
    {"filter.period_s", kShared},
};

ValueRow range_row() {
  ValueRow row = *find_row(scenario_rows(), "ranges_m");
  row.key = "range_m";
  row.kind = ValueKind::kReal;
  row.count_min = row.count_max = 1;
  row.meaning = "range of the target's center_m along the boresight";
  return row;
}

// Of "truth.camera_faults".
CampaignColumn faults_column() {
  constexpr double kMostScripts = 1000;
  ValueRow row;
  row.key = kFaultsKey;
  row.kind = ValueKind::kInteger;
  row.unit = "1";
  row.maximum = kMostScripts - 1;
  row.meaning = "number of the script of faults, from 0";
  return {std::string(kTruth) + kFaultsKey, row, 0};
}

void add_columns(const std::string& prefix, const std::vector<ValueRow>& rows, std::vector<CampaignColumn>& columns) {
  for (const ValueRow& row : rows) {
    std::size_t item = 0;
    for (const std::string& name : columns_of(prefix + row.key, row)) columns.push_back({name, row, item++});
  }
}

std::vector<ValueRow> varied(const std::vector<ValueRow>& rows, std::vector<ValueRow> result) {
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(result), [](const ValueRow& row) { return not_varied(row.key) == nullptr; });
  return result;
}

const ScenarioField& field_of(const std::string& key) {
  const auto is_it = [&](const ScenarioField& field) { return field.row.key == key; };
  return *std::find_if(scenario_fields().begin(), scenario_fields().end(), is_it);
}

}  // namespace

const std::vector<ValueRow>& truth_rows() {
  static const std::vector<ValueRow> rows = varied(scenario_rows(), {range_row()});
  return rows;
}

const std::vector<ValueRow>& belief_rows() {
  static const std::vector<ValueRow> rows = varied(flight_rows(), {});
  return rows;
}

const std::vector<CampaignColumn>& campaign_columns() {
  static const std::vector<CampaignColumn> columns = [] {
    std::vector<CampaignColumn> result;
    add_columns(kTruth, truth_rows(), result);
    result.push_back(faults_column());
    add_columns(kMission, belief_rows(), result);
    return result;
  }();
  return columns;
}

const CampaignColumn* find_column(const std::string& name) {
  const auto& all = campaign_columns();
  const auto found = std::find_if(all.begin(), all.end(), [&](const CampaignColumn& column) { return column.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> columns_of(const std::string& key, const ValueRow& row) {
  if (row.kind != ValueKind::kReals) return {key};
  constexpr std::size_t kAxes = 3;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < row.count_max; ++i) {
    names.push_back(key + "." + (row.count_max <= kAxes ? std::string(1, "xyz"[i]) : std::to_string(i + 1)));
  }
  return names;
}

const char* not_varied(const std::string& key) {
  const auto found = std::find_if(std::begin(kNotVaried), std::end(kNotVaried), [&](const NotVaried& row) { return key == row.key; });
  return found == std::end(kNotVaried) ? nullptr : found->remedy;
}

std::vector<std::string> attitude_columns() { return {"truth.roll_deg", "truth.tilt_deg", "truth.boresight_deg"}; }

void set_column(Scenario& scenario, const std::string& column, double value) {
  const CampaignColumn* found = find_column(column);
  if (found == nullptr) throw std::invalid_argument(column + ": names nothing that a campaign may vary");
  if (column == kRangeColumn) {
    scenario.ranges_m = {value};
  } else if (found->row.key == kFaultsKey) {
    scenario.fault_script = value;
  } else if (column.rfind(kMission, 0) == 0) {
    scenario.overrides[found->row.key] = value;
  } else if (const ScenarioField& field = field_of(found->row.key); field.list != nullptr) {
    (scenario.*field.list).at(found->item) = value * field.row.to_si;
  } else {
    scenario.*field.number = value * field.row.to_si;
  }
}

}  // namespace lasso::mdat
