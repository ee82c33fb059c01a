#include "fsw/pose/coarse.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr N::Ratio kFarthestCell = 1000;               // no grid has as many along an axis
constexpr double kCosHalfApart = 0.99144486137381038;  // cos(kShortListApart_rad / 2)

Vec3 to_vec3(const N::Unit* v) { return {N::to_double(v[0]), N::to_double(v[1]), N::to_double(v[2])}; }

// 0 from afar, 1 from as near as the near views, between them by the inverse of the range; larger when nearer still.
double nearness(const Mission& mission, const Evidence& evidence) {
  const double range = square_root(evidence.centroid.squaredNorm());
  const double near = static_cast<double>(kNearView) * N::to_double(mission.search.size);
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

// The cell before the one that x lies in; for all that is outside the grid (also far off, or not a number) one that no grid has.
std::uint32_t cell_of(N::Ratio x) {
  const N::Ratio near = x < kFarthestCell ? x : 0;
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(near > 0 ? near : 0)) - 1;
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
    if (are_apart(hypothesis.T_target_sensor.q, other.T_target_sensor.q, kCosHalfApart)) continue;
    if (other.score <= hypothesis.score) return;
  }
  for (std::size_t i = 0; i < list_.size(); ++i) {
    if (are_apart(hypothesis.T_target_sensor.q, list_[i].T_target_sensor.q, kCosHalfApart)) list_[kept++] = list_[i];
  }
  list_.shrink(kept);
  if (list_.push_back(hypothesis)) return;
  Hypothesis& last = list_[worst()];
  if (hypothesis.score < last.score) last = hypothesis;
}

// A hypothesis as the scores use it: cell coordinates = R y + t for a point y in the axes of the line of sight.
struct CoarseSearch::RolledView {
  N::Ratio R[3][3];
  N::Ratio t[3];
};

void CoarseSearch::begin(const Evidence& evidence) {
  short_list_.clear();
  next_view_ = 0;
  count_ = evidence.hits.size() < kCoarsePoints ? evidence.hits.size() : kCoarsePoints;
  const double range2 = evidence.centroid.squaredNorm();
  sight_ = axes_along(range2 > 0 ? Vec3(-evidence.centroid / square_root(range2)) : Vec3(-Vec3::UnitZ()));
  for (std::size_t i = 0; i < count_; ++i) {
    const Vec3 y = sight_.transpose() * (to_vec3(evidence.hits[i].p) - evidence.centroid);
    for (int k = 0; k < 3; ++k) points_[i][k] = N::to_length(y[k]);
  }
}

bool CoarseSearch::step(const Mission& mission, const Evidence& evidence) {
  const ModelView<N>& view = mission.search.views[next_view_];
  const Vec3 afar = to_vec3(view.centroid);
  centroid_ = afar + nearness(mission, evidence) * (to_vec3(view.near_centroid) - afar);
  const Mat3 axes = axes_along(to_vec3(mission.search.views[next_view_].direction));
  for (std::uint32_t roll = 0; roll < kRolls; ++roll) try_roll(mission, evidence, axes, roll);
  return ++next_view_ < mission.search.views.size();
}

void CoarseSearch::try_roll(const Mission& mission, const Evidence& evidence, const Mat3& view_axes, std::uint32_t roll) {
  const SearchTables<N>& tables = mission.search;
  const SinCos turn = sin_cos(2 * kPi / kRolls * roll);
  Mat3 roll_axes;
  roll_axes << turn.cos, -turn.sin, 0, turn.sin, turn.cos, 0, 0, 0, 1;
  const Mat3 R = view_axes * roll_axes;  // line of sight to target
  RolledView rolled{};
  const double scale = N::to_double(tables.cells_per_m);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rolled.R[i][j] = N::to_ratio(scale * R(i, j));
    rolled.t[i] = N::to_ratio(scale * (centroid_[i] - N::to_double(tables.origin[i])));
  }
  Hypothesis hypothesis;
  hypothesis.score = score(tables, rolled);
  if (!short_list_.wants(hypothesis.score)) return;
  const Mat3 R_target_sensor = R * sight_.transpose();
  hypothesis.T_target_sensor.q = to_quaternion(R_target_sensor);
  hypothesis.T_target_sensor.p = centroid_ - R_target_sensor * evidence.centroid;
  short_list_.offer(hypothesis);
}

std::uint32_t CoarseSearch::score(const SearchTables<N>& tables, const RolledView& rolled) const {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    std::uint32_t cell[3];
    for (int k = 0; k < 3; ++k) {
      cell[k] = cell_of(rolled.t[k] + dot3<N>(rolled.R[k], points_[i]) + 1);
    }
    sum += distance_byte(tables, cell[0], cell[1], cell[2]);
  }
  return sum;
}

}  // namespace lasso
