// Whole flights of a simulated stereo head in stated lights: by rendered pairs, and by the errors that were fitted to such.
#pragma once

#include "mdat/trial/pair_trial.hpp"

namespace lasso::mdat {

struct FlightTrialOptions {
  std::string scenario;                 // of one range; where its motion is drawn, each flight has its own
  std::optional<std::uint64_t> seed;    // of the first flight, the next ones count up from it; none: the scenario's
  std::uint32_t flights = 1;            // of each light
  std::optional<std::uint32_t> frames;  // of each; none: the scenario's
  std::uint32_t draws = 4;              // of each flight by the fitted model: the same motion, each with errors of its own
  bool rendered = true;                 // false: by the fitted model alone, without pictures
  std::vector<TrialLight> lights;
  unsigned jobs = 1;  // flights at a time; no effect on the results
};

// Poses are those of registrations: `view` is the flight, `scan` the frame. Squared errors of position and attitude are not known.
struct FlightTrialResult {
  std::string scenario;
  std::uint32_t frames = 0;
  std::vector<TrialLight> lights;
  std::vector<TrialPose> rendered, fitted;
};

// Throws as stereo_maker and run_case, and InputError: a mission without a stereo head, or a scenario of several ranges.
FlightTrialResult try_flights(const CompiledMission& mission, const FlightTrialOptions& options);

// A frame of a flight as a pose.
TrialPose flown_pose(const FrameError& frame);

}  // namespace lasso::mdat
