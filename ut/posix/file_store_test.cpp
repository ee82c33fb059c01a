#include "bsp/posix/file_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "fsw/mission/stored_record.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::posix {
namespace {

class FileStoreTest : public ::testing::Test {
 protected:
  FileStoreTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("lasso_store_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::remove_all(folder_);
  }
  ~FileStoreTest() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(FileStoreTest, KeepsWhatWasWrittenOverARestart) {
  VERIFIES("LASSO-IMG-015~1");
  const std::uint8_t data[] = {1, 2, 3, 4, 5};
  {
    FileStore store(folder_.string(), 1000);
    ASSERT_TRUE(store.opened());
    for (std::size_t i = 0; i < kStoreAreas; ++i) {
      ASSERT_EQ(store.write(static_cast<StoreArea>(i), 100 + i, ConstBytes(data)), Status::kOk);
    }
    EXPECT_EQ(store.size(StoreArea::kImage1), 1000 + kStoredHeaderBytes);
  }
  FileStore store(folder_.string(), 1000);
  for (std::size_t i = 0; i < kStoreAreas; ++i) {
    std::uint8_t read[5] = {};
    ASSERT_EQ(store.read(static_cast<StoreArea>(i), 100 + i, Bytes(read)), Status::kOk);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(read[k], data[k]);
  }
}

// Pieces are written faster than a disk takes them: a look in between, which begins before or within a piece, shows the newest of each
// byte.
TEST_F(FileStoreTest, ShowsWhatIsStillOnItsWayToTheDisk) {
  VERIFIES("LASSO-IMG-015~1");
  FileStore store(folder_.string(), 1000);
  std::array<std::uint8_t, 300> model{}, shown{};
  for (std::size_t i = 0; i < 40; ++i) {
    const std::size_t at = 37 * i % 260, bytes = 1 + 11 * i % 40;
    for (std::size_t k = at; k < at + bytes; ++k) model[k] = static_cast<std::uint8_t>(5 * i + k + 1);
    ASSERT_EQ(store.write(StoreArea::kImage0, at, ConstBytes(&model[at], bytes)), Status::kOk);
    const std::size_t from = 53 * i % 280;
    ASSERT_EQ(store.read(StoreArea::kImage0, from, Bytes(&shown[from], model.size() - from)), Status::kOk);
    EXPECT_TRUE(
        std::equal(shown.begin() + static_cast<std::ptrdiff_t>(from), shown.end(), model.begin() + static_cast<std::ptrdiff_t>(from)))
        << i;
  }
}

TEST_F(FileStoreTest, TouchesNothingOutsideAnArea) {
  VERIFIES("LASSO-IMG-015~1");
  FileStore store(folder_.string(), 1000);
  std::uint8_t bytes[64] = {};
  for (const std::size_t offset : {std::size_t{1000}, std::size_t{5000}, ~std::size_t{0}}) {
    EXPECT_EQ(store.write(StoreArea::kImage0, offset, ConstBytes(bytes)), Status::kBadIndex);
    EXPECT_EQ(store.read(StoreArea::kImage0, offset, Bytes(bytes)), Status::kBadIndex);
  }
  EXPECT_EQ(std::filesystem::file_size(folder_ / "image0"), 1000 + kStoredHeaderBytes);
}

TEST_F(FileStoreTest, SaysWhatCannotBeOpenedOrRead) {
  VERIFIES("LASSO-IMG-015~1");
  std::ofstream(folder_) << "no folder";
  FileStore none(folder_.string(), 1000);
  EXPECT_FALSE(none.opened());
  std::uint8_t bytes[8] = {};
  EXPECT_EQ(none.read(StoreArea::kImage0, 0, Bytes(bytes)), Status::kNoData);
  EXPECT_EQ(none.write(StoreArea::kImage0, 0, ConstBytes(bytes)), Status::kNoData);
  std::filesystem::remove(folder_);
  FileStore store(folder_.string(), 1000);
  std::filesystem::resize_file(folder_ / "image0", 10);
  EXPECT_EQ(store.read(StoreArea::kImage0, 0, Bytes(bytes)), Status::kOk);
  EXPECT_EQ(store.read(StoreArea::kImage0, 8, Bytes(bytes)), Status::kNoData);
}

}  // namespace
}  // namespace lasso::posix
