// What a run leaves for programs (results.json) and says on the terminal.
#pragma once

#include <string>
#include <vector>

#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// Keys as in docs/user-guide.md: mission, scenario, seed, version, one object a variant; `side_on` with the same ones; `paper_2005` with
// scenario.paper_table.
std::string results_json(const SimulationResult& result);

// The tables for a person: the paper's beside this run's, then accuracy over the bound, honesty, losses and time.
std::string summary_text(const SimulationResult& result);

// Does the paper's table stand beside this one?
bool is_beside_paper(const TableResult& table);

// A line for each variant that has valid poses which are wrong: nobody should have to look for them.
std::vector<std::string> warnings_of(const TableResult& table);

// "tilt 15 deg", or that each run has one of its own.
std::string attitude_text(const Scenario& scenario);

// "6 ranges from 2 to 7 m"; where the motion is drawn, runs are flights: "12 flights at 4 m".
std::string runs_text(const Scenario& scenario);

// One of them: "4 m"; "flight 3, 4 m".
std::string run_text(const Scenario& scenario, std::size_t run);

// The six error axes with their names and units.
struct ErrorAxis {
  const char* key;   // "x_mm"
  const char* name;  // "X"
  const char* unit;  // "mm"
  MeanStd ErrorStatistics::*member;
};
constexpr ErrorAxis kErrorAxes[] = {{"x_mm", "X", "mm", &ErrorStatistics::x_mm},
                                    {"y_mm", "Y", "mm", &ErrorStatistics::y_mm},
                                    {"z_mm", "Z", "mm", &ErrorStatistics::z_mm},
                                    {"yaw_deg", "yaw", "deg", &ErrorStatistics::yaw_deg},
                                    {"pitch_deg", "pitch", "deg", &ErrorStatistics::pitch_deg},
                                    {"roll_deg", "roll", "deg", &ErrorStatistics::roll_deg}};

}  // namespace lasso::mdat
