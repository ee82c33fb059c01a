#include "mdat/campaign/chunk_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kSyncEvery = 10s;
constexpr int kLockTries = 10;  // a runner that was killed a moment ago gives its lock back within half a second
constexpr auto kLockPause = 50ms;

[[noreturn]] void refuse_chunk(const fs::path& file, int error) {
  throw InputError(file.string() + ": cannot be opened for writing: " + std::strerror(error) + "; check the folder and your rights to it");
}

[[noreturn]] void fail_write(const fs::path& file, int error) {
  throw RunError(file.string() + ": cannot be written: " + std::strerror(error) +
                 "; the finished cases stay: make room, and the same command goes on");
}

// Where the file system has no locks, a second runner is not noticed: then cases are flown twice, and nothing is lost.
bool has_no_locks(int error) { return error == ENOLCK || error == ENOSYS || error == EOPNOTSUPP; }

bool lock_now(int file) {
  while (flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (has_no_locks(errno)) return true;
    if (errno != EINTR) return false;
  }
  return true;
}

// A runner may have completed or replaced the file between our open and our lock.
bool is_still(int file, const fs::path& path) {
  struct stat ours {
  }, theirs{};
  return fstat(file, &ours) == 0 && stat(path.c_str(), &theirs) == 0 && ours.st_ino == theirs.st_ino && ours.st_dev == theirs.st_dev;
}

// The file, open and locked; -1 where another process has it. Throws InputError where it cannot be opened.
int try_open_locked(const fs::path& path, int flags) {
  const int file = open(path.c_str(), flags | O_RDWR | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) refuse_chunk(path, errno);
  if (lock_now(file) && is_still(file, path)) return file;
  close(file);
  return -1;
}

int open_locked(const fs::path& path, int flags) {
  for (int i = 0; i < kLockTries; ++i, std::this_thread::sleep_for(kLockPause))
    if (const int file = try_open_locked(path, flags); file >= 0) return file;
  throw InputError(path.string() + ": another process flies this chunk: wait for it or stop it");
}

// All of it, or the error's number.
int write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

void write_synced(int file, const fs::path& path, std::string_view text) {
  if (const int error = write_all(file, text); error != 0) fail_write(path, error);
  if (fsync(file) != 0) fail_write(path, errno);
}

// The names in a folder are on the disk as well. Not all file systems can: then they do it by themselves.
void sync_folder(const fs::path& folder) {
  const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  (void)fsync(file);
  close(file);
}

void append_aside(const fs::path& path, const std::string& text) {
  if (text.empty()) return;
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) refuse_chunk(path, errno);
  try {
    write_synced(file, path, text);
  } catch (...) {
    close(file);
    throw;
  }
  close(file);
}

// `file`, which is open and locked, becomes one of this content, which is locked before it has the name.
void replace_locked(int& file, const fs::path& path, const std::string& content) {
  const fs::path partial = path.string() + ".partial";
  const int fresh = open(partial.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (fresh < 0) refuse_chunk(partial, errno);
  (void)lock_now(fresh);
  try {
    write_synced(fresh, partial, content);
    if (rename(partial.c_str(), path.c_str()) != 0) fail_write(path, errno);
  } catch (...) {
    close(fresh);
    (void)unlink(partial.c_str());
    throw;
  }
  sync_folder(path.parent_path());
  close(file);
  file = fresh;
}

std::string note_of(const fs::path& path, std::size_t line) {
  return path.string() + ":" + std::to_string(line) + ": a damaged record, set aside in " + path.stem().string() +
         ".damaged; its case is flown again";
}

// The lines of a chunk file, as they stay and as they go.
struct Sorted {
  std::string kept, taken, damaged;
  TakenOut counts;
};

Sorted sort_lines(const fs::path& path, const ChunkText& chunk, const std::string& plan_digest,
                  const std::function<bool(const CaseRecord&)>& take_out) {
  Sorted sorted;
  sorted.kept = chunk_heading(plan_digest);
  for (const CaseRecord& record : chunk.records) {
    const bool goes = take_out(record);
    sorted.counts.records += goes ? 1 : 0;
    (goes ? sorted.taken : sorted.kept) += record_line(record.number, record.fields);
  }
  for (const ChunkText::Line& line : chunk.damaged) {
    sorted.damaged += std::string(line.text) + "\n";
    sorted.counts.damaged.push_back(note_of(path, line.number));
  }
  return sorted;
}

TakenOut repair_locked(int& file, const fs::path& path, const ChunkText& chunk, const std::string& plan_digest,
                       const std::function<bool(const CaseRecord&)>& take_out, const std::string& ending) {
  const Sorted sorted = sort_lines(path, chunk, plan_digest, take_out);
  if (sorted.taken.empty() && sorted.damaged.empty()) return sorted.counts;
  append_aside(fs::path(path).replace_extension(ending), sorted.taken);
  append_aside(fs::path(path).replace_extension(".damaged"), sorted.damaged);
  replace_locked(file, path, sorted.kept);
  return sorted.counts;
}

bool takes_none(const CaseRecord&) { return false; }

void make_chunks_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) refuse_chunk(folder, error ? error.value() : ENOTDIR);
}

std::size_t size_of(int file) {
  struct stat about {};
  return fstat(file, &about) == 0 ? static_cast<std::size_t>(about.st_size) : 0;
}

}  // namespace

ChunkFile::ChunkFile(const fs::path& folder, const std::string& name, const std::string& plan_digest)
    : path_(folder / "chunks" / (name + ".part")), synced_(std::chrono::steady_clock::now()) {
  make_chunks_folder(path_.parent_path());
  file_ = open_locked(path_, O_CREAT);
  try {
    const std::string text = file_content(path_);
    const ChunkText chunk = parse_chunk(path_.string(), text, plan_digest);
    records_ = chunk.records.size();
    if (!chunk.torn.empty() && ftruncate(file_, static_cast<off_t>(text.size() - chunk.torn.size())) != 0) fail(errno);
    notes_ = repair_locked(file_, path_, chunk, plan_digest, takes_none, ".damaged").damaged;
    size_ = size_of(file_);
    if (size_ != 0) return;
    if (const int error = write_all(file_, chunk_heading(plan_digest)); error != 0) fail(error);
    size_ = size_of(file_);
  } catch (...) {
    close(file_);
    throw;
  }
}

ChunkFile::~ChunkFile() {
  if (file_ >= 0) close(file_);
}

void ChunkFile::fail(int error) const { fail_write(path_, error); }

void ChunkFile::append(std::uint32_t number, std::string_view fields) {
  const std::string line = record_line(number, fields);
  if (const int error = write_all(file_, line); error != 0) {
    (void)!ftruncate(file_, static_cast<off_t>(size_));  // what cannot be taken back is dropped as a torn line later
    fail(error);
  }
  size_ += line.size();
  ++records_;
  if (std::chrono::steady_clock::now() - synced_ > kSyncEvery) sync();
}

// A file system without locks lets another process replace or remove the file under this one.
void ChunkFile::require_own() const {
  if (!is_still(file_, path_))
    throw RunError(path_.string() + ": another process has replaced it, without the last cases; start the same command again");
}

void ChunkFile::sync() {
  if (fdatasync(file_) != 0) fail(errno);
  require_own();
  sync_folder(path_.parent_path());
  synced_ = std::chrono::steady_clock::now();
}

void ChunkFile::complete() {
  require_own();
  if (records_ == 0) {
    if (unlink(path_.c_str()) != 0) fail(errno);
    return;
  }
  sync();
  const std::string base = (path_.parent_path() / path_.stem()).string();
  std::string done = base + ".done";
  for (int i = 2; fs::exists(done); ++i) done = base + "-" + std::to_string(i) + ".done";
  if (rename(path_.c_str(), done.c_str()) != 0) fail(errno);
}

std::vector<fs::path> chunk_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "chunks", error))
    if (entry.path().extension() == ".part" || entry.path().extension() == ".done") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

bool in_flight(const fs::path& path) {
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return false;
  const bool free = lock_now(file);
  close(file);
  return !free;
}

TakenOut repair_chunk(const fs::path& path, const std::string& plan_digest, const std::function<bool(const CaseRecord&)>& take_out,
                      const std::string& ending) {
  int file = open_locked(path, 0);
  try {
    const std::string text = file_content(path);
    const TakenOut taken = repair_locked(file, path, parse_chunk(path.string(), text, plan_digest), plan_digest, take_out, ending);
    close(file);
    return taken;
  } catch (...) {
    close(file);
    throw;
  }
}

}  // namespace lasso::mdat
