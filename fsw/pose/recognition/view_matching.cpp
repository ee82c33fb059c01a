#include "fsw/pose/recognition/view_matching.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/scan/work_units.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr double kFarthestCell = 127;  // from the middle of what is seen: beyond any grid, or clipped
constexpr int kPlaceBits = 10;         // fractions of a cell
constexpr int kTurnBits = 12;          // of sines and cosines
constexpr std::uint32_t kCellShift = kPlaceBits + kTurnBits;
constexpr double kMedianApart = 0.5;    // of the truncation: less than that any place serves
constexpr std::size_t kBlock = 8;       // points between two looks whether the score is too large already
constexpr std::size_t kHeadStart = 12;  // points: by so many times its share of the limit a sum may run ahead
constexpr std::uint32_t kUnwanted = 0xFFFFFFFFu;

// 0 from far away, 1 from as near as the near views, between them by the inverse of the range; larger when nearer still.
double nearness(const Mission& mission, const ScanSubset& subset) {
  const double range = square_root(subset.centroid.squaredNorm());
  const double near = static_cast<double>(kNearView) * static_cast<double>(mission.search.size_m);
  return range > 0.5 * near ? near / range : 2;
}

// Right-handed axes whose third one is `z` (unit).
Mat3 axes_along(const Vec3& z) {
  const double x = z[0] * z[0];
  const double y = z[1] * z[1];
  const Vec3 helper = x < y ? Vec3::UnitX() : Vec3::UnitY();
  Mat3 axes;
  const Vec3 first = helper.cross(z);
  axes.col(0) = first / square_root(first.squaredNorm());
  axes.col(1) = z.cross(axes.col(0));
  axes.col(2) = z;
  return axes;
}

// In units of 2^-bits, within `limit`; 0 for what is not a number.
std::int32_t to_fixed(double x, double limit, int bits) {
  const double scale = static_cast<double>(1 << bits);
  return is_finite(x) ? static_cast<std::int32_t>(scale * clamp(x, -limit, limit)) : 0;
}

std::uint32_t byte_at(const SearchTables<N>& tables, std::int32_t x, std::int32_t y, std::int32_t z) {
  const auto cell_of = [](std::int32_t place) { return static_cast<std::uint32_t>(place) >> kCellShift; };
  return distance_byte(tables, cell_of(x), cell_of(y), cell_of(z));
}

}  // namespace

bool are_apart(const Quat& a, const Quat& b, double cos_half_angle) {
  const double c = a.dot(b);
  return c * c < cos_half_angle * cos_half_angle;
}

std::size_t ShortList::worst() const {
  std::size_t index = 0;
  for (std::size_t i = 1; i < list_.size(); ++i) {
    if (list_[i].score > list_[index].score) index = i;
  }
  return index;
}

void ShortList::offer(const Hypothesis& hypothesis) {
  std::size_t kept = 0;
  for (const Hypothesis& other : list_) {
    if (are_apart(hypothesis.T_target_sensor.q, other.T_target_sensor.q, kCosHalfDistinct)) continue;
    if (other.score <= hypothesis.score) return;
  }
  for (std::size_t i = 0; i < list_.size(); ++i) {
    if (are_apart(hypothesis.T_target_sensor.q, list_[i].T_target_sensor.q, kCosHalfDistinct)) list_[kept++] = list_[i];
  }
  list_.shrink(kept);
  put_in(hypothesis);
  limit_ = list_.full() ? list_[worst()].score : kNoLimit;
}

void ShortList::put_in(const Hypothesis& hypothesis) {
  if (list_.push_back(hypothesis)) return;
  Hypothesis& last = list_[worst()];
  if (hypothesis.score < last.score) last = hypothesis;
}

void ViewMatcher::begin(const Mission& mission, const ScanSubset& subset) {
  short_list_.clear();
  next_view_ = 0;
  done_ = false;
  by_median_ = false;
  count_ = subset.hits.size() < kCoarsePoints ? subset.hits.size() : kCoarsePoints;
  const double range2 = subset.centroid.squaredNorm();
  sight_ = axes_along(range2 > 0 ? Vec3(-subset.centroid / square_root(range2)) : Vec3(-Vec3::UnitZ()));
  const double cells_per_m = static_cast<double>(mission.search.cells_per_m);
  for (std::size_t i = 0; i < count_; ++i) {
    const Vec3 y = cells_per_m * (sight_.transpose() * (to_vec3(subset.hits[i].p) - subset.centroid));
    for (int k = 0; k < 3; ++k) points_[i][k] = to_fixed(y[k], kFarthestCell, kPlaceBits);
  }
  for (std::uint32_t roll = 0; roll < kRolls / 2; ++roll) {
    const SinCos turn = sin_cos(2 * kPi / kRolls * roll);
    turns_[roll][0] = to_fixed(turn.cos, 1, kTurnBits);
    turns_[roll][1] = to_fixed(turn.sin, 1, kTurnBits);
  }
}

std::uint32_t ViewMatcher::step(const Mission& mission, const ScanSubset& subset) {
  points_looked_at_ = offers_ = 0;
  const Mat3 axes = axes_along(to_vec3(mission.search.views[next_view_].direction));
  const bool again = choose_place(mission, subset);
  turn_points(mission.search, axes);
  for (std::uint32_t roll = 0; roll < kRolls / 2; ++roll) {
    const RollScore both = score(mission.search, roll);
    offer(subset, axes, roll, both.here);
    offer(subset, axes, roll + kRolls / 2, both.opposite);
  }
  by_median_ = again;
  if (!again) ++next_view_;
  done_ = next_view_ == mission.search.views.size();
  return view_work(count_, points_looked_at_, offers_);
}

// Where the returns' centroid is in the view. True where the view is to be laid once more.
bool ViewMatcher::choose_place(const Mission& mission, const ScanSubset& subset) {
  const ModelView<N>& view = mission.search.views[next_view_];
  const double near = nearness(mission, subset);
  const auto between = [&](double afar, double nearby) { return afar + near * (nearby - afar); };
  for (int i = 0; i < 3; ++i) centroid_[i] = between(N::to_double(view.centroid[i]), N::to_double(view.near_centroid[i]));
  const double farther = between(N::to_double(view.median), N::to_double(view.near_median)) - subset.median;
  const double apart = kMedianApart * static_cast<double>(mission.search.truncation_m);
  if (by_median_) centroid_ -= farther * to_vec3(view.direction);
  return !by_median_ && (farther > apart || farther < -apart);
}

void ViewMatcher::turn_points(const SearchTables<N>& tables, const Mat3& view_axes) {
  std::int32_t V[3][3];
  std::int32_t t[3];
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) V[k][j] = to_fixed(view_axes(k, j), 1, kTurnBits);
    t[k] = to_fixed(static_cast<double>(tables.cells_per_m) * (centroid_[k] - static_cast<double>(tables.origin_m[k])), kFarthestCell,
                    kCellShift);
  }
  for (std::size_t i = 0; i < count_; ++i) {
    const std::int32_t* p = points_[i];
    for (int k = 0; k < 3; ++k) {
      turned_[i].base[k] = V[k][2] * p[2] + t[k];
      turned_[i].a[k] = (V[k][0] * p[0] + V[k][1] * p[1]) / (1 << kTurnBits);
      turned_[i].b[k] = (V[k][1] * p[0] - V[k][0] * p[1]) / (1 << kTurnBits);
    }
  }
}

// The sums over the points of a block, at the roll and half a turn on.
ViewMatcher::RollScore ViewMatcher::sum_block(const SearchTables<N>& tables, std::uint32_t roll, std::size_t first) const {
  const std::int32_t cos = turns_[roll][0];
  const std::int32_t sin = turns_[roll][1];
  const std::size_t end = first + kBlock < count_ ? first + kBlock : count_;
  RollScore sum;
  for (std::size_t i = first; i < end; ++i) {
    const Turned& p = turned_[i];
    const std::int32_t c[3] = {cos * p.a[0] + sin * p.b[0], cos * p.a[1] + sin * p.b[1], cos * p.a[2] + sin * p.b[2]};
    sum.here += byte_at(tables, p.base[0] + c[0], p.base[1] + c[1], p.base[2] + c[2]);
    sum.opposite += byte_at(tables, p.base[0] - c[0], p.base[1] - c[1], p.base[2] - c[2]);
  }
  return sum;
}

// What the sum over the first `points` of them may be of a hypothesis that is to come on the list: their share of its limit, with a start.
std::uint32_t ViewMatcher::share_of_limit(std::size_t points) const {
  return short_list_.limit() * static_cast<std::uint32_t>(points + kHeadStart) / static_cast<std::uint32_t>(count_ + kHeadStart);
}

// The sum over the points, of both the roll and the one half a turn on; kUnwanted of both where neither promises to be among the best:
// points are far apart, so that the first few are a fair sample of them all.
ViewMatcher::RollScore ViewMatcher::score(const SearchTables<N>& tables, std::uint32_t roll) {
  RollScore sum;
  for (std::size_t first = 0; first < count_; first += kBlock) {
    const std::uint32_t bound = share_of_limit(first);
    if (sum.here >= bound && sum.opposite >= bound) return {kUnwanted, kUnwanted};
    const RollScore block = sum_block(tables, roll, first);
    sum.here += block.here;
    sum.opposite += block.opposite;
    points_looked_at_ += kBlock;
  }
  return sum;
}

void ViewMatcher::offer(const ScanSubset& subset, const Mat3& view_axes, std::uint32_t roll, std::uint32_t score) {
  if (score >= short_list_.limit()) return;
  ++offers_;
  const SinCos turn = sin_cos(2 * kPi / kRolls * roll);
  Mat3 roll_axes;
  roll_axes << turn.cos, -turn.sin, 0, turn.sin, turn.cos, 0, 0, 0, 1;
  const Mat3 R_target_sensor = view_axes * roll_axes * sight_.transpose();
  Hypothesis hypothesis;
  hypothesis.score = score;
  hypothesis.T_target_sensor.q = to_quaternion(R_target_sensor);
  hypothesis.T_target_sensor.p = centroid_ - R_target_sensor * subset.centroid;
  short_list_.offer(hypothesis);
}

}  // namespace lasso
