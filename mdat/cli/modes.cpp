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
void print_modes_page(std::ostream& out) {
  out << "# The modes\n\nPrinted by `mdat modes` from the table that the component executes (`fsw/mode/modes.cpp`).\n\n"
         "- **confirms**: a valid pose has to explain `start.inlier_share_min` of the returns and to agree with the prediction within "
         "`start.gate`,\n  and no near-symmetry of it may explain the scan better by `start.twin_margin`,\n  unless the pose explains 99 % "
         "of the returns; it starts the filter anew.\n"
         "  Where `start.check` is set a start is `unchecked` until a search of its scan, and where that is not sure of another one, has "
         "found no better pose.\n"
         "- **takes up**: the shares of a valid pose have to exceed the limits of tracking by `tracking.hysteresis`.\n"
         "- **awaits a start**: the next untried pose to start from is taken, in the mission's order `start.first` to `start.fifth`. "
         "Search\n  has its turn in bearing, once the bearing is known.\n\n"
         "`exhausted` and `recover` come when the mode's frames (`start.frames`, `tracking.coast_frames`, `tracking.reacquire_frames`,\n"
         "`search.frames`) are used up and the mode is not held; which of the two, `tracking.recover` says. A start that no scan "
         "confirmed\n"
         "ends with `fall_back` where it interrupted a track, and with `recover`, too, where the order leaves a search to be tried. An "
         "event that a mode has no row for changes nothing.\n\n"
         "`near` and `far` are valid poses within `short_range.enter_m` of the target's origin in tracking, and beyond "
         "`short_range.leave_m` in\nshort_range, if the mode is not held; or commands. After either the range does not change the mode "
         "back "
         "before a valid pose has been where\nthe mode is for: within `short_range.leave_m` in short_range, not within "
         "`short_range.enter_m` otherwise. A short_range that is commanded far\naway, or a tracking close by, stays until then, or until "
         "another mode is commanded.\n\n";
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
