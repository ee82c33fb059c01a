// Protection levels and errors of many poses, as counts in cells of a fixed grid: those of all cases are the same whatever parts they are
// put together from, and in which order.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lasso::mdat {

// The grid is logarithmic: a level's cells are an eighth of a factor of two wide (9 %), from 2^-24 to 2^12 of its unit, and those of
// error / level a quarter (19 %), from 2^-6 to 2^10. What lies beyond is in the cells at the ends. An edge is where error and level are
// equal, so that each cell has misleading poses alone, or none.
class LevelCounts {
 public:
  // A valid pose; level and error are in one unit, and not negative.
  void add(double level, double error);
  void add(const LevelCounts& others);

  std::size_t poses() const;
  std::size_t misleading() const;  // error > level
  double median() const;           // level, to within 4.5 %; the lower one; not a number of no pose

  struct Cell {
    double level, error;  // its middle
    std::size_t poses;
    bool misleading;
  };
  std::vector<Cell> cells() const;

  // "-72:-9*3/-8 -71:-12": level, and its ratios, in steps of the grid from 1; behind a ratio, how many poses where there are several.
  std::string text() const;
  // Nothing where it is not what text() writes.
  static std::optional<LevelCounts> of(std::string_view text);

  bool operator==(const LevelCounts&) const = default;

 private:
  struct Place {
    int level, ratio;
    auto operator<=>(const Place&) const = default;
  };
  std::map<Place, std::size_t> counts_;
};

}  // namespace lasso::mdat
