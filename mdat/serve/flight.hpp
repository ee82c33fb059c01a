// A simulated run that is watched while it flies: it is recorded frame by frame, and keeps the watcher's pace.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "mdat/serve/pacing.hpp"

namespace lasso::mdat::serve {

struct FlightOrder {
  std::filesystem::path mission;
  std::string scenario;
  std::optional<std::uint64_t> seed;  // otherwise the scenario's
  double pace = 1;
  std::filesystem::path file;  // to write
};

// Calls come from the run's thread.
struct FlightTold {
  std::function<void(std::uint32_t frames)> begun;  // the mission is compiled; it will fly so many frames
  // A boundary's packets, before the file has them.
  std::function<void(TimeUs boundary_us, ConstBytes packets)> packets;
  std::function<void(std::uint64_t bytes)> written;  // all so far is in the first so many bytes of the file
};

// Flies it to its end, or until `pacing` is stopped; the file is whole in either case. The command line does the same by
// flight_command(). Throws InputError, MissionError or RunError; a scenario of several ranges is refused.
void fly(const FlightOrder& order, const std::string& commit, Pacing& pacing, const FlightTold& told);

std::string flight_command(const FlightOrder& order);

}  // namespace lasso::mdat::serve
