// The recordings that a server shows, each by an id: nothing else of the machine can be asked for.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "mdat/serve/recording.hpp"

namespace lasso::mdat::serve {

struct RecordingEntry {
  std::string id, name;  // name: its path below the folder
  std::filesystem::path path;
  std::uint64_t size_bytes = 0;
  double modified_s = 0;  // since 1970
  bool open = false;
  std::string error;  // of the last try to open it
};

constexpr std::size_t kMostRecordings = 1000;  // listed; others of a folder are left out
constexpr std::size_t kMostOpen = 3;           // held open at a time

// Safe for several threads.
class Folder {
 public:
  // `place`: a recording (.mcap), which is then all that is shown, or a folder, with those below it, three folders deep. Links that lead
  // out of it are left out. Throws InputError where there is no such file or folder.
  explicit Folder(const std::filesystem::path& place);

  const std::filesystem::path& path() const { return folder_; }
  bool takes_files() const { return single_.empty(); }  // new ones appear in the list
  // Looks again at what is there. By name.
  std::vector<RecordingEntry> list();
  // Opens it, where it is not open. Throws Refusal: 404 there is no such id, 422 it cannot be read.
  std::shared_ptr<const Recording> recording(const std::string& id);
  // The id of a file of this folder.
  std::string id_of(const std::filesystem::path& file) const;

 private:
  struct Opened {
    std::mutex mutex;
    RecordingEntry entry;  // as it was when it was opened
    std::shared_ptr<const Recording> recording;
  };
  RecordingEntry entry_of(const std::string& id, const Opened& place) const;
  void note(const std::string& id, const std::string& error);
  std::vector<RecordingEntry> find() const;
  std::shared_ptr<Opened> place_of(const std::string& id);

  std::filesystem::path folder_, single_;  // canonical; single_ empty: all of the folder
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Opened>> opened_;
  std::map<std::string, std::string> errors_;
  std::vector<std::string> used_;  // ids that are open, the last used one at the end
};

}  // namespace lasso::mdat::serve
