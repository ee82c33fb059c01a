// What a search keeps of a scan: a few hundred returns, spread out, and some of the rays that returned nothing.
#pragma once

#include "fsw/pose/recognition/search_limits.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso {

constexpr std::size_t kPoolRays = 1024;     // returns and misses that the choice is made from
constexpr std::size_t kSubsetMisses = 192;  // that pass by the target
constexpr std::size_t kRegions = 32;        // of the target, as the scan shows it: around the first returns of the subset

// What measuring a fit needs to know of a return, once.
struct ReturnReach {
  FlightNumber::Length range;  // m, from the sensor
  float noise_m;               // 3 sigma along the ray
};

struct ScanSubset {
  std::uint32_t scan_id = 0;
  TimeUs t_us = 0;
  std::uint32_t returns = 0;     // of the scan, isolated ones left out
  Vec3 centroid = Vec3::Zero();  // of the returns, each weighted by the area that it stands for; sensor frame
  double median = 0;             // m, how much farther than the centroid, along the line of sight to it, their median depth is
  double misses_per_hit = 1;     // how many misses of the scan one of these stands for, over the same of the hits
  FixedVector<MatchPoint<FlightNumber>, kSubsetHits> hits;
  FixedVector<ReturnReach, kSubsetHits> reaches;   // of the hits
  FixedVector<std::uint8_t, kSubsetHits> regions;  // of the hits: which of the first kRegions is closest
  FixedVector<ScanRay<FlightNumber>, kSubsetMisses> misses;

  void clear() {
    returns = 0;
    centroid = Vec3::Zero();
    median = 0;
    misses_per_hit = 1;
    hits.clear();
    reaches.clear();
    regions.clear();
    misses.clear();
  }
};

// The registration works on the workspace's points: the first `count` of the subset.
void put_points(const ScanSubset& subset, std::size_t count, Workspace& workspace);

// Makes the subset of a scan in small steps.
class ScanSubsetMaker {
 public:
  // From the rays and points of `workspace` (prepare_rays). Of more than kPoolRays hits or misses every n-th is taken.
  void begin(const Mission& mission, const Workspace& workspace);

  // One step, which adds its work; false when `subset` is complete. A step looks at each return of the pool, the first with a choice
  // some ten times.
  bool step(const Mission& mission, ScanSubset& subset, std::uint32_t& work);

 private:
  struct PoolHit {
    MatchPoint<FlightNumber> point;
    float weight;         // area that the return stands for, of no unit
    float distance2;      // m^2, to the closest return that was chosen
    float reach;          // m, within which it has company
    std::uint8_t region;  // the chosen return that is closest, of the first kRegions
    bool kept;
  };
  std::size_t judge_isolation(std::size_t index);
  void drop_isolated();
  void find_centroid(ScanSubset& subset) const;
  void find_median(double weights, ScanSubset& subset) const;
  void choose(ScanSubset& subset);
  void choose_misses(const Mission& mission, ScanSubset& subset) const;

  FixedVector<PoolHit, kPoolRays> hits_;
  FixedVector<ScanRay<FlightNumber>, kPoolRays> misses_;
  std::size_t hit_stride_ = 1, miss_stride_ = 1;  // of the scan, for the pool
  std::size_t judged_ = 0;
};

}  // namespace lasso
