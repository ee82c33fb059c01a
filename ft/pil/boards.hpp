// One flight on each board: the host, and an emulated board. Both see the same world.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bsp/bare/rig_words.hpp"
#include "ft/pil/world.hpp"

namespace lasso::pil {

using Told = std::function<void(std::uint32_t frames)>;  // frames that are done

struct HostMemory {
  std::vector<std::uint8_t> image;
  std::size_t code_bytes = 0;  // that the target's scrub watches beside the image
};

enum class Head : std::uint8_t { kAtLine, kBesideProcessor };

// The telemetry of `frames` frames. Throws mdat::RunError.
Packet fly_on_host(const WorldSetup& setup, const HostMemory& memory, Head head, std::uint32_t frames, const Told& told);

struct Report {
  std::uint32_t words[bare::kRigWords] = {};
  std::uint32_t operator[](bare::RigWord word) const { return words[word]; }
};

struct TargetFlight {
  std::vector<Report> starts;     // one for each start of the board
  std::vector<Packet> telemetry;  // of each
  std::vector<Report> slots;      // since the last
};

// What the ground sends beside the world's commands, before a slot of a start; both are counted from 0. `count` is that of the next
// command.
using Ground = std::function<Packet(std::uint32_t start, std::uint32_t slot, std::uint16_t& count)>;

// How long the host waits for the board; no result depends on it.
struct Patience {
  std::chrono::seconds quiet{30};                                                            // while nothing moves on the lines
  std::chrono::steady_clock::time_point end = std::chrono::steady_clock::time_point::max();  // of the whole flight
};

struct TargetRun {
  std::string folder;  // where camera.sock, ground.sock and rig.sock are made, at which the emulator is awaited
  std::uint32_t frames = 0, starts = 1;
  Patience patience;
  std::optional<std::size_t> head = std::nullopt;  // where in the board's memory, folder/ram.bin, its lcs::HeadMemory is, if it has one
};

// Ends after `frames` frames, or after that many since the last start when `starts` are awaited. Throws mdat::RunError, which names what
// was awaited: nobody comes, or the other end has gone, or says nothing, or the flight does not end.
TargetFlight fly_on_target(const WorldSetup& setup, const TargetRun& run, const std::function<void()>& ready, const Told& told,
                           const Ground& ground = {});

}  // namespace lasso::pil
