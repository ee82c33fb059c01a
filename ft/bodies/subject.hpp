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

namespace lasso::bodies {

struct Subject {
  mdat::Body body;
  mdat::BodyTruth truth;
  mdat::CompiledMission mission;
  std::unique_ptr<mdat::KnowableTarget> target;
  mdat::KnowableNoise noise;
  double nearest_m = 0;  // the range of the scenario `paper` that is the least
};

// Model and mission are written to `folder`; compiled models come from the user's cache. Without a sensor the body's size decides.
// `settings`, KEY=VALUE, hold in place of the mission's. Throws MissionError or InputError.
Subject make_subject(std::uint64_t seed, std::optional<mdat::SensorKind> sensor, const std::vector<std::string>& settings,
                     const std::filesystem::path& folder);

// Whether the scan can tell the pose of the target, which stands still at it. Never of a body whose attitude cannot be known.
bool is_determined(const Subject& subject, const Pose& T_sensor_target, std::span<const RangeSample> scan);

}  // namespace lasso::bodies
