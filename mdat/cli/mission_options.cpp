#include "mdat/cli/commands.hpp"

namespace lasso::mdat {

void add_no_cache(CLI::App& command, bool& cached) {
  command.add_flag("!--no-cache", cached,
                   "compile the target's models anew: neither take them from the cache of compiled models (in MDAT_CACHE, else "
                   "$XDG_CACHE_HOME/3dlasso, else ~/.cache/3dlasso) nor keep them there");
}

void add_settings(CLI::App& command, std::vector<std::string>& settings) {
  command.add_option("--set", settings, "KEY=VALUE in place of what the mission says, such as scan.points=512; for more, again --set")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

}  // namespace lasso::mdat
