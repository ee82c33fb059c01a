#include "mdat/run/compare.hpp"

#include <cstdio>
#include <memory>
#include <utility>

#include "mdat/cli/commands.hpp"

namespace lasso::mdat {

void add_compare_command(CLI::App& app) {
  const auto names = std::make_shared<std::pair<std::string, std::string>>();
  CLI::App* command =
      app.add_subcommand("compare", "print the results of two runs side by side: what differs in their settings, then errors");
  command->add_option("A", names->first, "folder of a run, or its results.json")->required();
  command->add_option("B", names->second, "the other one")->required();
  command->footer("Exit codes: 0 printed, whatever differs; 2 one of the two is not the results of a run.");
  command->callback([names] { std::fputs(comparison_text(load_results(names->first), load_results(names->second)).c_str(), stdout); });
}

}  // namespace lasso::mdat
