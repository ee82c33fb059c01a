#include "mdat/modelc/ray_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "cfg/capacities.hpp"
#include "mdat/modelc/cell_list.hpp"
#include "mdat/modelc/chebyshev.hpp"
#include "mdat/modelc/parallel.hpp"

namespace lasso::mdat {
namespace {

struct Entry {
  std::uint32_t brick, cell, element;  // cell within its brick
};

struct Range {
  std::uint32_t first, last;  // inclusive
};

// Cells whose widened boxes can meet [low, high] along one axis.
Range cell_range(const Grid& grid, int axis, double low, double high) {
  const double reach = 0.5 + kCellTolerance;
  const double last_cell = grid.cells(static_cast<std::size_t>(axis)) - 1;
  const double first = std::floor((low - grid.origin[axis]) / grid.cell_m - reach);
  const double last = std::floor((high - grid.origin[axis]) / grid.cell_m + reach);
  return {static_cast<std::uint32_t>(std::clamp(first, 0.0, last_cell)), static_cast<std::uint32_t>(std::clamp(last, 0.0, last_cell))};
}

// Collects the cells of one element: bricks first, then their cells.
class CellCollector {
 public:
  CellCollector(const Grid& grid, std::vector<Entry>& entries) : grid_(grid), entries_(entries) {}

  void collect(const Element& element, std::uint32_t index) {
    const PolygonBoxTest test(element);
    for (int axis = 0; axis < 3; ++axis) {
      range_[static_cast<std::size_t>(axis)] = cell_range(grid_, axis, test.low()[axis], test.high()[axis]);
    }
    const auto& [x, y, z] = range_;
    for (std::uint32_t bz = z.first / kBrickCells; bz <= z.last / kBrickCells; ++bz) {
      for (std::uint32_t by = y.first / kBrickCells; by <= y.last / kBrickCells; ++by) {
        for (std::uint32_t bx = x.first / kBrickCells; bx <= x.last / kBrickCells; ++bx) collect_brick(test, index, {bx, by, bz});
      }
    }
  }

 private:
  void collect_brick(const PolygonBoxTest& test, std::uint32_t index, const std::array<std::uint32_t, 3>& b) {
    const std::uint32_t brick = grid_.brick_index(b[0], b[1], b[2]);
    const double half = (0.5 + kCellTolerance) * grid_.cell_m;
    if (!test.meets(grid_.brick_center(brick), grid_.brick_m() / 2 + half)) return;
    const auto begin = [&](std::size_t axis) { return std::max(range_[axis].first, kBrickCells * b[axis]); };
    const auto end = [&](std::size_t axis) { return std::min(range_[axis].last + 1, kBrickCells * (b[axis] + 1)); };
    for (std::uint32_t z = begin(2); z < end(2); ++z) {
      for (std::uint32_t y = begin(1); y < end(1); ++y) {
        for (std::uint32_t x = begin(0); x < end(0); ++x) {
          const Vec3d center = grid_.origin + grid_.cell_m * Vec3d(x + 0.5, y + 0.5, z + 0.5);
          if (test.meets(center, grid_.cell_m / 2 + half)) entries_.push_back({brick, (z & 7) << 6 | (y & 7) << 3 | (x & 7), index});
        }
      }
    }
  }

  const Grid& grid_;
  std::vector<Entry>& entries_;
  std::array<Range, 3> range_{};
};

std::vector<Entry> collect_entries(const std::vector<Element>& elements, const Grid& grid) {
  std::vector<Entry> entries;
  CellCollector collector(grid, entries);
  for (std::uint32_t i = 0; i < elements.size(); ++i) collector.collect(elements[i], i);
  std::sort(entries.begin(), entries.end(),
            [](const Entry& x, const Entry& y) { return std::tie(x.brick, x.cell, x.element) < std::tie(y.brick, y.cell, y.element); });
  return entries;
}

Vec3d cell_center(const Grid& grid, const Entry& entry) {
  const Vec3d in_brick((entry.cell & 7) + 0.5, (entry.cell >> 3 & 7) + 0.5, (entry.cell >> 6) + 0.5);
  return grid.brick_corner(entry.brick) + grid.cell_m * in_brick;
}

// Lists by content: equal ones are stored once.
class ListPool {
 public:
  explicit ListPool(std::vector<std::uint32_t>& words) : words_(words) {}
  std::uint32_t cell_word(std::vector<std::uint32_t> list) {
    const auto count = static_cast<std::uint32_t>(list.size());
    const auto [place, fresh] = offsets_.try_emplace(std::move(list), static_cast<std::uint32_t>(words_.size()));
    if (fresh) words_.insert(words_.end(), place->first.begin(), place->first.end());
    if (words_.size() > kListOffsetMask)
      fail<LargeFieldError>("the cell lists need ", words_.size(), " words; the limit is ", kListOffsetMask);
    return count << kListOffsetBits | place->second;
  }
  std::size_t count() const { return offsets_.size(); }

 private:
  std::vector<std::uint32_t>& words_;
  std::map<std::vector<std::uint32_t>, std::uint32_t> offsets_;
};

ListStatistics statistics(std::vector<std::size_t> lengths) {
  ListStatistics result;
  if (lengths.empty()) return result;
  std::sort(lengths.begin(), lengths.end());
  result.count = lengths.size();
  const std::size_t sum = std::accumulate(lengths.begin(), lengths.end(), std::size_t{0});
  result.mean = static_cast<double>(sum) / static_cast<double>(lengths.size());
  result.p99 = lengths[(lengths.size() - 1) * 99 / 100];
  result.max = lengths.back();
  return result;
}

void check_list(const Grid& grid, const Entry& entry, std::size_t count) {
  if (count <= kMaxElementsPerCell) return;
  fail<CrowdedCellError>("the cell at (", cell_center(grid, entry).transpose(), ") m lists ", count, " elements; the limit is ",
                         kMaxElementsPerCell, ": take smaller cells than ", grid.cell_m, " m, or ", kCoarserMesh);
}

// An occupied cell: its first entry, and the list as the image holds it.
struct Cell {
  const Entry* head;
  std::vector<std::uint32_t> list;
};

// `entries` are sorted by cell, and by element within one.
std::vector<Cell> gather_cells(const std::vector<Entry>& entries, const Grid& grid) {
  std::vector<Cell> cells;
  for (const Entry& entry : entries) {
    const bool same = !cells.empty() && cells.back().head->brick == entry.brick && cells.back().head->cell == entry.cell;
    if (!same) cells.push_back({&entry, {}});
    cells.back().list.push_back(entry.element);
  }
  for (const Cell& cell : cells) check_list(grid, *cell.head, cell.list.size());
  return cells;
}

void order_lists(const std::vector<Element>& elements, const Grid& grid, std::vector<Cell>& cells) {
  const double half_m = (1 + kCellTolerance) * grid.cell_m;
  const double tolerance_m = kFinalTolerance * grid.cell_m;
  parallel_for(cells.size(), [&](std::size_t i) {
    cells[i].list = make_cell_list(elements, cells[i].list, {cell_center(grid, *cells[i].head), half_m}, tolerance_m);
  });
}

// One word for each occupied cell, in the records of the occupied bricks; other cells are zero yet.
void place_lists(std::vector<Cell> cells, RayField& field, CompileReport& report) {
  ListPool pool(field.lists);
  std::vector<std::size_t> lengths;
  for (Cell& cell : cells) {
    std::uint32_t& record = field.brick_words[cell.head->brick];
    lengths.push_back(cell.list.size());
    if (record == kEmptyBit) {
      record = static_cast<std::uint32_t>(field.cells.size()) / kRayCellsPerBrick;
      field.cells.resize(field.cells.size() + kRayCellsPerBrick, 0);
    }
    field.cells[record * kRayCellsPerBrick + cell.head->cell] = pool.cell_word(std::move(cell.list));
  }
  report.ray_lists = statistics(std::move(lengths));
  report.distinct_lists = pool.count();
}

// Before time is spent on distances.
void check_size(const RayField& field) {
  const std::size_t bytes = 4 * (field.cells.size() + field.lists.size());
  if (bytes > kMaxImageBytes)
    fail<LargeFieldError>("the ray cells alone need ", bytes, " bytes; the limit of an image is ", kMaxImageBytes, ": take larger cells");
}

std::array<std::uint32_t, 3> cell_place(const Grid& grid, std::uint32_t brick, std::uint32_t cell) {
  const auto b = grid.brick_place(brick);
  return {kBrickCells * b[0] + (cell & 7), kBrickCells * b[1] + (cell >> 3 & 7), kBrickCells * b[2] + (cell >> 6)};
}

void place_distances(const Grid& grid, RayField& field) {
  ChebyshevMap map(grid.cells(0), grid.cells(1), grid.cells(2));
  const auto occupied = [&](std::uint32_t word) { return word != 0 && (word & kEmptyBit) == 0; };
  const auto for_each_cell = [&](const auto& visit) {
    for (std::uint32_t brick = 0; brick < field.brick_words.size(); ++brick) {
      for (std::uint32_t cell = 0; cell < kRayCellsPerBrick; ++cell) visit(brick, cell, cell_place(grid, brick, cell));
    }
  };
  for_each_cell([&](std::uint32_t brick, std::uint32_t cell, const auto& p) {
    const std::uint32_t record = field.brick_words[brick];
    if ((record & kEmptyBit) == 0 && occupied(field.cells[record * kRayCellsPerBrick + cell])) map.occupy(p[0], p[1], p[2]);
  });
  map.propagate();
  std::vector<std::uint32_t> nearest(field.brick_words.size(), kMaxCellDistance);
  for_each_cell([&](std::uint32_t brick, std::uint32_t cell, const auto& p) {
    const std::uint32_t distance = map.distance(p[0], p[1], p[2]);
    nearest[brick] = std::min(nearest[brick], distance);
    const std::uint32_t record = field.brick_words[brick];
    if ((record & kEmptyBit) == 0 && distance > 0) field.cells[record * kRayCellsPerBrick + cell] = kEmptyBit | distance;
  });
  for (std::size_t brick = 0; brick < nearest.size(); ++brick) {
    if ((field.brick_words[brick] & kEmptyBit) != 0) field.brick_words[brick] = kEmptyBit | nearest[brick];
  }
}

}  // namespace

PolygonBoxTest::PolygonBoxTest(const Element& element) : low_(element.outline[0]), high_(element.outline[0]) {
  const auto sides = static_cast<std::size_t>(element.sides);
  for (std::size_t i = 1; i < sides; ++i) {
    low_ = low_.cwiseMin(element.outline[i]);
    high_ = high_.cwiseMax(element.outline[i]);
  }
  add(element.n, element);
  for (std::size_t i = 0; i < sides; ++i) {
    const Vec3d edge = (element.outline[(i + 1) % sides] - element.outline[i]).normalized();
    for (int axis = 0; axis < 3; ++axis) add(edge.cross(Vec3d::Unit(axis)), element);
  }
}

void PolygonBoxTest::add(const Vec3d& direction, const Element& element) {
  constexpr double kParallel2 = 1e-20;  // an edge along a box axis: no separating direction of its own
  if (direction.squaredNorm() < kParallel2) return;
  Axis axis{direction, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), direction.cwiseAbs().sum()};
  for (std::size_t i = 0; i < static_cast<std::size_t>(element.sides); ++i) {
    const double projection = direction.dot(element.outline[i]);
    axis.low = std::min(axis.low, projection);
    axis.high = std::max(axis.high, projection);
  }
  axes_[count_++] = axis;
}

bool PolygonBoxTest::meets(const Vec3d& center, double half_m) const {
  if (((low_ - center).array() > half_m).any() || ((center - high_).array() > half_m).any()) return false;
  for (std::size_t i = 0; i < count_; ++i) {
    const Axis& axis = axes_[i];
    const double at = axis.direction.dot(center);
    const double reach = half_m * axis.spread;
    if (at + reach < axis.low || at - reach > axis.high) return false;
  }
  return true;
}

RayField make_ray_field(const std::vector<Element>& elements, const Grid& grid, CompileReport& report) {
  RayField field;
  field.brick_words.assign(grid.brick_count(), kEmptyBit);
  const std::vector<Entry> entries = collect_entries(elements, grid);
  std::vector<Cell> cells = gather_cells(entries, grid);
  order_lists(elements, grid, cells);
  place_lists(std::move(cells), field, report);
  check_size(field);
  place_distances(grid, field);
  report.ray_bricks = field.cells.size() / kRayCellsPerBrick;
  return field;
}

}  // namespace lasso::mdat
