// What telemetry says of a flight, with the truth where that is known: for two flights on the same scans, side by side.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fsw/link/pose_telemetry.hpp"
#include "mdat/run/statistics.hpp"

namespace lasso::mdat {

// The packets `pose` of a stream of whole packets, in order; others are left out. Throws RunError: one of them cannot be decoded.
std::vector<PoseTelemetry> poses_in(ConstBytes telemetry);

using TruthAt = std::function<Pose(TimeUs)>;  // T_sensor_target; empty: nobody knows it

struct FlightFigures {
  std::size_t poses = 0;                  // packets
  std::size_t valid = 0;                  // of them
  std::size_t mode_changes = 0;           // that these say
  double residual_mm = 0;                 // root mean square, over valid poses; 0 of none
  std::optional<std::size_t> wrong;       // of the valid ones (verdict.hpp); none without a truth, as what follows
  std::optional<PoseError> worst;         // of the valid ones, by distance
  std::optional<double> rms_mm, rms_deg;  // of the registrations that are valid; none where none is
  std::optional<double> nees;             // mean of the same
};
FlightFigures flight_figures(const std::vector<PoseTelemetry>& poses, const TruthAt& truth);

// The first measurement of which two flights say something else: whether it is valid, why, in which mode, registration, covariance or
// filter, bit by bit; or which one of them has no pose of. None: there is no such.
std::optional<TimeUs> first_difference(const std::vector<PoseTelemetry>& a, const std::vector<PoseTelemetry>& b);

// A table for a person: a row a figure, a column a flight, which have these names. What is not known is "-".
std::string side_by_side(const std::string& name_a, const FlightFigures& a, const std::string& name_b, const FlightFigures& b);

}  // namespace lasso::mdat
