// The command line that the campaigns share: PROGRAM MISSION FILE COUNT SEED [LAST].
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace lasso::campaign {

struct CommandLine {
  const char* program;
  const char* count;  // what COUNT counts, at least one
  const char* last;   // the optional argument, a count or 0
};
using Fly = std::function<std::string(const char* mission, std::uint32_t count, std::uint64_t seed, std::uint32_t last)>;

// Writes the table (CSV) that `fly` returns into FILE. The exit code: 0, or 2 with a message, where an argument or the flight is refused.
int main_of(const CommandLine& line, int argc, char** argv, const Fly& fly);

}  // namespace lasso::campaign
