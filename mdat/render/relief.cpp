#include "mdat/render/relief.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "hal_sim/random.hpp"

namespace lasso::mdat {
namespace {

struct Cell {
  std::int64_t x, y, z;
};

Cell cell_of(const Vec3& place) {
  return {static_cast<std::int64_t>(std::floor(place.x())), static_cast<std::int64_t>(std::floor(place.y())),
          static_cast<std::int64_t>(std::floor(place.z()))};
}

std::uint64_t cell_bits(const Cell& cell, std::uint32_t seed) {
  const auto part = [](std::int64_t value) { return static_cast<std::uint64_t>(value) & 0x1FFFFF; };
  std::uint64_t state = (part(cell.x) | part(cell.y) << 21 | part(cell.z) << 42) ^ std::uint64_t{seed} * 0xD1342543DE82EF95U;
  return sim::split_mix64(state);
}

// Three numbers of 21 bits, [0, 1).
Vec3 three(std::uint64_t bits) {
  constexpr double kUnit = 1.0 / 2097152.0;
  return kUnit *
         Vec3(static_cast<double>(bits & 0x1FFFFF), static_cast<double>(bits >> 21 & 0x1FFFFF), static_cast<double>(bits >> 42 & 0x1FFFFF));
}

// A cell and those around it, the nearest ones first.
const std::array<std::array<int, 3>, 27>& neighbours() {
  static const std::array<std::array<int, 3>, 27> steps = [] {
    std::array<std::array<int, 3>, 27> all{};
    for (int i = 0; i < 27; ++i) all[static_cast<std::size_t>(i)] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
    const auto size = [](const std::array<int, 3>& step) { return std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]); };
    std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return size(a) < size(b); });
    return all;
  }();
  return steps;
}

double at_corner(const Cell& cell, std::uint32_t seed) { return 2 * three(cell_bits(cell, seed)).x() - 1; }

double between(double a, double b, double share) { return a + (b - a) * share; }

}  // namespace

Vec3 facet_tilt(const Vec3& place, std::uint32_t seed) {
  const Cell here = cell_of(place);
  const Vec3 within = place - Vec3(static_cast<double>(here.x), static_cast<double>(here.y), static_cast<double>(here.z));
  const auto gap = [&](int axis, int step) { return step == 0 ? 0.0 : step > 0 ? 1 - within[axis] : within[axis]; };
  double nearest = std::numeric_limits<double>::infinity();
  std::uint64_t found = 0;
  for (const std::array<int, 3>& step : neighbours()) {
    const double x = gap(0, step[0]), y = gap(1, step[1]), z = gap(2, step[2]);
    if (x * x + y * y + z * z > nearest) continue;  // no place of that cell is as near
    const Cell cell{here.x + step[0], here.y + step[1], here.z + step[2]};
    const std::uint64_t bits = cell_bits(cell, seed);
    const Vec3 middle = Vec3(static_cast<double>(cell.x), static_cast<double>(cell.y), static_cast<double>(cell.z)) + three(bits);
    const double distance = (middle - place).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      found = bits;
    }
  }
  constexpr double kUnitSpread = 1.7320508075688772;  // sqrt(3): of numbers that are uniform from -1 to 1
  return kUnitSpread * (2 * three(sim::split_mix64(found)) - Vec3::Ones());
}

double smooth_noise(const Vec3& place, std::uint32_t seed) {
  const Cell c = cell_of(place);
  const auto smooth = [](double value, std::int64_t low) {
    const double t = value - static_cast<double>(low);
    return t * t * (3 - 2 * t);
  };
  const double x = smooth(place.x(), c.x), y = smooth(place.y(), c.y), z = smooth(place.z(), c.z);
  const auto along_x = [&](std::int64_t j, std::int64_t k) {
    return between(at_corner({c.x, c.y + j, c.z + k}, seed), at_corner({c.x + 1, c.y + j, c.z + k}, seed), x);
  };
  return between(between(along_x(0, 0), along_x(1, 0), y), between(along_x(0, 1), along_x(1, 1), y), z);
}

}  // namespace lasso::mdat
