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
  out << "| mode | | scans | confirms | takes up | awaits a start |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const ModeProperties& mode : mode_properties()) {
    out << "| " << mode.name << " | " << mode.meaning << " | " << scans_of(mode) << " | " << yes(mode.confirms) << " | "
        << yes(mode.takes_up) << " | " << yes(mode.awaits_start) << " |\n";
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
- **confirms**: a valid pose confirms a start, and starts the filter anew. It has to explain `start.inlier_share_min` of the returns. It has to agree with
  the prediction within `start.gate`. Where `start.check` is set, and its attitude is stated no better than 3° (1 sigma), its scan is searched. The start is `unchecked` until the search has found no
  better pose. Where that search is not sure, another scan is searched, too.
- **takes up**: the share of returns that a valid pose explains, and its agreement, have to exceed the limits of tracking by `tracking.hysteresis`. The
  agreement has to by no more than half of what is missing to 1.
- **awaits a start**: the next untried pose to start from is taken, in the mission's order `start.first` to `start.fifth`. Search has its turn in bearing,
  once the bearing is known.

)";

constexpr char kEvents[] = R"(Events of the second table:
- `exhausted` and `recover` come when the mode's frames are used up and the mode is not held. `tracking.recover` says which of the two. The frames are
  `start.frames`, `tracking.coast_frames`, `tracking.reacquire_frames` or `search.frames`.
- A start that no scan confirmed ends with `fall_back` where it interrupted a track. It ends with `recover`, too, where the order leaves a search to be
  tried.
- `near` is a valid pose within `short_range.enter_m` of the target's origin, in tracking. `far` is one beyond `short_range.leave_m`, in short_range. Both
  need a mode that is not held. Both may also be commanded.
- An event that a mode has no row for changes nothing.

After `near` or `far` the range does not change the mode back at once. Before that, a valid pose has to be where the mode is for. In short_range that is
within `short_range.leave_m`, otherwise it is not within `short_range.enter_m`. Until then a short_range that was commanded far away stays, and so does a
tracking close by. Another command ends it.

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
