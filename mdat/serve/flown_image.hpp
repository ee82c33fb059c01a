// The flight image of a recording: the component's limits, the sensor's field, the model's size.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fsw/link/pose_telemetry.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/mcap/indexed_file.hpp"

namespace lasso::mdat::serve {

// Null: the file holds none, or one that this program does not load (of another version).
std::shared_ptr<const LoadedImage> flown_image(const mcap::IndexedFile& file);

// A test that a pose had to pass to be valid, and how it went.
struct ValidityGate {
  std::string name, unit;
  double value = 0, limit = 0;
  bool at_least = true;  // the value has to be at least the limit; otherwise at most
  bool pass = false;
};

// Those of the registration itself, in the order in which they are asked (fsw/pose/registration/integrity.hpp); empty where no registration
// ran. The limit of the residuals leaves out what the target's unknown motion may add: where the component had more patience than the
// limit, it passes.
std::vector<ValidityGate> validity_gates(const PoseTelemetry& told, const MissionParameters& parameters);

// A direction in which the pose is less certain than the mission asks.
struct WeakDirection {
  Vec6 direction;  // unit; translation first, then rotation times the model's radius; sensor axes
  double sigma_m = 0;
};
std::vector<WeakDirection> weak_directions(const Mat6& covariance, const LoadedImage& image);

// What the reason says, in a sentence, with the figures of the gate that it is about, and what helps.
std::string why_text(const PoseTelemetry& told, const std::vector<ValidityGate>& gates);

}  // namespace lasso::mdat::serve
