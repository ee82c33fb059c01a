#include "mdat/source/sha256.hpp"

#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(Sha256, MatchesThePublishedVectors) {
  VERIFIES("LASSO-GND-004~1");
  EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, ReadsBytesAsTheyAre) {
  VERIFIES("LASSO-GND-004~1");
  const Folder folder;
  const std::string bytes("a\r\n\0b\xff", 6);
  EXPECT_EQ(read_file(folder.write("f", bytes)), bytes);
  EXPECT_THROW(static_cast<void>(read_file(folder.path() / "none")), std::runtime_error);
  EXPECT_THROW(static_cast<void>(read_file(folder.path())), std::runtime_error);
}

}  // namespace
}  // namespace lasso::mdat
