// Writes the flight image of the tests' box to a file: write_box_image FILE.
#include <cstdio>
#include <cstdlib>

#include "fsw/core/invariant.hpp"
#include "ut/support/box_image.hpp"

namespace lasso {
[[noreturn]] void on_invariant_failure(const InvariantFailure& failure) {
  std::fprintf(stderr, "invariant failed: %s\n", failure.what);
  std::abort();
}
}  // namespace lasso

int main(int argc, char** argv) {
  lasso::MissionParameters parameters = lasso::preset_parameters();
  parameters.start_check = 0;  // the example starts near the truth, and prints the first eight scans
  lasso::test::TestImage image = lasso::test::make_box_image(parameters);
  std::FILE* file = argc == 2 ? std::fopen(argv[1], "wb") : nullptr;
  if (file == nullptr) {
    std::fprintf(stderr, "usage: write_box_image FILE\n");
    return 2;
  }
  const bool written = std::fwrite(image.data(), 1, image.size, file) == image.size;
  return std::fclose(file) == 0 && written ? 0 : 1;
}
