#include <cstdio>

#include "mdat/cli/commands.hpp"
#include "mdat/missiondb/mission_text.hpp"

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

void tell_idle_settings(const MissionSource& source, const std::string& scenario) {
  for (const std::string& setting : idle_settings(source, scenario))
    std::fprintf(stderr, "note: --set %s: changes nothing: the value is the same without it\n", setting.c_str());
}

}  // namespace lasso::mdat
