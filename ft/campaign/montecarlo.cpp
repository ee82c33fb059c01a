// montecarlo MISSION FILE FLIGHTS SEED [FIRST]: closed-loop flights of the whole component before the simulated scanner, each drawn at
// random: attitude, place, spin, drift, noise, outliers, dropouts, start. Writes a row for each flight into FILE (CSV). What a flight draws
// depends on SEED and its number alone: FLIGHTS = 1 and FIRST repeat one of them.
#include <atomic>
#include <cstdio>
#include <fstream>
#include <memory>
#include <thread>

#include "ft/campaign/draws.hpp"
#include "ft/campaign/main_of.hpp"
#include "ft/campaign/verdict.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::campaign {
namespace {

constexpr std::uint32_t kFrames = 25;
constexpr const char* kScenario = "spin";  // its flight parameters; all else is drawn
constexpr double kStart_rad = 2 * kRadPerDeg, kStart_m = 0.02;
constexpr double kSpin_radps = 5 * kRadPerDeg, kDrift_mps = 0.02;

struct Draw {
  sim::TruthState initial;
  Pose start;
  sim::ScannerModel scanner;
  double noise = 1;  // times what the estimator assumes
  std::uint64_t seed = 0;
};

Draw draw_flight(std::uint64_t seed, std::uint32_t flight, sim::ScannerModel scanner) {
  sim::Random random = trial_stream(seed, flight);
  Draw draw;
  draw.initial.T_sensor_target.q = draw_attitude(random);
  const double range_m = random.uniform(2, 7);
  draw.initial.T_sensor_target.p = Vec3(random.uniform(-0.02, 0.02) * range_m, random.uniform(-0.02, 0.02) * range_m, range_m);
  draw.initial.rates.omega_radps = random.uniform() * kSpin_radps * draw_direction(random);
  draw.initial.rates.v_mps = kDrift_mps * draw_in_box(random);
  if (flight % 2 == 0) draw.initial.rates = {};  // every second target stands still
  draw.start = disturbed(draw.initial.T_sensor_target, kStart_rad, kStart_m, random);
  draw.noise = random.uniform(0.5, 1.5);
  scanner.sigma0_m *= draw.noise;
  scanner.sigma_k_per_m *= draw.noise;
  scanner.outlier_probability = random.uniform(0, 0.15);
  scanner.dropout_probability = random.uniform(0, 0.15);
  draw.scanner = scanner;
  draw.seed = random.bits();
  return draw;
}

struct Result {
  std::uint32_t reported = 0, lost = 0, invalid = 0, covered = 0, wrong = 0;
  double worst_m = 0, worst_rad = 0;  // of valid registrations
  double nees = 0;                    // sum over valid poses that are not wrong
  std::int32_t first_wrong = -1;      // report
};

void note(const PoseTelemetry& pose, const Pose& truth, Result& result) {
  if (static_cast<StopReason>(pose.stop) == StopReason::kNotRun) {
    ++result.lost;
    return;
  }
  ++result.reported;
  if (pose.valid == 0) {
    ++result.invalid;
    return;
  }
  const mdat::PoseError error = mdat::pose_error(mdat::registration_pose(pose), truth);
  result.worst_m = std::max(result.worst_m, error.translation_m.norm());
  result.worst_rad = std::max(result.worst_rad, error.rotation_rad);
  const PoseVerdict verdict = judge_valid(pose, truth);
  result.covered += verdict == PoseVerdict::kCovered ? 1 : 0;
  if (verdict != PoseVerdict::kWrong) {
    result.nees += mdat::nees(mdat::registration_pose(pose), truth, mdat::registration_covariance(pose));
  } else if (result.wrong++ == 0) {
    result.first_wrong = static_cast<std::int32_t>(result.reported) - 1;
  }
}

Result fly(const std::vector<std::uint8_t>& image, const sim::RayCaster& target, const Draw& draw) {
  const sim::ConstantTwist truth(draw.initial, mdat::kEpochUs);
  sim::SimulatedScanner scanner(target, truth, draw.scanner, draw.seed);
  std::vector<std::uint64_t> memory = mdat::aligned_copy(image);
  const auto component = std::make_unique<Component>(scanner);
  begin(*component, mdat::view(memory, image.size()));
  start_tracking(*component, draw.start);
  Result result;
  for (std::uint32_t frame = 0; frame < kFrames + kPipelineFrames; ++frame) {
    const std::vector<std::uint8_t> telemetry = run_frame(*component);
    for (const PoseTelemetry& pose : decode(ConstBytes(telemetry.data(), telemetry.size())).poses) {
      note(pose, truth.at(pose.t_measurement_us).T_sensor_target, result);
    }
  }
  return result;
}

std::string row(std::uint32_t flight, const Draw& draw, const Result& result) {
  char text[320];
  (void)std::snprintf(text, sizeof text, "%u,%.3f,%.3f,%.2f,%.3f,%.3f,%u,%u,%u,%u,%u,%d,%.3f,%.4f,%.4f\n", flight,
                      draw.initial.T_sensor_target.p.z(), draw.initial.rates.omega_radps.norm() / kRadPerDeg, draw.noise,
                      draw.scanner.outlier_probability, draw.scanner.dropout_probability, result.reported, result.lost, result.invalid,
                      result.covered, result.wrong, result.first_wrong, 1e3 * result.worst_m, result.worst_rad / kRadPerDeg, result.nees);
  return text;
}

// Flights on all cores; the rows do not depend on how many there are.
std::string fly_all(const char* mission_file, std::uint32_t flights, std::uint64_t seed, std::uint32_t first) {
  const mdat::CompiledMission mission = mdat::compile_mission(mission_file);
  MissionParameters parameters = mdat::parameters_for(mission.source, kScenario);
  parameters.initial_present = 0;
  parameters.start_inlier_share_min = 0.4;  // as the mission's scenario with outliers, which no pose explains
  const std::vector<std::uint8_t> image = mdat::image_bytes(mission, parameters);
  const auto target = mdat::make_target(mission.mesh);
  const sim::ScannerModel scanner = mdat::scanner_model(mdat::scenario_of(mission.source, kScenario), parameters, true);
  std::vector<std::string> rows(flights);
  std::atomic<std::uint32_t> next{0};
  const auto work = [&] {
    for (std::uint32_t i = next++; i < flights; i = next++) {
      const Draw draw = draw_flight(seed, first + i, scanner);
      rows[i] = row(first + i, draw, fly(image, *target, draw));
    }
  };
  std::vector<std::thread> workers;
  for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  std::string text =
      "flight,range_m,spin_degps,noise,outliers,dropouts,reported,lost,invalid,covered,wrong,first_wrong,worst_mm,worst_deg,nees\n";
  for (const std::string& line : rows) text += line;
  return text;
}

}  // namespace
}  // namespace lasso::campaign

int main(int argc, char** argv) {
  return lasso::campaign::main_of({"montecarlo", "FLIGHTS", "FIRST"}, argc, argv, lasso::campaign::fly_all);
}
