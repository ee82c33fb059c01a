// What the parts of a search cost. Work is counted in units of kInstructionsPerUnit instructions of a PowerPC 603e, in every stage, so that
// a slice of it is a bound of time; `make count WHAT=search` measures what a unit is worth and holds it (docs/search.md).
#pragma once

#include <cstddef>
#include <cstdint>

namespace lasso {

constexpr std::size_t kInstructionsPerUnit = 75;
constexpr std::uint32_t kDistanceSteps = 8;  // passes of align_on_distances
constexpr std::uint32_t kRaySteps = 4;       // of align_on_rays

// Instructions of one each, in the mean or, where a ray is walked along, rather more.
namespace cost {
constexpr std::size_t kRay = 500;           // of a scan: deskewed, and counted where it points
constexpr std::size_t kNeighbour = 30;      // of a return, looked at for company
constexpr std::size_t kChoice = 34;         // among the returns, of each of them
constexpr std::size_t kDepth = 400;         // of a return, for the middle and the median of all
constexpr std::size_t kPassingMiss = 85;    // does it pass by?
constexpr std::size_t kView = 1500;         // of the table, laid
constexpr std::size_t kTurnedPoint = 40;    // a return in a view
constexpr std::size_t kCoarsePoint = 75;    // at a roll and half a turn on
constexpr std::size_t kOffer = 1800;        // of a hypothesis to the short list
constexpr std::size_t kDistanceStep = 450;  // of a point
constexpr std::size_t kRayStep = 1350;      // of a point: its ray is walked along through a gate that begins wide
constexpr std::size_t kRayWeighed = 1100;   // of a point, as the pose stands
constexpr std::size_t kOpening = 200;       // of a point, when a registration begins
constexpr std::size_t kPass = 550;          // of a point in a registration, each time
constexpr std::size_t kSolution = 6000;     // of any pass
constexpr std::size_t kFitHit = 2800;       // a return measured
constexpr std::size_t kFitMiss = 1400;      // a miss measured
constexpr std::size_t kRegion = 5500;       // of the scan subset, besides its returns
constexpr std::size_t kLine = 40000;        // to search a line
constexpr std::size_t kEnding = 10500;      // of a stage: tracks put in order
}  // namespace cost

constexpr std::uint32_t units_of(std::size_t instructions) { return static_cast<std::uint32_t>(instructions / kInstructionsPerUnit) + 1; }

constexpr std::uint32_t kLineWork = units_of(cost::kLine);
constexpr std::uint32_t kEndingWork = units_of(cost::kEnding);
constexpr std::uint32_t prepare_work(std::size_t rays) { return units_of(cost::kRay * rays); }
constexpr std::uint32_t company_work(std::size_t neighbours) { return units_of(cost::kNeighbour * neighbours); }
constexpr std::uint32_t middle_work(std::size_t returns) { return units_of(cost::kDepth * returns); }
constexpr std::uint32_t choice_work(std::size_t returns) { return units_of(cost::kChoice * returns); }
constexpr std::uint32_t passing_work(std::size_t misses) { return units_of(cost::kPassingMiss * misses); }
constexpr std::uint32_t view_work(std::size_t points, std::size_t looked_at, std::size_t offers) {
  return units_of(cost::kView + cost::kTurnedPoint * points + cost::kCoarsePoint * looked_at + cost::kOffer * offers);
}
constexpr std::uint32_t distance_alignment_work(std::size_t points) {
  return units_of(kDistanceSteps * (cost::kDistanceStep * points + cost::kSolution));
}
constexpr std::uint32_t ray_alignment_work(std::size_t points) { return units_of(kRaySteps * (cost::kRayStep * points + cost::kSolution)); }
constexpr std::uint32_t look_work(std::size_t points, std::size_t passes) {
  return units_of(cost::kOpening * points + passes * (cost::kPass * points + cost::kSolution));
}
constexpr std::uint32_t weigh_work(std::size_t points) { return units_of(cost::kRayWeighed * points + cost::kSolution); }
constexpr std::uint32_t regions_work(std::size_t points, std::size_t regions) {
  return units_of(cost::kRayWeighed * points + regions * cost::kRegion);
}
constexpr std::uint32_t score_work(std::size_t hits, std::size_t misses) {
  return units_of(cost::kFitHit * hits + cost::kFitMiss * misses);
}

}  // namespace lasso
