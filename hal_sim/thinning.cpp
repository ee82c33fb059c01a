#include "hal_sim/thinning.hpp"

#include <algorithm>
#include <numeric>

namespace lasso::sim {
namespace {

constexpr int kLevels = 21;  // of the octree: three bits each fit in 64

struct Coded {
  std::uint64_t code;
  std::uint32_t index;
};

// The lowest 21 bits, each followed by two zeros.
std::uint64_t spread(std::uint64_t bits) {
  std::uint64_t result = 0;
  for (int i = 0; i < kLevels; ++i) result |= (bits >> i & 1U) << (3 * i);
  return result;
}

// By their place on the Z curve, then as they stand.
std::vector<Coded> along_curve(const std::vector<Vec3>& points) {
  Vec3 low = points.front(), high = points.front();
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double size = std::max((high - low).maxCoeff(), 1e-9);
  constexpr double kCells = (1 << kLevels) - 1;
  std::vector<Coded> coded(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 cell = kCells / size * (points[i] - low);
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) code |= spread(static_cast<std::uint64_t>(cell[axis])) << axis;
    coded[i] = {code, static_cast<std::uint32_t>(i)};
  }
  std::sort(coded.begin(), coded.end(),
            [](const Coded& a, const Coded& b) { return a.code != b.code ? a.code < b.code : a.index < b.index; });
  return coded;
}

// The first point in each cube of a level (0: the whole).
std::vector<std::uint32_t> first_in_cubes(const std::vector<Coded>& coded, int level) {
  const int shift = 3 * (kLevels - level);
  std::vector<std::uint32_t> first;
  std::uint64_t last = 0;
  for (const Coded& point : coded) {
    const std::uint64_t cube = shift < 64 ? point.code >> shift : 0;
    if (first.empty() || cube != last)
      first.push_back(point.index);
    else
      first.back() = std::min(first.back(), point.index);
    last = cube;
  }
  return first;
}

}  // namespace

std::vector<std::uint32_t> thinned(const std::vector<Vec3>& points, std::size_t most) {
  std::vector<std::uint32_t> kept(points.size());
  std::iota(kept.begin(), kept.end(), 0U);
  if (kept.size() <= most) return kept;
  const std::vector<Coded> coded = along_curve(points);
  std::vector<std::uint32_t> candidates;
  for (int level = 0; level <= kLevels && candidates.size() <= most; ++level) candidates = first_in_cubes(coded, level);
  kept.resize(std::min(most, candidates.size()));
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = candidates[i * candidates.size() / kept.size()];
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace lasso::sim
