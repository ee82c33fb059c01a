// The values that a case of a campaign has in place of its mission's, by the names of their columns (campaign_source.hpp).
#pragma once

#include <string>

#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// "truth.spin_degps.y" or "mission.scan.points", taken apart.
struct CampaignColumn {
  bool truth = false;
  std::string key;          // of the scenario's rows, or the flight parameters'; "range_m" for the scenario's one range
  std::size_t element = 0;  // of a list
};
// Where `column` names nothing that a campaign may vary, the key is empty.
CampaignColumn campaign_column(const std::string& column);

// The column of a list's number.
std::string campaign_column_name(bool truth, const std::string& key, std::size_t element);

// Puts a value, in the unit that the column's name says, into the scenario of a case: what is simulated into the scenario itself, what the
// component believes into its overrides. Throws std::invalid_argument where the column is none.
void set_campaign_value(const std::string& column, double value, Scenario& scenario);

}  // namespace lasso::mdat
