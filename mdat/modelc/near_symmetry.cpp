#include "mdat/modelc/near_symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mdat/modelc/parallel.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kAxes = 162;
constexpr int kTurns = 24;
constexpr std::size_t kCoarsePoints = 150;
constexpr std::size_t kFinePoints = 600;
constexpr std::size_t kRefined = 24;
constexpr int kIterations = 12;
constexpr double kMismatchMax = 0.35;

using Points = std::vector<Vec3d>;

// Of the points of all views, `count` evenly in their order.
Points sample(const std::vector<View>& views, std::size_t count) {
  Points all, chosen;
  for (const View& view : views) all.insert(all.end(), view.seen.begin(), view.seen.end());
  for (std::size_t i = 0; i < count && !all.empty(); ++i) chosen.push_back(all[(2 * i + 1) * all.size() / (2 * count)]);
  return chosen;
}

Vec3d middle_of(const Points& points) {
  Vec3d sum = Vec3d::Zero();
  for (const Vec3d& p : points) sum += p;
  return points.empty() ? sum : Vec3d(sum / static_cast<double>(points.size()));
}

NearSymmetryMotion turn_about(const Vec3d& middle, const Eigen::Quaterniond& q) { return {q, middle - q * middle, 1}; }

double mismatch(const NearSymmetryMotion& motion, const Points& points, const SearchGrid& grid) {
  double sum = 0;
  for (const Vec3d& p : points) sum += grid.distance_m(motion.q * p + motion.p) / grid.truncation_m;
  return points.empty() ? 1 : sum / static_cast<double>(points.size());
}

// Axis and angle of every hypothesis: all rotations, evenly.
std::vector<NearSymmetryMotion> all_turns(const Vec3d& middle) {
  std::vector<NearSymmetryMotion> motions;
  for (const Vec3d& direction : spread_directions(kAxes)) {
    const Eigen::AngleAxisd azimuth(std::atan2(direction.y(), direction.x()), Vec3d::UnitZ());
    const Eigen::Quaterniond tilt = azimuth * Eigen::AngleAxisd(std::acos(std::clamp(direction.z(), -1.0, 1.0)), Vec3d::UnitY());
    for (int k = 0; k < kTurns; ++k) {
      const double angle = 2 * std::numbers::pi * k / kTurns;
      motions.push_back(turn_about(middle, tilt * Eigen::AngleAxisd(angle, Vec3d::UnitZ())));
    }
  }
  return motions;
}

bool is_apart(const NearSymmetryMotion& motion, const std::vector<NearSymmetryMotion>& others) {
  const auto far = [&](const Eigen::Quaterniond& q) { return motion.q.angularDistance(q) > kSymmetryApart_rad; };
  return far(Eigen::Quaterniond::Identity()) && std::all_of(others.begin(), others.end(), [&](const auto& other) { return far(other.q); });
}

// The best of them that are apart from each other and from no motion.
std::vector<NearSymmetryMotion> best_apart(std::vector<NearSymmetryMotion> motions, std::size_t count) {
  std::sort(motions.begin(), motions.end(), [](const auto& a, const auto& b) { return a.mismatch < b.mismatch; });
  std::vector<NearSymmetryMotion> best;
  for (const NearSymmetryMotion& motion : motions) {
    if (best.size() < count && is_apart(motion, best)) best.push_back(motion);
  }
  return best;
}

// Gauss-Newton on distances to the closest surface points, each weighted by Tukey's kernel of the truncation.
NearSymmetryMotion refined(NearSymmetryMotion motion, const Points& points, const SearchGrid& grid, const NearestSearch& nearest) {
  for (int k = 0; k < kIterations; ++k) {
    Eigen::Matrix<double, 6, 6> H = 1e-9 * Eigen::Matrix<double, 6, 6>::Identity();
    Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
    for (const Vec3d& p : points) {
      const Vec3d m = motion.q * p + motion.p;
      const Vec3d gap = nearest.closest(m).point - m;
      const double share = gap.norm() / grid.truncation_m;
      if (share >= 1 || share < 1e-9) continue;
      const Vec3d n = gap.normalized();
      Eigen::Matrix<double, 6, 1> row;
      row << m.cross(n), n;
      const double weight = (1 - share * share) * (1 - share * share);
      H += weight * row * row.transpose();
      b += weight * row * gap.norm();
    }
    const Eigen::Matrix<double, 6, 1> x = H.ldlt().solve(b);
    const Vec3d turn = x.head<3>();
    const Eigen::Quaterniond step(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()));
    motion.q = (step * motion.q).normalized();
    motion.p = step * motion.p + x.tail<3>();
  }
  motion.mismatch = mismatch(motion, points, grid);
  return motion;
}

}  // namespace

std::vector<NearSymmetryMotion> find_near_symmetries(const std::vector<View>& views, const SearchGrid& grid, const NearestSearch& nearest) {
  const Points coarse = sample(views, kCoarsePoints);
  const Points fine = sample(views, kFinePoints);
  std::vector<NearSymmetryMotion> motions = all_turns(middle_of(fine));
  parallel_for(motions.size(), [&](std::size_t i) { motions[i].mismatch = mismatch(motions[i], coarse, grid); });
  motions = best_apart(motions, kRefined);
  for (NearSymmetryMotion& motion : motions) motion = refined(motion, fine, grid, nearest);
  std::erase_if(motions, [](const auto& motion) { return motion.mismatch > kMismatchMax; });
  return best_apart(motions, kMaxSymmetries);
}

std::vector<std::uint32_t> symmetry_words(const std::vector<NearSymmetryMotion>& motions, const LengthScale& scale) {
  std::vector<std::uint32_t> words;
  for (const NearSymmetryMotion& motion : motions) {
    for (int i = 0; i < 4; ++i) words.push_back(static_cast<std::uint32_t>(unit_word(motion.q.coeffs()[i])));
    for (int i = 0; i < 3; ++i) words.push_back(static_cast<std::uint32_t>(scale.to_word(motion.p[i])));
  }
  return words;
}

}  // namespace lasso::mdat
