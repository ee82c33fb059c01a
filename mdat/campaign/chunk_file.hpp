// The file that a runner writes its finished cases into: FOLDER/chunks/NAME.part, and NAME.done when nothing is left to fly. Whatever kills
// the runner or its machine, the whole lines stay; a second runner is kept out by a lock on the file (flock).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "mdat/campaign/record.hpp"

namespace lasso::mdat {

class ChunkFile {
 public:
  // Opens the file, or makes it (and its folder), and locks it. A torn last line is dropped; damaged lines are set aside, as repair_chunk()
  // does. Throws InputError (another process has it, another plan, not writable).
  ChunkFile(const std::filesystem::path& folder, const std::string& name, const std::string& plan_digest);
  // Gives the lock back. In a forked child, too: the parent then keeps it.
  ~ChunkFile();
  ChunkFile(const ChunkFile&) = delete;
  ChunkFile& operator=(const ChunkFile&) = delete;

  // One write() a record; on the disk itself at the latest with the first record after ten seconds. Throws RunError where it cannot be
  // written (a full disk); the file then ends with the record before.
  void append(std::uint32_t number, std::string_view fields);
  // On the disk, and renamed to NAME.done (NAME-2.done where that is there). A file without a record goes. Throws RunError (also
  // where another process has replaced the file).
  void complete();
  // Cases whose records were damaged are flown again: a line for a person each.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void require_own() const;
  void sync();
  [[noreturn]] void fail(int error) const;
  std::filesystem::path path_;
  int file_ = -1;
  std::size_t size_ = 0, records_ = 0;
  std::chrono::steady_clock::time_point synced_;
  std::vector<std::string> notes_;
};

// The .part and .done files of the folder, in the order of their names. None is not an error.
std::vector<std::filesystem::path> chunk_files(const std::filesystem::path& folder);

// A runner holds the lock of this .part file.
bool in_flight(const std::filesystem::path& file);

// Takes lines out of a chunk file, and appends them to the file of the same name that ends with `ending`: first there, then a new file
// replaces the old one at once. Lines that are no records go as well, into NAME.damaged. Says which. Throws InputError where a runner has
// the file, RunError where the disk fails.
struct TakenOut {
  std::size_t records = 0;
  std::vector<std::string> damaged;  // a line for a person each
};
TakenOut repair_chunk(const std::filesystem::path& file, const std::string& plan_digest,
                      const std::function<bool(const CaseRecord&)>& take_out, const std::string& ending);

}  // namespace lasso::mdat
