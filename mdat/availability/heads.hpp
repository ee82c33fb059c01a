// The sensors that are set against each other: a laser camera, stereo cameras, and stereo cameras with a lamp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mdat/common/flight_image.hpp"
#include "mdat/run/case.hpp"

namespace lasso::mdat {

struct Head {
  std::string key;    // in files
  std::string title;  // for people
  std::vector<std::string> settings;
};

// `lamp_Wpsr`: of the last one.
std::vector<Head> heads_with(double lamp_Wpsr);

// The mission that is flown: its file, the user's settings, and the lamp that it says, or kLamp_Wpsr where it says none.
struct HeadsMission {
  std::string file;
  std::vector<std::string> settings;
  bool cached = true;
};

// All heads for a mission. Throws MissionError as load_mission; InputError where a setting chooses the sensor's kind.
std::vector<Head> heads_of(const HeadsMission& mission);

// A head's mission as it is written, with more settings, for a scenario in an orbit. Throws MissionError; InputError where the scenario is
// not of kind scene, or the mission has no orbit.
MissionInput input_of_head(const HeadsMission& mission, const Head& head, const std::string& scenario,
                           const std::vector<std::string>& more = {});

// What cases of one head have in common.
class HeadFlights {
 public:
  HeadFlights(const HeadsMission& mission, const Head& head, const std::string& scenario);  // throws as input_of_head and compile_mission

  // The scenario with noise by `seed`. `flown`: the mission as this case has it, this one's or one that differs in its orbit and nodes; the
  // case keeps both by reference. `picture_jobs`: threads that render a picture.
  CaseSetup flight(const MissionInput& flown, std::uint64_t seed, std::uint32_t frames, unsigned picture_jobs) const;
  const CompiledMission& mission() const { return mission_; }
  const Head& head() const { return head_; }
  const Scenario& scenario() const;

 private:
  Head head_;
  std::string scenario_;
  CompiledMission mission_;
  std::vector<std::uint8_t> image_;
  std::unique_ptr<sim::RayCaster> target_;
};

}  // namespace lasso::mdat
