#include "mdat/serve/folder.hpp"

#include <algorithm>
#include <chrono>
#include <system_error>

#include "mdat/common/errors.hpp"
#include "mdat/serve/http.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat::serve {
namespace {

namespace fs = std::filesystem;

constexpr int kDepth = 3;
constexpr std::size_t kIdDigits = 16;
constexpr std::size_t kMostSeen = 50000;  // entries of folders that are looked at

bool is_below(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

double seconds_of(fs::file_time_type time) {
  const auto system = std::chrono::file_clock::to_sys(time);
  return std::chrono::duration<double>(system.time_since_epoch()).count();
}

// The file at its path, without links: how large, and when it was changed. False: there is none.
bool look_at(RecordingEntry& entry) {
  std::error_code error;
  entry.path = fs::canonical(entry.path, error);
  if (error || !fs::is_regular_file(entry.path, error)) return false;
  entry.size_bytes = fs::file_size(entry.path, error);
  const fs::file_time_type modified = fs::last_write_time(entry.path, error);
  if (!error) entry.modified_s = seconds_of(modified);
  return !error;
}

}  // namespace

Folder::Folder(const fs::path& place) {
  std::error_code error;
  const fs::path whole = fs::canonical(place, error);
  if (error) throw InputError(place.string() + ": no such file or folder: expected a recording (.mcap), or a folder with some");
  if (fs::is_directory(whole)) {
    folder_ = whole;
    return;
  }
  const mcap::Reader readable(whole);  // or says why not
  folder_ = whole.parent_path();
  single_ = whole;
}

std::string Folder::id_of(const fs::path& file) const { return sha256_of(file.lexically_relative(folder_).string()).substr(0, kIdDigits); }

std::vector<RecordingEntry> Folder::find() const {
  std::vector<RecordingEntry> entries;
  const auto add = [&](const fs::path& file) {
    RecordingEntry entry;
    entry.path = file;
    if (entries.size() >= kMostRecordings || !look_at(entry) || !is_below(entry.path, folder_)) return;
    entry.id = id_of(file);
    entry.name = file.lexically_relative(folder_).string();
    entries.push_back(std::move(entry));
  };
  if (!single_.empty()) {
    add(single_);
    return entries;
  }
  std::error_code error;
  std::size_t seen = 0;
  for (fs::recursive_directory_iterator at(folder_, fs::directory_options::skip_permission_denied, error), end;
       !error && at != end && seen < kMostSeen; at.increment(error), ++seen) {
    if (at.depth() >= kDepth) at.disable_recursion_pending();
    if (at->path().extension() == ".mcap") add(at->path());
  }
  std::sort(entries.begin(), entries.end(), [](const RecordingEntry& a, const RecordingEntry& b) { return a.name < b.name; });
  return entries;
}

std::vector<RecordingEntry> Folder::list() {
  std::vector<RecordingEntry> entries = find();
  const std::lock_guard lock(mutex_);
  for (RecordingEntry& entry : entries) {
    entry.open = std::find(used_.begin(), used_.end(), entry.id) != used_.end();
    const auto error = errors_.find(entry.id);
    if (error != errors_.end()) entry.error = error->second;
  }
  return entries;
}

// Of an id that is none of the folder's nothing is kept.
std::shared_ptr<Folder::Opened> Folder::place_of(const std::string& id) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = opened_.find(id);
    if (found != opened_.end()) return found->second;
  }
  (void)entry_of(id, Opened{});
  const std::lock_guard lock(mutex_);
  std::shared_ptr<Opened>& place = opened_[id];
  if (!place) place = std::make_shared<Opened>();
  return place;
}

// The file as it is now. One that was opened is not looked for again.
RecordingEntry Folder::entry_of(const std::string& id, const Opened& place) const {
  if (place.recording) {
    RecordingEntry entry = place.entry;
    if (look_at(entry) && is_below(entry.path, folder_)) return entry;
  }
  for (const RecordingEntry& entry : find()) {
    if (entry.id == id) return entry;
  }
  throw Refusal{404, "there is no recording " + id.substr(0, 40), "choose one of the list"};
}

// That it was asked for: what could not be opened, or, without an error, that it is open. Of those that are too many the one that was not
// used for the longest time is closed; answers that still hold it keep it until they are given.
void Folder::note(const std::string& id, const std::string& error) {
  const std::lock_guard lock(mutex_);
  errors_[id] = error;
  std::erase(used_, id);
  if (error.empty()) used_.push_back(id);
  if (used_.size() <= kMostOpen) return;
  opened_.erase(used_.front());
  used_.erase(used_.begin());
}

std::shared_ptr<const Recording> Folder::recording(const std::string& id) {
  if (id.size() != kIdDigits) throw Refusal{404, "there is no recording " + id.substr(0, 40), "choose one of the list"};
  const std::shared_ptr<Opened> place = place_of(id);
  const std::lock_guard lock(place->mutex);
  const RecordingEntry now = entry_of(id, *place);
  const bool same = place->recording && now.size_bytes == place->entry.size_bytes && now.modified_s == place->entry.modified_s;
  try {
    if (!same) place->recording = std::make_shared<const Recording>(now.path);
    place->entry = now;
  } catch (const InputError& error) {
    place->recording.reset();
    note(id, error.what());
    throw Refusal{422, error.what(), "choose another recording"};
  }
  note(id, "");
  return place->recording;
}

}  // namespace lasso::mdat::serve
