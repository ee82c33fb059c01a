// A body that is tried: made from its seed, with a mission as `mdat mission new` writes it, compiled.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mdat/bodies/body.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/run/knowable.hpp"

namespace lasso::mdat {

struct Subject {
  Body body;
  BodyTruth truth;
  CompiledMission mission;
  std::unique_ptr<KnowableTarget> target;
  KnowableNoise noise;
  double nearest_m = 0;  // the range of the scenario `paper` that is the least
};

struct SubjectRequest {
  std::uint64_t seed = 0;
  std::optional<SensorKind> sensor;      // without one the body's size decides
  std::string name;                      // of the mission, as NewMissionRequest has it
  std::vector<std::string> settings;     // KEY=VALUE, which hold in place of the mission's
  std::filesystem::path mission, model;  // to write; a model .stl is the body's mesh, another its parametric model
  bool cached = true;                    // compiled models come from the user's cache, and are kept there
};

// Writes mission and model, and compiles them. Throws MissionError or InputError.
Subject make_subject(const SubjectRequest& request);

// Whether the scan can tell the pose of the target, which stands still at it. Never of a body whose attitude cannot be known.
bool is_determined(const Subject& subject, const Pose& T_sensor_target, std::span<const RangeSample> scan);

}  // namespace lasso::mdat
