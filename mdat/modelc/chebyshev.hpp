// Chessboard distance to the nearest occupied cell of a grid.
#pragma once

#include <cstdint>
#include <vector>

namespace lasso::mdat {

class ChebyshevMap {
 public:
  ChebyshevMap(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz);
  void occupy(std::uint32_t x, std::uint32_t y, std::uint32_t z) { values_[index(x, y, z)] = 0; }
  // Exact up to kMaxCellDistance, and that beyond. Two passes over the 13 neighbours before and after (Rosenfeld, Pfaltz 1966).
  void propagate();
  std::uint32_t distance(std::uint32_t x, std::uint32_t y, std::uint32_t z) const { return values_[index(x, y, z)]; }

 private:
  // A border of one cell on each side stays at the limit.
  std::size_t index(std::size_t x, std::size_t y, std::size_t z) const { return ((z + 1) * (ny_ + 2) + y + 1) * (nx_ + 2) + x + 1; }
  std::size_t nx_, ny_, nz_;
  std::vector<std::uint8_t> values_;
};

}  // namespace lasso::mdat
