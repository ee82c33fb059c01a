// endurance MISSION FILE HOURS SEED [POINTS]: one flight of many hours before the simulated scanner, with its noise, the target turning at
// 2 deg/s about a general axis at 4 m. Writes a row for each tenth of an hour into FILE (CSV): poses, those that are wrong, their errors,
// slips, drops, the queue's peak, how far the frames are from the clock, and the memory of the process.
//
// POINTS is the scan's; fewer than the mission's make a day fit into minutes.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>

#include "ft/campaign/draws.hpp"
#include "ft/campaign/main_of.hpp"
#include "ft/campaign/verdict.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::campaign {
namespace {

constexpr const char* kScenario = "spin";  // its flight parameters
constexpr double kRange_m = 4, kSpin_radps = 2 * kRadPerDeg;
constexpr std::uint32_t kRowsPerHour = 10;

struct Row {
  std::uint32_t reported = 0, valid = 0, wrong = 0;
  double sum_m2 = 0, sum_rad2 = 0, worst_m = 0;
  PoseTelemetry last;
};

void note(const PoseTelemetry& pose, const Pose& truth, Row& row) {
  ++row.reported;
  row.last = pose;
  if (pose.valid == 0) return;
  ++row.valid;
  const mdat::PoseError error = mdat::pose_error(mdat::registration_pose(pose), truth);
  row.sum_m2 += error.translation_m.squaredNorm();
  row.sum_rad2 += error.rotation_rad * error.rotation_rad;
  row.worst_m = std::max(row.worst_m, error.translation_m.norm());
  row.wrong += judge_valid(pose, truth) == PoseVerdict::kWrong ? 1U : 0U;
}

// Pages of the process that are in memory; 0 where the system does not say.
long resident_pages() {
  std::ifstream file("/proc/self/statm");
  long all = 0;
  long resident = 0;
  file >> all >> resident;
  return resident;
}

sim::TruthState initial_state(std::uint64_t seed) {
  sim::Random random(seed);
  sim::TruthState state;
  state.T_sensor_target.q = draw_attitude(random);
  state.T_sensor_target.p = Vec3(0.02, -0.03, kRange_m);
  state.rates.omega_radps = kSpin_radps * draw_direction(random);
  return state;
}

std::string text_of(std::uint32_t index, const Row& row, DurationUs drift_us) {
  char text[240];
  const double n = std::max(1U, row.valid);
  (void)std::snprintf(text, sizeof text, "%.1f,%u,%u,%u,%.4f,%.5f,%.3f,%u,%u,%u,%lld,%ld\n", (index + 1.0) / kRowsPerHour, row.reported,
                      row.valid, row.wrong, 1e3 * std::sqrt(row.sum_m2 / n), std::sqrt(row.sum_rad2 / n) / kRadPerDeg, 1e3 * row.worst_m,
                      row.last.slot_slips, row.last.dropped_packets, row.last.overruns, static_cast<long long>(drift_us), resident_pages());
  return text;
}

std::string fly(const char* mission_file, std::uint32_t hours, std::uint64_t seed, std::uint32_t points) {
  const mdat::CompiledMission mission = mdat::compile_mission(mission_file);
  MissionParameters parameters = mdat::parameters_for(mission.source, kScenario);
  parameters.initial_present = 0;
  if (points > 0) parameters.points = points;
  const std::vector<std::uint8_t> image = mdat::image_bytes(mission, parameters);
  const auto target = mdat::make_target(mission.mesh);
  const sim::ScannerModel model = mdat::scanner_model(mdat::scenario_of(mission.source, kScenario), parameters, true);
  const sim::ConstantTwist truth(initial_state(seed), mdat::kEpochUs);
  sim::SimulatedScanner scanner(*target, truth, model, seed);
  std::vector<std::uint64_t> memory = mdat::aligned_copy(image);
  const auto component = std::make_unique<Component>(scanner);
  begin(*component, mdat::view(memory, image.size()));
  start_tracking(*component, truth.at(mdat::kEpochUs).T_sensor_target);

  const auto period_us = static_cast<DurationUs>(parameters.period_s * 1e6 + 0.5);
  const auto frames_a_row = static_cast<std::uint32_t>(3600e6 / kRowsPerHour / static_cast<double>(period_us));
  std::string table = "hours,reported,valid,wrong,rms_mm,rms_deg,worst_mm,slips,dropped,overruns,drift_us,resident_pages\n";
  const std::uint32_t rows = hours * kRowsPerHour;
  for (std::uint32_t index = 0; index < rows; ++index) {
    Row row;
    for (std::uint32_t frame = 0; frame < frames_a_row; ++frame) {
      const std::vector<std::uint8_t> telemetry = run_frame(*component);
      for (const PoseTelemetry& pose : decode(ConstBytes(telemetry.data(), telemetry.size())).poses) {
        note(pose, truth.at(pose.t_measurement_us).T_sensor_target, row);
      }
    }
    const auto flown = static_cast<std::int64_t>(index + 1) * static_cast<std::int64_t>(frames_a_row);
    table += text_of(index, row, component->next_slot_us() - mdat::kEpochUs - flown * period_us);
    if (index % kRowsPerHour == kRowsPerHour - 1) (void)std::fprintf(stderr, "%u of %u hours\n", (index + 1) / kRowsPerHour, hours);
  }
  return table;
}

}  // namespace
}  // namespace lasso::campaign

int main(int argc, char** argv) { return lasso::campaign::main_of({"endurance", "HOURS", "POINTS"}, argc, argv, lasso::campaign::fly); }
