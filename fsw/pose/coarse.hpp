// The coarse stage of a search: each view of the reference model's table at each roll about the line of sight, scored on the distance grid.
#pragma once

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/pose/evidence.hpp"

namespace lasso {

constexpr std::uint32_t kRolls = 24;
constexpr std::size_t kCoarsePoints = 96;
constexpr std::size_t kShortList = 32;
constexpr double kShortListApart_rad = 15 * kRadPerDeg;

struct Hypothesis {
  Pose T_target_sensor;
  std::uint32_t score = 0;  // sum of the distance bytes, smaller is better
};

// The best hypotheses that are apart from each other, in no order.
class ShortList {
 public:
  void clear() { list_.clear(); }
  // Would a hypothesis of this score be taken, were it far from all others?
  bool wants(std::uint32_t score) const { return !list_.full() || score < list_[worst()].score; }
  // Puts it in unless a better one is near; what is near and not better leaves, or else the worst where the list is full.
  void offer(const Hypothesis& hypothesis);
  std::size_t size() const { return list_.size(); }
  const Hypothesis& operator[](std::size_t i) const { return list_[i]; }

 private:
  std::size_t worst() const;
  FixedVector<Hypothesis, kShortList> list_;
};

// Angle between two attitudes is more than the one whose half has this cosine.
bool are_apart(const Quat& a, const Quat& b, double cos_half_angle);

class CoarseSearch {
 public:
  void begin(const Evidence& evidence);
  // One view at all rolls: kRolls * kCoarsePoints look-ups at most. False after the last view.
  bool step(const Mission& mission, const Evidence& evidence);
  const ShortList& short_list() const { return short_list_; }

 private:
  using N = FlightNumber;
  struct RolledView;
  std::uint32_t score(const SearchTables<N>& tables, const RolledView& rolled) const;
  void try_roll(const Mission& mission, const Evidence& evidence, const Mat3& view_axes, std::uint32_t roll);

  Mat3 sight_ = Mat3::Identity();  // columns: axes of the line of sight, the third one back to the sensor; sensor frame
  std::uint32_t next_view_ = 0;
  Vec3 centroid_ = Vec3::Zero();  // of what is seen in the view from the scan's range, target frame
  std::size_t count_ = 0;
  N::Length points_[kCoarsePoints][3] = {};  // from the centroid, in the axes of the line of sight
  ShortList short_list_;
};

}  // namespace lasso
