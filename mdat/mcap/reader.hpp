// Reads an MCAP file from its begin to its end, as a stream: no index is needed, so that files whose end is missing, or damaged, are read
// as far as they are whole. Behind a record that is damaged reading goes on at the next chunk whose head agrees with its own lengths.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mdat/mcap/format.hpp"

namespace lasso::mdat::mcap {

// What could not be read: the byte of the file where it begins, why, and the latest time of messages before it, the first one's behind it.
struct Damage {
  std::uint64_t at = 0;
  std::string why;
  std::uint64_t after_ns = 0, before_ns = 0;  // 0: there is none
};

// Gets what a file holds, in the order of the file. Views are valid during the call.
struct Visitor {
  std::function<void(const Channel&, const Message&)> message = [](const Channel&, const Message&) {};
  std::function<void(const Attachment&)> attachment = [](const Attachment&) {};
  std::function<void(const std::string& name, const Text&)> metadata = [](const std::string&, const Text&) {};
};

class Reader {
 public:
  // Reads the header. Throws InputError: the file cannot be read, is no MCAP file, or is of another version or profile.
  explicit Reader(const std::filesystem::path& file);

  const std::string& profile() const { return profile_; }  // ros2, or empty
  const std::string& library() const { return library_; }
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }  // that have been met
  const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }

  // Everything from the header on, once. A chunk, an attachment or a record of metadata is told whole or not at all: what has another
  // checksum than it says, or cannot be unpacked, is damage, and left out. So is what lies between a record that is none, or reaches beyond
  // the file, and the next chunk; and that fewer messages were read than the file's summary counts, or its data has another checksum.
  std::vector<Damage> read(const Visitor& visitor);

  const std::vector<Damage>& damage() const { return damage_; }  // so far

  // The place of the record from which the message comes that a visitor gets: of its chunk.
  std::uint64_t record_at() const { return record_at_; }
  // Of a record that was read, the data of its nth message. Throws InputError: it cannot be read again.
  std::string message_at(std::uint64_t record_at, std::size_t nth);

 private:
  bool next(Op& op, std::string& content);
  bool is_sound(Op op, std::string_view content) const;
  bool find_chunk();
  bool read_record(const Visitor& visitor);
  void end_data(std::string_view content);
  void take(Op op, std::string_view content, const Visitor& visitor);
  void take_inner(Op op, std::string_view content, const Visitor& visitor);
  void take_chunk(std::string_view content, const Visitor& visitor);
  void take_records(std::string_view records, const Visitor& visitor);
  void take_attachment(std::string_view content, const Visitor& visitor);
  void take_metadata(std::string_view content, const Visitor& visitor);
  void take_message(std::string_view content, const Visitor& visitor);
  void count_again();
  void note(const std::string& why) { damage_.push_back({record_at_, why, last_ns_, 0}); }

  std::filesystem::path path_;
  std::ifstream in_;
  std::uint64_t size_ = 0, at_ = 0, record_at_ = 0;
  std::uint64_t messages_ = 0;              // read
  std::uint64_t last_ns_ = 0;               // the latest of them
  std::uint32_t crc_ = 0, record_crc_ = 0;  // of all bytes so far, and of those before the record
  std::uint64_t search_from_ = 0;           // for the next chunk, where a record is none
  bool chunks_ = false;                     // one was met
  bool ended_ = false;                      // the data's end was met
  std::string profile_, library_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<Damage> damage_;
};

}  // namespace lasso::mdat::mcap
