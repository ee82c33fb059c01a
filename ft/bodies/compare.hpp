// By which score can the right pose of a scan be told from the others that a search finds? Each of them is registered, and the scores of
// the registrations are compared. Nothing here decides anything in flight.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "mdat/benchmark/subject.hpp"

namespace lasso::bodies {

enum class PoseScore : std::uint8_t {
  kHits = 0,        // half the squared residuals in sigmas, as registrations compare poses; kUnexplainedCost for a return left out
  kLikelihood = 1,  // of hits and misses (likelihood.hpp)
};
constexpr std::size_t kPoseScores = 2;

// The registration that a score takes for the best.
struct Choice {
  bool valid = false, wrong = false;
  double margin = std::numeric_limits<double>::infinity();  // to the best one more than 15 deg from it, in nats; infinite without one
};

// A pose with its scores in nats, larger is better.
struct ScoredPose {
  Pose T_sensor_target;
  bool valid = false, wrong = false;
  std::array<double, kPoseScores> scores{};
};
// `poses` holds one at least.
Choice choose(const std::vector<ScoredPose>& poses, PoseScore score);

// Of one scan.
struct Comparison {
  std::size_t number = 0;
  bool determined = false;
  bool accepted = false, accepted_wrong = false;  // by the search
  std::size_t poses = 0;                          // 0: nothing could be searched
  std::array<Choice, kPoseScores> choices;
};

// Single scans of a target at rest, searched without any pose: the same as `search` (trials.hpp).
std::vector<Comparison> compare(const mdat::Subject& subject, std::size_t scans);

// A line for each scan: body, scan, and a Comparison's members.
std::string comparison_csv(std::uint64_t seed, const std::vector<Comparison>& comparisons);
// What the search accepts, and what each score would if it asked for a margin.
std::string comparison_text(const std::vector<Comparison>& comparisons);

}  // namespace lasso::bodies
