#include "mdat/render/relief.hpp"

#include <cmath>
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

double at_corner(const Cell& cell, std::uint32_t seed) { return 2 * three(cell_bits(cell, seed)).x() - 1; }

double between(double a, double b, double share) { return a + (b - a) * share; }

}  // namespace

Vec3 facet_tilt(const Vec3& place, std::uint32_t seed) {
  const Cell here = cell_of(place);
  double nearest = std::numeric_limits<double>::infinity();
  std::uint64_t found = 0;
  for (int i = 0; i < 27; ++i) {
    const Cell cell{here.x + i % 3 - 1, here.y + i / 3 % 3 - 1, here.z + i / 9 - 1};
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
