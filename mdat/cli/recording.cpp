#include <cstdio>
#include <memory>

#include "mdat/cli/commands.hpp"
#include "mdat/recording/recorded_run.hpp"

namespace lasso::mdat {

void add_recording_command(CLI::App& app) {
  CLI::App* group = app.add_subcommand("recording", "look into recordings (.mcap), cut, mend, merge and export them");
  group->require_subcommand(1);
  CLI::App* info = group->add_subcommand("info", "what a recording holds: its run, topics, attachments, and what is damaged");
  const auto file = std::make_shared<std::string>();
  info->add_option("FILE", *file, "recording (.mcap), of any program")->required();
  info->callback([file] { std::fputs(contents_text(*file).c_str(), stdout); });
  add_recording_edits(group);
}

}  // namespace lasso::mdat
