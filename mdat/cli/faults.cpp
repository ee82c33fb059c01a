#include "fsw/exec/faults.hpp"

#include <iostream>

#include "fsw/link/fault_choices.hpp"
#include "mdat/cli/commands.hpp"

namespace lasso::mdat {
namespace {

void print_row(std::ostream& out, const FaultRow& row) {
  const Choice& text = kFault.choices[static_cast<std::size_t>(row.fault)];
  out << "| " << text.name << " | " << text.meaning << " | " << +row.confirm_frames << " | ";
  if (row.clear_frames == 0) out << "at the next start";
  if (row.clear_frames > 0) out << +row.clear_frames;
  out << " | " << to_string(row.reaction) << " | " << text.action << " |\n";
}

// docs/faults.md is this, written down.
constexpr char kHead[] = R"(# Faults

Printed by `mdat faults` from the table that the component executes (`fsw/exec/faults.cpp`). Words: [glossary](glossary.md).

A fault that is seen in as many frames running as **confirm** says is confirmed. The event `fault_confirmed` reports it, and the component reacts. One
that is not seen for as many frames as **clear** says is cleared, with the event `fault_cleared`. Of several reactions the heaviest is carried out. The
packet `health` says which faults are active, a bit each, in the order of this table.

)";

void print_faults_page(std::ostream& out) {
  out << kHead;
  out << "Reactions:\n\n";
  for (const Choice& reaction : kFaultReaction.choices) out << "- **" << reaction.name << "**: " << reaction.meaning << ".\n";
  out << "\n| fault | detected when | confirm | clear | reaction | what an operator can do |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const FaultRow& row : fault_table()) print_row(out, row);
  out << "\nA reset mends no code that a board does not load again: what `code_corrupt` needs on each board stands in\n"
         "[porting](porting.md#what-a-reset-mends).\n";
}

}  // namespace

void add_faults_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("faults", "Print the table of faults and reactions, as docs/faults.md shows it");
  command->callback([] { print_faults_page(std::cout); });
}

}  // namespace lasso::mdat
