#include "mdat/modelc/chebyshev.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "cfg/capacities.hpp"

namespace lasso::mdat {

static_assert(kMaxCellDistance < 255, "distances are kept in bytes");

ChebyshevMap::ChebyshevMap(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz)
    : nx_(nx), ny_(ny), nz_(nz), values_((nx_ + 2) * (ny_ + 2) * (nz_ + 2), std::uint8_t{kMaxCellDistance}) {}

void ChebyshevMap::propagate() {
  const auto row = static_cast<std::ptrdiff_t>(nx_ + 2);
  const auto slice = row * static_cast<std::ptrdiff_t>(ny_ + 2);
  const std::array<std::ptrdiff_t, 13> before = {
      -1,         -row - 1, -row,       -row + 1,         -slice - row - 1, -slice - row,    -slice - row + 1,
      -slice - 1, -slice,   -slice + 1, -slice + row - 1, -slice + row,     -slice + row + 1};
  const auto relax = [&](std::size_t at, std::ptrdiff_t sign) {
    std::uint8_t& value = values_[at];
    int best = value;
    for (const std::ptrdiff_t step : before) best = std::min(best, values_[at + static_cast<std::size_t>(sign * step)] + 1);
    value = static_cast<std::uint8_t>(best);
  };
  for (std::size_t z = 0; z < nz_; ++z) {
    for (std::size_t y = 0; y < ny_; ++y) {
      for (std::size_t x = 0; x < nx_; ++x) relax(index(x, y, z), 1);
    }
  }
  for (std::size_t z = nz_; z-- > 0;) {
    for (std::size_t y = ny_; y-- > 0;) {
      for (std::size_t x = nx_; x-- > 0;) relax(index(x, y, z), -1);
    }
  }
}

}  // namespace lasso::mdat
