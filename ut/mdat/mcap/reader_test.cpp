#include "mdat/mcap/reader.hpp"

#include <lz4frame.h>

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

// A length that is damaged hides what follows from who trusts it: reading goes on at the next chunk.
TEST_F(McapReader, GoesOnAtTheNextChunkBehindADamagedLength) {
  VERIFIES("LASSO-REC-006~1");
  write_three_chunks();
  const std::string whole = bytes();
  const std::size_t chunk = whole.find('\x06', kMagic.size() + kRecordHead + 4);
  for (const int byte : {1, 2, 5}) {
    std::string damaged = whole;
    damaged[chunk + static_cast<std::size_t>(byte)] = static_cast<char>(damaged[chunk + static_cast<std::size_t>(byte)] + 1);
    put(damaged);
    const Told part = told();
    EXPECT_EQ(part.messages.size(), 8U) << byte;
    ASSERT_FALSE(part.damage.empty());
    EXPECT_EQ(part.damage[0].at, chunk);
    EXPECT_EQ(part.damage[0].before_ns, 4U);
  }
}

// Times that a chunk's head says, and indexes, have no checksum of their own: that of the data shows them.
TEST_F(McapReader, AnyOtherByteOfTheDataIsTold) {
  VERIFIES("LASSO-REC-006~1");
  write_three_chunks();
  const std::string whole = bytes();
  const std::size_t data_end = whole.find("\x0f\x04", whole.find("notes.txt"));
  ASSERT_NE(data_end, std::string::npos);
  for (std::size_t at = kMagic.size() + kRecordHead; at < data_end; ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    put(damaged);
    try {
      EXPECT_FALSE(told().damage.empty()) << at;
    } catch (const InputError&) {
      EXPECT_LT(at, 60U);  // the header
    }
  }
}

// By liblz4's own encoder.
TEST_F(McapReader, TakesChunksOfLz4) {
  VERIFIES("LASSO-REC-010~1");
  std::string records, content(8, '\0');
  put_schema({1, "a/msg/B", "ros2msg", "int32 x"}, records);
  put_channel({0, 1, "/one", "cdr", {}}, records);
  put_message({0, 0, 5, 5, std::string(300, 'm')}, records);
  std::string body(LZ4F_compressFrameBound(records.size(), nullptr), '\0');
  body.resize(LZ4F_compressFrame(body.data(), body.size(), records.data(), records.size(), nullptr));
  std::string chunk, file(kMagic), header;
  mcap::put(std::uint64_t{5}, chunk);
  mcap::put(std::uint64_t{5}, chunk);
  mcap::put(std::uint64_t{records.size()}, chunk);
  mcap::put(crc32_of(records), chunk);
  put_text("lz4", chunk);
  mcap::put(std::uint64_t{body.size()}, chunk);
  put_record(Op::kHeader, content, file);
  put_record(Op::kChunk, chunk + body, file);
  put_record(Op::kDataEnd, std::string(4, '\0'), file);
  put(file);
  const Told all = told();
  ASSERT_EQ(all.messages.size(), 1U);
  EXPECT_EQ(all.messages[0].second, std::string(300, 'm'));
  EXPECT_TRUE(all.damage.empty());
}

std::string error_of(const std::filesystem::path& file) {
  try {
    const Reader reader(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST_F(McapReader, WhatIsNoRecordingIsRefusedByName) {
  VERIFIES("LASSO-REC-008~2");
  EXPECT_NE(error_of(file_).find(file_.string() + ": cannot be read"), std::string::npos);
  put("scan,qx,qy\n1,2,3\n");
  EXPECT_NE(error_of(file_).find("is no MCAP file"), std::string::npos);
  put("\x89MCAP1\r\n");
  EXPECT_NE(error_of(file_).find("of another version"), std::string::npos);
  put(kMagic);
  EXPECT_NE(error_of(file_).find("without a header"), std::string::npos);
}

// Others' files need not say one: their messages are looked at when they are read.
TEST_F(McapReader, AnotherProfileIsRefusedByItsName) {
  VERIFIES("LASSO-REC-008~2");
  const auto put_profile = [&](const std::string& profile) {
    std::string header, file(kMagic);
    put_text(profile, header);
    put_text("another program", header);
    put_record(Op::kHeader, header, file);
    put(file);
  };
  for (const char* profile : {"", "ros2"}) {
    put_profile(profile);
    EXPECT_EQ(error_of(file_), "none") << profile;
  }
  put_profile("ros1");
  EXPECT_EQ(error_of(file_),
            file_.string() + ": is an MCAP file of profile 'ros1': expected 'ros2', or none; rosbags-convert makes one of it");
  put_profile("x-\n\xff" + std::string(40, 'y'));
  EXPECT_EQ(error_of(file_), file_.string() + ": is an MCAP file of profile 'x-??" + std::string(16, 'y') + "': expected 'ros2', or none");
}

}  // namespace
}  // namespace lasso::mdat::mcap
