#include "mdat/mcap/reader.hpp"

#include <algorithm>

#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"
#include "ut/mdat/mcap/mcap_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::mcap {
namespace {

using McapReader = McapFile;

TEST_F(McapReader, TellsWhatWasWritten) {
  VERIFIES("LASSO-REC-001~1");
  write_three_chunks();
  const Told all = told();
  ASSERT_EQ(all.messages.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(all.messages[i].first, i % 2 == 0 ? "/one" : "/two");
    EXPECT_EQ(all.messages[i].second, std::string(40, static_cast<char>('a' + i)));
  }
  EXPECT_EQ(all.attachments, std::vector<std::string>{"notes.txt"});
  EXPECT_TRUE(all.damage.empty());
}

// Of the whole file's messages the first ones, chunk by chunk.
bool is_begin_of(const Told& part, const Told& whole) {
  return part.messages.size() % 4 == 0 && part.messages.size() <= whole.messages.size() &&
         std::equal(part.messages.begin(), part.messages.end(), whole.messages.begin());
}

TEST_F(McapReader, ACutFileIsReadUpToItsLastWholeChunk) {
  VERIFIES("LASSO-REC-006~1");
  write_three_chunks();
  const std::string whole = bytes();
  const Told all = told();
  std::size_t before = 0;
  for (std::size_t size = 60; size < whole.size(); size += 5) {
    put(std::string_view(whole).substr(0, size));
    const Told part = told();
    EXPECT_TRUE(is_begin_of(part, all)) << size;
    EXPECT_GE(part.messages.size(), before) << size;
    EXPECT_EQ(part.damage.empty(), part.attachments.size() == 1 && size >= whole.find("\x0f\x04", 60) + 13) << size;
    before = part.messages.size();
  }
}

// A byte in a chunk costs this chunk. One in a record's head can cost all behind it. No message is ever another.
TEST_F(McapReader, ADamagedByteCostsWhatItDamagesAndIsTold) {
  VERIFIES("LASSO-REC-006~1");
  write_three_chunks();
  const std::string whole = bytes();
  const Told all = told();
  const std::size_t data_end = whole.find("notes.txt");
  sim::Random random(5);
  for (int trial = 0; trial < 150; ++trial) {
    std::string damaged = whole;
    const auto at = kMagic.size() + static_cast<std::size_t>(random.uniform(0, static_cast<double>(data_end - kMagic.size())));
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (random.bits() % 8)));
    put(damaged);
    try {
      const Told part = told();
      for (const auto& message : part.messages)
        EXPECT_NE(std::find(all.messages.begin(), all.messages.end(), message), all.messages.end()) << at;
      EXPECT_TRUE(part.messages.size() == all.messages.size() || !part.damage.empty()) << at;
    } catch (const InputError& error) {
      EXPECT_LT(at, 60U) << error.what();  // the header
    }
  }
}

TEST_F(McapReader, WhatIsNoRecordingIsRefusedByName) {
  VERIFIES("LASSO-REC-008~1");
  const auto error_of = [&] {
    try {
      Reader reader(file_);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_NE(error_of().find(file_.string() + ": cannot be read"), std::string::npos);
  put("scan,qx,qy\n1,2,3\n");
  EXPECT_NE(error_of().find("is no MCAP file"), std::string::npos);
  put("\x89MCAP1\r\n");
  EXPECT_NE(error_of().find("of another version"), std::string::npos);
  put(kMagic);
  EXPECT_NE(error_of().find("without a header"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat::mcap
