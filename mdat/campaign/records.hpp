// All finished cases of a campaign's folder, whichever runners have flown them in whatever chunks and order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mdat/campaign/chunk.hpp"
#include "mdat/campaign/record.hpp"

namespace lasso::mdat {

class Records {
 public:
  // Reads the chunk files of the folder, which stay in memory (some 300 bytes a case). With `of`, only those that can have cases of this
  // chunk: a campaign of a thousand chunks is not read a thousand times. Throws InputError, which names file and line: another plan, a case
  // that the plan does not have, a case with two results.
  Records(const std::filesystem::path& folder, const std::string& plan_digest, std::uint32_t cases, std::optional<Chunk> of = std::nullopt);

  // The fields of a case; nothing if it is missing.
  std::optional<std::string_view> of(std::uint32_t number) const;
  std::uint32_t cases() const { return static_cast<std::uint32_t>(places_.size()); }
  std::uint32_t done() const { return done_; }      // with the failed ones
  std::uint32_t failed() const { return failed_; }  // their records say so
  std::uint32_t missing() const { return cases() - done_; }
  // Lines that are no records: "FILE:LINE" each; and the files.
  const std::vector<std::string>& damaged() const { return damaged_; }
  const std::vector<std::filesystem::path>& damaged_files() const { return damaged_files_; }

 private:
  struct Place {
    std::string_view fields;
    std::uint32_t file = 0, line = 0;  // line 0: missing
  };
  void read(const std::filesystem::path& file, const std::string& plan_digest);
  void add(const CaseRecord& record);
  [[noreturn]] void refuse_two(const Place& place, const CaseRecord& record) const;
  std::vector<std::filesystem::path> files_;
  std::deque<std::string> texts_;
  std::vector<Place> places_;
  std::uint32_t done_ = 0, failed_ = 0;
  std::vector<std::string> damaged_;
  std::vector<std::filesystem::path> damaged_files_;
};

// What `mdat campaign status` says: counts, runners that are at work, damaged records, and what to do next.
std::string status_text(const std::filesystem::path& folder, const Records& records);

// Takes the records of failed cases out, into NAME.failed beside each chunk file: they are flown again. Returns how many. Throws InputError
// where a runner has one of the files.
std::size_t retry_failed(const std::filesystem::path& folder, const std::string& plan_digest);

}  // namespace lasso::mdat
