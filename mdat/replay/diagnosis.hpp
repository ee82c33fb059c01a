// What may be wrong with all scans of a replay at once: units, axes, the order and direction of poses, the noise.
#pragma once

#include "mdat/replay/replay.hpp"

namespace lasso::mdat {

// Are the returns of all scans beyond what the sensor measures? With the factor that would bring them to where the poses say that the
// target is, where most scans then fit; without poses, within the sensor's range. Where no unit does, what reading_notes finds, too.
Notes range_notes(const Mission& mission, const ReplayOptions& options, const ReplayInput& input);

// Have depth images much smaller residuals if what they hold as depths is read as ranges, or the other way round? Tried as reading_notes.
Notes value_notes(const Mission& mission, const ReplayOptions& options, const ReplayInput& input);

// Do the poses, or the scans, fit when they are read otherwise: inverse, scalar first, in other axes? Tried on up to five scans (in closed
// loop on the first), each by a registration: one fits if it is valid within 20 deg and a quarter of the target's size of its start. Told
// where another reading fits more scans than the one that was asked for; and where no return is near the target at the poses.
Notes reading_notes(const Mission& mission, const ReplayOptions& options, const ReplayInput& input);

// Are the residuals much larger, or smaller, than the mission's noise makes them? With the noise that they show.
Notes noise_notes(const Mission& mission, const ReplayInput& input, const std::vector<ReplayedScan>& scans);

// Do rays contradict most of the poses? With the shares that do, and what tells the causes apart.
Notes mismatch_notes(const Mission& mission, const std::vector<ReplayedScan>& scans);

}  // namespace lasso::mdat
