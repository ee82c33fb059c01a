// Parameters that were changed in flight, apart from the image: the image's values stay what they are, and hold again when a change is
// taken back. Two copies, each with its CRC-32C; a damaged one is repaired from the other.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/mission/mission.hpp"
#include "fsw/mission/parameters.hpp"

namespace lasso {

constexpr std::size_t kMaxParameters = 128;  // rows of parameter_rows()
constexpr std::size_t kSavedParameterBytes = 4 + kMaxParameters / 8 + 8 * kMaxParameters;

// Why a parameter is not changed.
enum class ParameterRefusal : std::uint8_t {
  kNone = 0,
  kNoSuchParameter = 1,
  kFixed = 2,         // it is the image's alone: of a sensor, of the scan's pattern and times, the frame's period, a track's start
  kOutOfLimits = 3,   // of its row; not a number; not whole where it has to be
  kInconsistent = 4,  // with the others: short_range.leave_m is not above short_range.enter_m
  kOtherTable = 5,    // of a saved set: the parameters of the software that saved it are others
};

enum class AreaState : std::uint8_t {
  kRight = 0,
  kRepaired = 1,  // one copy was damaged
  kLost = 2,      // both were: no parameter is changed any more
};

class ParameterArea {
 public:
  ParameterArea();

  // In the unit of the row. `now` are the parameters as they are: what is refused changes nothing. Loop bound: two copies' bytes.
  ParameterRefusal set(std::size_t row, double value, const MissionParameters& now);
  // Every parameter is the image's again.
  void revert();
  bool changed(std::size_t row) const;
  std::size_t changes() const;  // how many are

  // What is changed, as bytes to keep. restore() takes them back, all of them or none, with `image` being the image's own parameters: each
  // is checked as set() does. Loop bound: kMaxParameters.
  void save(Bytes out) const;
  ParameterRefusal restore(ConstBytes saved, const MissionParameters& image);

  // Writes what was changed over the image's values.
  void apply(MissionParameters& parameters) const;

  // Compares both copies with their checksums, and repairs. Loop bound: their bytes.
  AreaState check();

  // For tests that damage memory.
  Bytes copy(std::size_t i) { return {reinterpret_cast<std::uint8_t*>(&copies_[i]), sizeof(Copy)}; }

 private:
  struct Copy {
    double values[kMaxParameters] = {};  // SI, of the changed ones
    std::uint32_t changed[kMaxParameters / 32] = {};
    std::uint64_t sum = 0;  // CRC-32C of all before it; so wide that the struct has no byte that it does not cover
  };
  static std::uint32_t sum_of(const Copy& copy);
  void keep(const Copy& copy);

  Copy copies_[2];
};

// Rows that the link may change.
bool is_changeable(std::size_t row);

}  // namespace lasso
