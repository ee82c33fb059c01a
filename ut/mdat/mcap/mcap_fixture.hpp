// Files in a folder of their own, and what a reader tells of one.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "mdat/mcap/reader.hpp"
#include "mdat/mcap/writer.hpp"

namespace lasso::mdat::mcap {

struct Told {
  std::vector<std::pair<std::string, std::string>> messages;  // topic and data, in the order of the file
  std::vector<std::string> attachments;
  std::vector<Damage> damage;
};

class McapFile : public ::testing::Test {
 protected:
  McapFile() {
    const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
    file_ = std::filesystem::temp_directory_path() / (std::string("ut-") + test->name() + "-" + std::to_string(::getpid()) + ".mcap");
  }
  ~McapFile() override { std::filesystem::remove(file_); }

  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  // Where nothing is: replacing a file may wait for the disk.
  void put(std::string_view bytes) const {
    std::filesystem::remove(file_);
    std::ofstream(file_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

  Told told() const {
    Told told;
    Reader reader(file_);
    Visitor visitor;
    visitor.message = [&](const Channel& channel, const Message& message) { told.messages.emplace_back(channel.topic, message.data); };
    visitor.attachment = [&](const Attachment& attachment) { told.attachments.push_back(attachment.name); };
    told.damage = reader.read(visitor);
    return told;
  }

  // Three chunks of some messages on two topics, and an attachment behind them.
  void write_three_chunks() const {
    Writer writer(file_, "ros2", "test");
    const std::uint16_t schema = writer.add_schema("a/msg/B", "ros2msg", "int32 x");
    const std::uint16_t one = writer.add_channel("/one", schema, "cdr"), two = writer.add_channel("/two", schema, "cdr");
    for (int chunk = 0; chunk < 3; ++chunk) {
      for (int i = 0; i < 4; ++i)
        writer.write(i % 2 == 0 ? one : two, static_cast<std::uint64_t>(chunk * 4 + i),
                     std::string(40, static_cast<char>('a' + chunk * 4 + i)));
      if (chunk < 2) writer.add_metadata("chunk", {{"number", std::to_string(chunk)}});  // ends the chunk
    }
    writer.attach("notes.txt", "text/plain", "some notes", 7);
    writer.close();
  }

  std::filesystem::path file_;
};

}  // namespace lasso::mdat::mcap
