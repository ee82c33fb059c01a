// Reads the compiled tables in double precision, by the words of image_format.hpp and nothing else.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mdat/modelc/model.hpp"

namespace lasso::mdat {

struct DecodedElement {
  Eigen::Vector3d n;
  double d;
  std::array<Eigen::Vector3d, 4> m;
  std::array<double, 4> c;
  std::uint32_t curvature, flags;

  bool contains(const Eigen::Vector3d& p, double slack) const {
    for (std::size_t i = 0; i < 4; ++i) {
      if (m[i].dot(p) < c[i] - slack) return false;
    }
    return true;
  }
};

class DecodedTables {
 public:
  explicit DecodedTables(const ModelTables& tables) : tables_(tables) {
    const std::size_t count = tables[TableId::kElements].size() / kElementWords;
    for (std::size_t i = 0; i < count; ++i) elements_.push_back(decode(i));
  }

  std::uint32_t geometry(std::uint32_t word) const { return tables_[TableId::kFieldGeometry][word]; }
  double length(std::uint32_t word) const {
    return std::ldexp(static_cast<double>(static_cast<std::int32_t>(word)), -static_cast<int>(geometry(kLengthFractionBits)));
  }
  static double unit(std::uint32_t word) { return std::ldexp(static_cast<double>(static_cast<std::int32_t>(word)), -kUnitFractionBits); }
  Eigen::Vector3d point(TableId id, std::size_t word) const {
    const auto& words = tables_[id];
    return {length(words[word]), length(words[word + 1]), length(words[word + 2])};
  }
  Eigen::Vector3d direction(TableId id, std::size_t word) const {
    const auto& words = tables_[id];
    return {unit(words[word]), unit(words[word + 1]), unit(words[word + 2])};
  }
  double cell() const { return length(geometry(kCellSize)); }
  Eigen::Vector3d origin() const { return point(TableId::kFieldGeometry, kOriginX); }
  const std::vector<DecodedElement>& elements() const { return elements_; }

  // Cell indices of a point; false outside the grid.
  bool locate(const Eigen::Vector3d& p, std::array<std::uint32_t, 3>& cell_index) const {
    for (int i = 0; i < 3; ++i) {
      const double x = std::floor((p[i] - origin()[i]) / cell());
      if (x < 0 || x >= 8.0 * geometry(kBricksX + static_cast<std::uint32_t>(i))) return false;
      cell_index[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(x);
    }
    return true;
  }
  std::size_t brick(const std::array<std::uint32_t, 3>& at) const {
    return ((at[2] >> 3) * geometry(kBricksY) + (at[1] >> 3)) * std::size_t{geometry(kBricksX)} + (at[0] >> 3);
  }
  // The word of a cell, or that of its empty brick.
  std::uint32_t ray_word(const std::array<std::uint32_t, 3>& at) const {
    const std::uint32_t record = tables_[TableId::kBricks][kBrickWords * brick(at)];
    if ((record & kEmptyBit) != 0) return record;
    return tables_[TableId::kRayCells][kRayCellsPerBrick * record + ((at[2] & 7) << 6 | (at[1] & 7) << 3 | (at[0] & 7))];
  }
  bool occupied(const std::array<std::uint32_t, 3>& at) const { return (ray_word(at) & kEmptyBit) == 0; }
  std::vector<std::uint32_t> entries(std::uint32_t word) const {
    const auto first = tables_[TableId::kRayLists].begin() + static_cast<std::ptrdiff_t>(word & kListOffsetMask);
    return {first, first + static_cast<std::ptrdiff_t>(word >> kListOffsetBits)};
  }
  // The elements of the cell's entries, ascending.
  std::vector<std::uint32_t> list(std::uint32_t word) const {
    std::vector<std::uint32_t> elements = entries(word);
    for (std::uint32_t& entry : elements) entry &= ~kFinalEntry;
    std::sort(elements.begin(), elements.end());
    return elements;
  }

  // Where the ray from `from` along `u` crosses an element's region, from either side; infinity: nowhere.
  double crossing(std::size_t index, const Eigen::Vector3d& from, const Eigen::Vector3d& u) const {
    const DecodedElement& e = elements_[index];
    const double t = (e.d - e.n.dot(from)) / e.n.dot(u);
    return std::isfinite(t) && e.contains(from + t * u, 0) ? t : std::numeric_limits<double>::infinity();
  }

 private:
  DecodedElement decode(std::size_t index) const {
    const auto& words = tables_[TableId::kElements];
    const std::size_t at = kElementWords * index;
    DecodedElement e{direction(TableId::kElements, at), length(words[at + 3]), {}, {}, words[at + 4], words[at + 5]};
    for (std::size_t i = 0; i < 4; ++i) {
      for (int axis = 0; axis < 3; ++axis) e.m[i][axis] = unit(words[at + 6 + 4 * static_cast<std::size_t>(axis) + i]);
      e.c[i] = length(words[at + 18 + i]);
    }
    return e;
  }

  const ModelTables& tables_;
  std::vector<DecodedElement> elements_;
};

}  // namespace lasso::mdat
