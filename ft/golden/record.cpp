// golden_record MISSION OUT SCENARIO RANGE_M FRAMES [KEY=VALUE...]: flies a scenario closed loop, with the simulated scanner and the
// component on its two Linux threads, and writes OUT/image.3dli, OUT/trace.bin and OUT/telemetry.bin. KEY=VALUE overrides flight
// parameters, as the mission file names them, and seed=N the seed of the scanner's noise. MISSION may also be followed by several runs in
// one call: OUT SCENARIO RANGE_M FRAMES [KEY=VALUE...] -- OUT ... With rough=N the flight begins at one of the scenario's frames,
// and from a start up to tracking.start_sigma_deg and, on each axis, start_sigma_m off, both drawn with N.
// Exit codes: 0 done, 1 the run failed, 2 usage or bad input.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bsp/posix/runner.hpp"
#include "ft/campaign/draws.hpp"
#include "ft/golden/trace_sensor.hpp"
#include "hal_sim/scanner.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/common/output.hpp"
#include "mdat/run/case.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::golden {
namespace {

using mdat::InputError;
using mdat::RunError;

struct Flight {
  std::filesystem::path out;
  std::string scenario;
  double range_m = 0;
  std::uint32_t frames = 0;
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;   // otherwise the scenario's
  std::optional<std::uint64_t> rough;  // otherwise the start is right, and the first frame the scenario's
};

Flight parse(const std::vector<std::string>& words) {
  if (words.size() < 4) throw InputError("a run is OUT SCENARIO RANGE_M FRAMES [KEY=VALUE...]");
  Flight flight{words[0], words[1], std::stod(words[2]), static_cast<std::uint32_t>(std::stoul(words[3])), {}, {}, {}};
  for (std::size_t i = 4; i < words.size(); ++i) {
    if (words[i].starts_with("seed=")) {
      flight.seed = std::stoull(words[i].substr(5));
    } else if (words[i].starts_with("rough=")) {
      flight.rough = std::stoull(words[i].substr(6));
    } else {
      flight.overrides.push_back(words[i]);
    }
  }
  return flight;
}

std::vector<Flight> parse_all(int argc, char** argv) {
  std::vector<Flight> flights;
  std::vector<std::string> words;
  for (int i = 2; i <= argc; ++i) {
    if (i < argc && std::string(argv[i]) != "--") {
      words.emplace_back(argv[i]);
      continue;
    }
    flights.push_back(parse(words));
    words.clear();
  }
  return flights;
}

void override_parameter(MissionParameters& parameters, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw InputError(text + ": not KEY=VALUE");
  for (const ParameterRow& row : parameter_rows()) {
    if (text.compare(0, equals, row.key) != 0) continue;
    parameters.*row.member = std::stod(text.substr(equals + 1)) * row.to_si;
    return;
  }
  throw InputError(text + ": no such parameter");
}

MissionParameters parameters_of(const mdat::MissionSource& source, const Flight& flight) {
  MissionParameters parameters = mdat::parameters_for(source, flight.scenario);
  for (const std::string& text : flight.overrides) override_parameter(parameters, text);
  std::size_t row = 0;
  if (validate(parameters, row) != Status::kOk) throw InputError(std::string(parameter_rows()[row].key) + ": out of range");
  return parameters;
}

void expect(Status status, const std::string& what) {
  if (status != Status::kOk) throw RunError("the component refused to " + what + ": " + to_string(status));
}

// The track starts from the true pose of one frame before the first, at rest.
TraceHeader make_header(const sim::Trajectory& trajectory, const Flight& flight, const mdat::Scenario& scenario,
                        const MissionParameters& parameters) {
  const DurationUs period_us = mdat::period_us(parameters);
  TraceHeader header;
  header.frames = flight.frames + kPipelineFrames;
  header.boundary_0_us = mdat::kEpochUs;
  if (flight.rough) {
    sim::Random random(*flight.rough);
    header.boundary_0_us += static_cast<DurationUs>(random.uniform() * scenario.frames) * period_us;
    const Pose truth = trajectory.at(header.boundary_0_us).T_sensor_target;
    header.T_sensor_target = campaign::disturbed(truth, parameters.start_sigma_rad, parameters.start_sigma_m, random);
  } else {
    header.T_sensor_target = trajectory.at(mdat::kEpochUs - period_us).T_sensor_target;
  }
  header.t_us = header.boundary_0_us;
  return header;
}

std::string fly(Sensor& sensor, std::vector<std::uint8_t> image, const TraceHeader& header) {
  std::vector<std::uint64_t> memory = mdat::aligned_copy(image);
  const auto component = std::make_unique<Component>(sensor);
  expect(component->load_image(mdat::view(memory, image.size())).status, "load its image");
  expect(component->begin(header.boundary_0_us), "begin");
  expect(component->start_tracking(header.T_sensor_target, header.rates, header.t_us), "start tracking");
  std::string telemetry;
  posix::Runner runner(*component);
  for (std::uint32_t frame = 0; frame < header.frames; ++frame) {
    const ConstBytes packets = runner.run_frame().telemetry;
    telemetry.append(packets.begin(), packets.end());
  }
  return telemetry;
}

std::string trace_bytes(const TraceHeader& header, const std::vector<std::uint8_t>& calls) {
  std::uint8_t buffer[kTraceHeaderBytes];
  ByteWriter out{Bytes(buffer)};
  put(out, header);
  std::string bytes(out.written().begin(), out.written().end());
  return bytes.append(calls.begin(), calls.end());
}

void record(const mdat::CompiledMission& mission, const sim::RayCaster& target, const Flight& flight) {
  const mdat::Scenario& scenario = mdat::scenario_of(mission.source, flight.scenario);
  MissionParameters parameters = parameters_of(mission.source, flight);
  if (flight.rough) parameters.initial_present = 0;
  const DurationUs period_us = mdat::period_us(parameters);
  const auto trajectory = mdat::make_trajectory(scenario, flight.range_m, mdat::kEpochUs, period_us);
  sim::SimulatedScanner scanner(target, *trajectory, mdat::scanner_model(scenario, parameters, scenario.noise != 0),
                                flight.seed.value_or(static_cast<std::uint64_t>(scenario.seed)));
  TraceRecorder recorder(scanner);
  const TraceHeader header = make_header(*trajectory, flight, scenario, parameters);
  const std::vector<std::uint8_t> image = mdat::image_bytes(mission, parameters);
  const std::string telemetry = fly(recorder, image, header);

  mdat::OutputFolder out(flight.out);
  out.write("image.3dli", {reinterpret_cast<const char*>(image.data()), image.size()});
  out.write("trace.bin", trace_bytes(header, recorder.calls()));
  out.write("telemetry.bin", telemetry);
  out.commit();
}

int run(int argc, char** argv) {
  if (argc < 6) throw InputError("usage: golden_record MISSION OUT SCENARIO RANGE_M FRAMES [KEY=VALUE...] [-- OUT ...]");
  const std::vector<Flight> flights = parse_all(argc, argv);
  const mdat::CompiledMission mission = mdat::compile_mission(argv[1]);
  const auto target = mdat::make_target(mission.mesh);
  for (const Flight& flight : flights) record(mission, *target, flight);
  return mdat::kExitDone;
}

}  // namespace
}  // namespace lasso::golden

int main(int argc, char** argv) {
  try {
    return lasso::golden::run(argc, argv);
  } catch (const lasso::mdat::RunError& error) {
    std::fprintf(stderr, "golden_record: %s\n", error.what());
    return lasso::mdat::kExitFailed;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "golden_record: %s\n", error.what());
    return lasso::mdat::kExitBadInput;
  }
}
