// The calibration table that a camera was made with, as its line tells it (docs/icd/lcs.md): 25 numbers in parts. Who calibrates cameras
// asks for it; a flight goes by its mission's (fsw/mission/calibration.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/mission/calibration.hpp"
#include "hal_lcs/messages.hpp"

namespace lasso::lcs {

// kCalibrationReals in their order, then the residual's terms.
constexpr std::size_t kTableNumbers = kCalibrationRealCount + kResidualTerms;
constexpr std::size_t kNumbersPerPart = 6;

struct TablePart {
  std::uint8_t first = 0;            // number of the table
  std::uint8_t all = kTableNumbers;  // that the table has
  std::size_t count = 0;             // 1..kNumbersPerPart
  double numbers[kNumbersPerPart] = {};
};

// More than kNumbersPerPart are an invariant's failure.
FrameBytes encode(std::uint8_t sequence, const TablePart& message);
// kBadLength; kBadValue: numbers beyond those that the table has.
Status decode(const Frame& frame, TablePart& message);

// From number `first` on, as many as fit: none from kTableNumbers on.
TablePart part_of(const TriangulationCalibration& calibration, std::size_t first);
// Sets the part's numbers. kBadValue: a table of another kind. The whole is to be validated.
Status take(const TablePart& part, TriangulationCalibration& calibration);

}  // namespace lasso::lcs
