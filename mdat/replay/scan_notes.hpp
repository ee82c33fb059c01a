// What a user has to know of the files of scans besides their rays: what was left out or turned, units and order of times.
#pragma once

#include <string>
#include <vector>

#include "hal_sim/scan_file.hpp"

namespace lasso::mdat {

constexpr double kQuietReplay_s = 3;  // of a replay that takes less no progress is printed off a terminal

// Lines without their ends, each "note: ..." or "warning: ...".
using Notes = std::vector<std::string>;

// Seconds in a unit of the scans' times, of those whose header names none: 1, 1e-3, 1e-6 or 1e-9, whichever brings the median span of a
// scan closest to `duration_s`, by their ratio. 1 where no scan has a span, and where a header names seconds, unless the span is within
// 20 % of `duration_s` in another unit.
double time_unit_s(const std::vector<sim::ScanFacts>& facts, double duration_s);
// The note on it; where it is seconds none, or a warning that another unit is closer, or that minutes make the same span.
Notes time_unit_note(const std::vector<sim::ScanFacts>& facts, double duration_s, double unit_s);

// Scans whose spans are those of the others in another unit: a thousand, a million or sixty times as long or as short, within 20 %.
Notes mixed_unit_notes(const sim::RecordedScans& scans, const std::vector<sim::ScanFacts>& facts, double unit_s);

// What the readers warn of, returns that may be directions, rows without a measurement, clouds that were thinned, VIEWPOINT.
Notes row_notes(const std::vector<sim::ScanFacts>& facts);

// Times that step back from a scan to the next one, here and there, at each of them, or as those of a series in reversed order do.
Notes order_notes(const sim::RecordedScans& scans, const std::vector<sim::ScanFacts>& facts, double unit_s);

}  // namespace lasso::mdat
