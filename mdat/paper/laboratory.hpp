// The laboratory test of the paper, simulated: a mock-up on a turntable, some ranges, stands a step apart, some scans each; and its budget.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mdat/common/flight_image.hpp"
#include "mdat/paper/budget.hpp"
#include "mdat/paper/stand.hpp"
#include "mdat/run/statistics.hpp"

namespace lasso::mdat {

struct LaboratoryOptions {
  std::optional<std::uint32_t> frames;  // of a stand; otherwise the scenario's
  std::uint32_t stands = 24;            // of a full turn: 15 degrees apart, as in the paper
  std::uint32_t mock_ups = 4;           // each of its own errors
  unsigned jobs = 1;                    // stands at a time; the results do not depend on it
};

// What is judged. kZ, kTurn: the mean estimate of a stand against the truth. kZStep, kTurnStep: against that of the stand before, as can be
// done without a truth; of the turn the commanded step is taken away.
enum class LaboratoryFigure : std::uint8_t { kZ, kTurn, kZStep, kTurnStep };
constexpr std::size_t kLaboratoryFigures = 4;

struct StandResult {
  Pose truth;
  std::size_t frames = 0, lost = 0, invalid = 0;    // as RunStatistics'
  std::optional<StandMean> mean;                    // of the frames that are not lost; none: all are
  std::array<double, kLaboratoryFigures> errors{};  // m or rad; not a number where there is none
};

struct LaboratoryRange {
  std::string scenario;
  double range_m = 0;
  std::vector<StandResult> stands;                                // those of the first mock-up, then those of the next
  std::vector<std::array<Variances, kLaboratoryFigures>> budget;  // of each stand of a turn, m^2 or rad^2
};

struct LaboratoryResult {
  std::uint32_t frames = 0, stands = 0, mock_ups = 0;  // of a stand; of a turn; of the test
  std::vector<Scenario> scenarios;
  std::vector<LaboratoryRange> ranges;
  TimeStatistics time;  // of the estimates
  double seconds = 0;
};

constexpr double kBudgetRatioMax = 1.1;  // of measured errors over the budget

// Errors of one figure, over stands and mock-ups of one range, or of all; and the root mean square that the budget says.
struct FigureErrors {
  std::size_t count = 0;
  double mean_abs = 0, std_abs = 0;  // of the absolute errors
  double rms = 0, budget = 0;
  std::array<double, kBudgetSources> budget_by_source{};  // roots of the mean variances
  double ratio() const { return rms / budget; }
  bool held() const { return ratio() <= kBudgetRatioMax; }
};
FigureErrors figure_errors(const LaboratoryResult& result, LaboratoryFigure figure, std::optional<std::size_t> range = {});

// Flies every scenario of the mission, which have variants: their frames are those of a stand, and the target is turned about its x
// axis between stands. Each stand is a run of its own, that begins with a track at the truth. Throws MissionError (one without
// scenario, or none), InputError or RunError.
LaboratoryResult fly_laboratory(const CompiledMission& mission, const LaboratoryOptions& options);

// Refuses what fly_laboratory would, before anything is compiled.
void check_laboratory(const MissionSource& source);

// The budget of a stand's figures, by stand: from the mission's assumptions and the planned scans alone.
std::vector<std::array<Variances, kLaboratoryFigures>> laboratory_budget(const CompiledMission& mission, const std::string& scenario,
                                                                         std::size_t range, const LaboratoryOptions& options);

}  // namespace lasso::mdat
