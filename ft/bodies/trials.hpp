// What is tried with a body; each is the same for the same body, whatever else is tried.
#pragma once

#include "ft/bodies/tally.hpp"

namespace lasso::bodies {

// Flights of any attitude, spin up to 4 deg/s and one to twice the nearest range, which start from the pose of one frame before.
Tally track(const Subject& subject, std::size_t flights, std::uint32_t frames);

// Single scans of a target at rest, registered from a pose that is 10 deg and a tenth of the size off, as `mdat replay --wide` does.
Tally start(const Subject& subject, std::size_t starts);

// Single scans of a target at rest, searched without any pose.
Tally search(const Subject& subject, std::size_t searches);

// Single scans of a target that differs from the model: a part gone, or an array or door turned. Counted are those in which at least a
// twentieth of the returns moves by more than 5 sigma; valid is wrong here.
Tally configuration(const Subject& subject, std::size_t changes);

}  // namespace lasso::bodies
