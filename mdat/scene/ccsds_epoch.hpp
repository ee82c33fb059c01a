// Epochs of CCSDS messages: YYYY-MM-DDThh:mm:ss[.d...][Z] or YYYY-DDDThh:mm:ss[.d...][Z] (CCSDS 301.0-B-4, ASCII time codes A and B).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lasso::mdat::scene {

struct Epoch {
  std::int64_t day = 0;  // since 1970-01-01
  double second = 0;     // of the day
};

// None where the text is no epoch, or a leap second: the 60th second of a minute cannot be told from the next minute's first one without
// a table of leap seconds, which MDAT has not.
std::optional<Epoch> parse_epoch(std::string_view text);

// By days of 86,400 s: over a leap second of UTC it is a second less than what passed.
double seconds_between(const Epoch& from, const Epoch& to);

}  // namespace lasso::mdat::scene
