#include "fsw/mode/modes.hpp"

#include <iostream>

#include "mdat/cli/commands.hpp"

namespace lasso::mdat {
namespace {

const char* yes(bool value) { return value ? "yes" : ""; }

const char* scans_of(const ModeProperties& mode) {
  if (!mode.scans) return "";
  if (mode.searches) return "around the bearing";
  if (mode.full_field) return "full field";
  if (mode.by_parts) return "aimed at a part each";
  return mode.wide_start ? "aimed, wide start" : "aimed";
}

void print_modes(std::ostream& out) {
  out << "| mode | | scans | tries a start | confirms | takes up | awaits a start |\n| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const ModeProperties& mode : mode_properties()) {
    out << "| " << mode.name << " | " << mode.meaning << " | " << scans_of(mode) << " | " << yes(mode.tries_start) << " | "
        << yes(mode.confirms) << " | " << yes(mode.takes_up) << " | " << yes(mode.awaits_start) << " |\n";
  }
}

void print_transitions(std::ostream& out) {
  out << "| from | event | to | |\n| --- | --- | --- | --- |\n";
  for (const ModeTransition& row : mode_transitions()) {
    out << "| " << to_string(row.from) << " | " << to_string(row.event) << " | " << to_string(row.to) << " | " << row.meaning << " |\n";
  }
}

// docs/modes.md is this, written down.
constexpr char kColumns[] = R"(# The modes

Printed by `mdat modes` from the table that the component executes (`fsw/mode/modes.cpp`). Words: [glossary](glossary.md).

The columns of the first table:
- **scans**: where the sensor scans. *Aimed* is around the predicted target. With a *wide start* the registration may begin far off.
- **tries a start**: a start is not yet believed. Its source, and the track that it interrupted, are remembered.
- **confirms**: a valid pose confirms the start or the prediction, and starts the filter anew. It has to explain `start.inlier_share_min` of the returns, and
  to agree with the prediction within 25 squared sigmas.
- **takes up**: the share of returns that a valid pose explains has to exceed the limit of tracking by `tracking.hysteresis`. So has its agreement, but by no
  more than half of the way from that limit to 1.
- **awaits a start**: the next pose to start from that has not been tried is taken, in the mission's order `start.first` to `start.fifth`. A search is tried in
  bearing alone, once the bearing is known.

)";

constexpr char kEvents[] = R"(Events of the second table:
- `exhausted` and `recover` come when more frames in a row than the mode allows gave no valid pose, and the mode is not held. `tracking.recover` says which of
  the two. The frames allowed are `start.frames` in starting and verifying, `search.frames` in searching, `tracking.reacquire_frames` in reacquiring and
  `tracking.coast_frames` in all other modes.
- `check` comes instead of `pose_valid` where `start.check` is set, the start is no search's, and its attitude is stated no better than to 3° (1 sigma). In
  verifying the scan that confirmed the start is searched for a better pose. Meanwhile the poses of all scans join the filter, and are `unchecked`. A search
  that neither accepts the pose nor contradicts it is followed by one of another scan, once. Then the first valid pose is `pose_valid`, that of the frame in which
  the search ends, too.
- `confirm_anew` comes where a check ends without an answer: a scan was implausible, the frame that began the search came too late, the clock jumped, or another
  image became active. It also comes where the search contradicts the start while the mode is held.
- A start that no scan confirmed, or that its check contradicted, ends with `fall_back` where it interrupted a track. Otherwise it ends with `recover` also
  where the mission's order names a search, unless that search gave the start. The search is then tried in bearing.
- `near` comes with a valid pose in tracking, when the target's origin is within `short_range.enter_m`. `far` comes with one in short_range, when the origin is
  beyond `short_range.leave_m`. The range causes neither while the mode is held. Both may
  also be commanded: `set_mode mode=short_range` in tracking, `mode=tracking` in short_range.
- An event without a row for the present mode changes nothing.

After `near` or `far` the range does not change the mode back at once. First a valid pose has to be at a range that suits the mode: within
`short_range.leave_m` in short_range, not within `short_range.enter_m` in any other mode. So a short_range that was commanded far away stays, and so does a
tracking that was commanded close by. A new start ends this. Other commands still change the mode.

)";

void print_modes_page(std::ostream& out) {
  out << kColumns << kEvents;
  print_modes(out);
  out << '\n';
  print_transitions(out);
}

}  // namespace

void add_modes_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("modes", "Print the modes and their transitions, as docs/modes.md shows them");
  command->callback([] { print_modes_page(std::cout); });
}

}  // namespace lasso::mdat
