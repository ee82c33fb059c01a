#include "mdat/stereo/matcher.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "mdat/common/errors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// A program in place of the matcher.
std::filesystem::path script(const ScratchFolder& folder, const std::string& text) {
  const std::filesystem::path file = folder.path() / "matcher";
  std::ofstream(file) << "#!/bin/sh\n" << text << "\n";
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return file;
}

template <class Error>
std::string said(const std::filesystem::path& program) {
  try {
    static_cast<void>(match_files(program, {"l.png", "r.png", "c.toml"}, {1, 2}));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Matcher, ThatIsNotThereIsToldWithPackagesAndCommand) {
  VERIFIES("LASSO-STE-011~1");
  const std::string text = said<RunError>("/nowhere/mdat-match");
  for (const char* word : {"make stereo", "libopencv-core-dev", "libopencv-imgproc-dev", "libopencv-calib3d-dev"})
    EXPECT_NE(text.find(word), std::string::npos) << text;
}

TEST(Matcher, ItsRefusalsAreTheUsers) {
  VERIFIES("LASSO-STE-007~1");
  const ScratchFolder folder;
  EXPECT_EQ(said<InputError>(script(folder, "echo 'mdat-match: l.png: is no picture' >&2; exit 2")), "l.png: is no picture");
}

TEST(Matcher, ItsFailuresAreTold) {
  VERIFIES("LASSO-STE-011~1");
  const ScratchFolder folder;
  EXPECT_EQ(said<RunError>(script(folder, "echo out of memory; exit 5")), "stereo: mdat-match ended with 5: out of memory");
}

TEST(Matcher, GetsFilesAndDepthsAndNothingElse) {
  VERIFIES("LASSO-STE-004~1");
  const ScratchFolder folder;
  const std::string text = said<InputError>(script(folder, "echo \"$@\" | sed 's| --disparity.*||'; exit 2"));
  EXPECT_EQ(text, "--left l.png --right r.png --calibration c.toml --nearest 1 --farthest 2");
}

TEST(Matcher, ScratchFoldersGoWithTheirOwner) {
  VERIFIES("LASSO-STE-004~1");
  std::filesystem::path path;
  {
    const ScratchFolder folder;
    path = folder.path();
    EXPECT_TRUE(std::filesystem::is_directory(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace lasso::mdat
