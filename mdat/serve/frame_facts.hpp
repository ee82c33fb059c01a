// What is said of a frame beyond its telemetry: errors against the truth, and figures in a person's units.
#pragma once

#include <optional>
#include <vector>

#include "fsw/link/pose_telemetry.hpp"
#include "mdat/run/statistics.hpp"
#include "mdat/serve/value_table.hpp"

namespace lasso::mdat::serve {

struct FrameFacts {
  // Throws nothing. `truth`: at the time of the telemetry's poses.
  FrameFacts(const PoseTelemetry& told, const std::optional<Pose>& truth);

  const PoseTelemetry& told;
  std::optional<Pose> truth;
  Mat6 covariance;                                  // of the registration: rotation, translation; sensor axes
  bool registered = false;                          // a registration ran; otherwise its pose is the prediction
  std::optional<PoseError> registration, filtered;  // none without a truth; the first none where no registration ran
  double normalised_squared = 0;                    // of the first
  std::optional<bool> wrong;                        // valid, and registration or filter is wrong (mdat/run/verdict.hpp)
};

// The columns that are made of these, in table number `table`.
std::vector<Value> fact_values(std::size_t table);
// One row of them. NaN: not known.
void add_facts(double time_s, const FrameFacts& facts, ValueTable& table);

}  // namespace lasso::mdat::serve
