// The columns of a campaign's table of cases: which numbers of a mission may vary, how they are named, and where they go.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {

// One number: "truth.range_m", "truth.spin_degps.x", "mission.estimation.surface_sigma_m".
struct CampaignColumn {
  std::string name;
  ValueRow row;          // of the key: its unit and range; of "truth.range_m" those of the scenario's ranges_m
  std::size_t item = 0;  // of a list
};

// All that there are: of the scenario first, then the flight parameters.
const std::vector<CampaignColumn>& campaign_columns();

// nullptr if there is none.
const CampaignColumn* find_column(const std::string& name);

// The names of all columns of `key` ("truth.offset_m": "truth.offset_m.x", "truth.offset_m.y"), in the order of the list; of one number the
// key itself.
std::vector<std::string> columns_of(const std::string& key, const ValueRow& row);

// The keys of [campaign.NAME.truth] that have a law of numbers, "attitude" apart.
const std::vector<ValueRow>& truth_rows();

// Those of [campaign.NAME.mission].
const std::vector<ValueRow>& belief_rows();

// Which of a campaign's scripts of faults a case has, from 0: a number of its own beside those keys.
constexpr char kFaultsKey[] = "camera_faults";

// Why a key of a scenario, or a flight parameter, does not vary, and what to write instead; nullptr if it does, or is none.
const char* not_varied(const std::string& key);

// The columns of an attitude.
std::vector<std::string> attitude_columns();

// Puts a value, in the unit that the column's name says, into the scenario of a case: what is simulated into the scenario itself, what the
// component believes into its overrides. Throws std::invalid_argument where the column is none.
void set_column(Scenario& scenario, const std::string& column, double value);

}  // namespace lasso::mdat
