#include "ft/campaign/main_of.hpp"

#include <cstdio>
#include <exception>

#include "mdat/common/count.hpp"
#include "mdat/common/output.hpp"

namespace lasso::campaign {

int main_of(const CommandLine& line, int argc, char** argv, const Fly& fly) {
  if (argc < 5) {
    (void)std::fprintf(stderr, "usage: %s MISSION FILE %s SEED [%s]\n", line.program, line.count, line.last);
    return 2;
  }
  try {
    const auto count = mdat::count_of<std::uint32_t>(line.count, argv[3], 1);
    const auto seed = mdat::count_of<std::uint64_t>("SEED", argv[4]);
    const auto last = argc > 5 ? mdat::count_of<std::uint32_t>(line.last, argv[5]) : 0;
    mdat::write_file(argv[2], fly(argv[1], count, seed, last));
  } catch (const std::exception& error) {
    (void)std::fprintf(stderr, "%s: %s\n", line.program, error.what());
    return 2;
  }
  return 0;
}

}  // namespace lasso::campaign
