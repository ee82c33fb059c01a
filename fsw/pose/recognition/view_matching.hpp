// The coarse stage of a search: each view of the reference model's table at each roll about the line of sight, scored on the distance grid.
#pragma once

#include "fsw/geometry/se3.hpp"
#include "fsw/pose/recognition/scan_subset.hpp"

namespace lasso {

constexpr std::uint32_t kRolls = 24;
constexpr std::size_t kCoarsePoints = 96;
constexpr std::size_t kShortList = 32;

struct Hypothesis {
  Pose T_target_sensor;
  std::uint32_t score = 0;  // sum of the distance bytes, smaller is better
};

// The best hypotheses that are 15 deg apart from each other, in no order.
class ShortList {
 public:
  void clear() {
    list_.clear();
    limit_ = kNoLimit;
  }
  // Only hypotheses of smaller scores are taken, and those if they are far from all others, or better.
  std::uint32_t limit() const { return limit_; }
  // Puts it in unless a better one is near; what is near and not better leaves, or else the worst where the list is full.
  void offer(const Hypothesis& hypothesis);
  std::size_t size() const { return list_.size(); }
  const Hypothesis& operator[](std::size_t i) const { return list_[i]; }

 private:
  static constexpr std::uint32_t kNoLimit = kFarByte * kCoarsePoints + 1;
  void put_in(const Hypothesis& hypothesis);
  std::size_t worst() const;
  FixedVector<Hypothesis, kShortList> list_;
  std::uint32_t limit_ = kNoLimit;  // score of the worst one of a full list
};

constexpr double kCosHalfSame = 0.99904822158185780;      // 5 deg
constexpr double kCosHalfDistinct = 0.99144486137381038;  // 15 deg

// Angle between two attitudes is more than the one whose half has this cosine.
bool are_apart(const Quat& a, const Quat& b, double cos_half_angle);

class ViewMatcher {
 public:
  void begin(const Mission& mission, const ScanSubset& subset);
  // One view at all rolls: kRolls * kCoarsePoints cells at most. A view is laid with the middle of what is seen on that of the returns, and
  // once more with their median depths alike where that is another place: thin parts that are seen edge-on, or nearly, move a middle, and a
  // few parts far behind the others. Returns how much work it was (work_units.hpp); done() after the last view.
  std::uint32_t step(const Mission& mission, const ScanSubset& subset);
  bool done() const { return done_; }
  const ShortList& short_list() const { return short_list_; }

 private:
  using N = FlightNumber;
  // A return in a view: at roll r it lies at base + c(r), half a turn on at base - c(r), with c(r) = cos(r) a + sin(r) b. Cells of the
  // grid.
  struct Turned {
    std::int32_t base[3];  // 2^-22
    std::int32_t a[3];     // 2^-10
    std::int32_t b[3];
  };
  struct RollScore {
    std::uint32_t here = 0;
    std::uint32_t opposite = 0;
  };
  bool choose_place(const Mission& mission, const ScanSubset& subset);
  void turn_points(const SearchTables<N>& tables, const Mat3& view_axes);
  std::uint32_t share_of_limit(std::size_t points) const;
  RollScore score(const SearchTables<N>& tables, std::uint32_t roll);
  RollScore sum_block(const SearchTables<N>& tables, std::uint32_t roll, std::size_t first) const;
  void offer(const ScanSubset& subset, const Mat3& view_axes, std::uint32_t roll, std::uint32_t score);

  Mat3 sight_ = Mat3::Identity();  // columns: axes of the line of sight, the third one back to the sensor; sensor frame
  std::uint32_t next_view_ = 0;
  bool done_ = false;
  std::uint32_t points_looked_at_ = 0;  // of the step
  std::uint32_t offers_ = 0;            // of the step
  bool by_median_ = false;              // the view once more, laid where the medians of the depths are alike instead of the middles
  Vec3 centroid_ = Vec3::Zero();        // of what is seen in the view from the scan's range, target frame
  std::size_t count_ = 0;
  std::int32_t points_[kCoarsePoints][3] = {};  // from the centroid, in the axes of the line of sight; 2^-10 cells
  std::int32_t turns_[kRolls / 2][2] = {};      // cosine and sine of each roll of the first half turn; 2^-12
  Turned turned_[kCoarsePoints] = {};           // in the view that is being looked at
  ShortList short_list_;
};

}  // namespace lasso
