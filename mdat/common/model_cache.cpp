#include "mdat/common/model_cache.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <type_traits>
#include <vector>

#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

constexpr char kEnding[] = ".3dlm";  // nothing else in the folder is counted, or removed
constexpr std::size_t kDigestCharacters = 64;

template <class Value>
void append(const Value& value, std::string& bytes) {
  static_assert(std::is_trivially_copyable_v<Value>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Value>
void append_list(const std::vector<Value>& list, std::string& bytes) {
  append(std::uint64_t{list.size()}, bytes);
  bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(Value));
}

// The names of all options: with another one this no longer compiles, and none is forgotten.
void append_options(const ModelOptions& options, std::string& bytes) {
  const auto& [cell_size_m, crease_angle_deg, weld_tolerance_m, far_margin, near_band_m, oriented] = options;
  for (const double value : {cell_size_m, crease_angle_deg, weld_tolerance_m, far_margin, near_band_m}) append(value, bytes);
  append(oriented, bytes);
}

// An entry is a digest of all that follows it: its key, the report, and the words of each table, as they lie in memory.
std::string entry_of(const std::string& key, const ModelTables& tables, const CompileReport& report) {
  std::string bytes = key;
  append(report, bytes);
  for (const auto& words : tables.words) append_list(words, bytes);
  return sha256_of(bytes) + bytes;
}

// Takes from the front of an entry; `whole` tells whether everything was there.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  std::string_view take_bytes(std::uint64_t size) {
    whole_ = whole_ && size <= rest_.size();
    const std::string_view taken = rest_.substr(0, whole_ ? size : 0);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  template <class Value>
  void take(Value& value) {
    const std::string_view bytes = take_bytes(sizeof value);
    if (whole_) std::memcpy(&value, bytes.data(), bytes.size());
  }
  void take(std::vector<std::uint32_t>& words) {
    std::uint64_t count = 0;
    take(count);
    const std::string_view bytes = take_bytes(count <= rest_.size() ? count * sizeof(std::uint32_t) : rest_.size() + 1);
    words.resize(bytes.size() / sizeof(std::uint32_t));
    if (!bytes.empty()) std::memcpy(words.data(), bytes.data(), bytes.size());
  }
  bool ended() const { return whole_ && rest_.empty(); }

 private:
  std::string_view rest_;
  bool whole_ = true;
};

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// Empty, or why not. A name of its own for each writer; readers see the file under its last name, whole.
std::string write_whole(const fs::path& file, const std::string& bytes) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  std::string partial = file.string() + ".XXXXXX";
  const int descriptor = ::mkstemp(partial.data());
  if (descriptor < 0) return std::strerror(errno);
  std::size_t written = 0;
  for (ssize_t some = 1; some > 0 && written < bytes.size();) {
    some = ::write(descriptor, bytes.data() + written, bytes.size() - written);
    if (some > 0) written += static_cast<std::size_t>(some);
  }
  const int cause = errno;
  (void)::close(descriptor);
  if (written == bytes.size()) fs::rename(partial, file, error);
  if (written == bytes.size() && !error) return {};
  (void)::unlink(partial.c_str());
  return error ? error.message() : std::strerror(cause);
}

// The name of an entry, digits of SHA-256 and the ending, or of a part of one, to which mkstemp has appended a dot and six letters.
bool is_entry(const std::string& name) {
  const std::size_t digits = name.find_first_not_of("0123456789abcdef");
  if (digits == 0 || digits == std::string::npos || name.compare(digits, sizeof kEnding - 1, kEnding) != 0) return false;
  const std::string rest = name.substr(digits + sizeof kEnding - 1);
  return rest.empty() || (rest.size() == sizeof ".XXXXXX" - 1 && rest[0] == '.');
}

struct Entry {
  fs::file_time_type used;
  std::uint64_t bytes = 0;
  fs::path file;
};

// Entries, and parts of one that a process left behind. What another process removes meanwhile is left out.
std::vector<Entry> entries_of(const fs::path& folder) {
  std::vector<Entry> entries;
  std::error_code over;
  for (fs::directory_iterator file(folder, over), end; !over && file != end; file.increment(over)) {
    if (!is_entry(file->path().filename().string())) continue;
    std::error_code gone;
    const fs::file_time_type used = file->last_write_time(gone);
    const std::uint64_t bytes = gone ? 0 : file->file_size(gone);
    if (!gone) entries.push_back({used, bytes, file->path()});
  }
  return entries;
}

fs::path variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? fs::path() : fs::path(value);
}

}  // namespace

std::string model_key(const std::string& compiler, const Mesh& mesh, const ModelOptions& options) {
  std::string bytes = compiler + '\n';
  append_options(options, bytes);
  append(std::uint64_t{mesh.vertices.size()}, bytes);
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    for (const double coordinate : vertex) append(coordinate, bytes);
  }
  append_list(mesh.triangles, bytes);
  return sha256_of(bytes);
}

ModelCache ModelCache::of_user() {
  if (const fs::path folder = variable("MDAT_CACHE"); !folder.empty()) return ModelCache(ModelCacheOptions{folder});
  if (const fs::path caches = variable("XDG_CACHE_HOME"); caches.is_absolute()) return ModelCache(ModelCacheOptions{caches / "3dlasso"});
  if (const fs::path home = variable("HOME"); home.is_absolute()) return ModelCache(ModelCacheOptions{home / ".cache/3dlasso"});
  return none();
}

fs::path ModelCache::file_of(const std::string& key) const { return options_.folder / (key + kEnding); }

ModelTables ModelCache::compile(const Mesh& mesh, const ModelOptions& options, CompileReport& report) {
  const std::string key = options_.folder.empty() ? "" : model_key(options_.compiler, mesh, options);
  ModelTables tables;
  if (!key.empty() && find(key, tables, report)) {
    ++found_;
    return tables;
  }
  tables = compile_model(mesh, options, report);
  if (!key.empty()) keep(key, tables, report);
  return tables;
}

bool ModelCache::find(const std::string& key, ModelTables& tables, CompileReport& report) const {
  const std::string entry = content_of(file_of(key));
  Reader reader(entry);
  const std::string_view digest = reader.take_bytes(kDigestCharacters);
  if (digest.empty() || digest != sha256_of(std::string_view(entry).substr(kDigestCharacters)) || reader.take_bytes(key.size()) != key)
    return false;
  ModelTables read;
  reader.take(report);
  for (auto& words : read.words) reader.take(words);
  if (!reader.ended()) return false;
  tables = std::move(read);
  std::error_code ignored;  // an entry that cannot be marked as used is used nevertheless
  fs::last_write_time(file_of(key), fs::file_time_type::clock::now(), ignored);
  return true;
}

void ModelCache::keep(const std::string& key, const ModelTables& tables, const CompileReport& report) {
  const std::string why = write_whole(file_of(key), entry_of(key, tables, report));
  if (why.empty()) return remove_oldest();
  warning_ = "the compiled model is not kept: " + options_.folder.string() + ": cannot be written: " + why +
             " (--no-cache does without, MDAT_CACHE names another folder)";
}

void ModelCache::remove_oldest() const {
  std::vector<Entry> entries = entries_of(options_.folder);
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  std::uint64_t sum = 0;
  for (const Entry& entry : entries) sum += entry.bytes;
  std::error_code ignored;
  for (auto entry = entries.begin(); entry != entries.end() && sum > options_.bytes_max; ++entry) {
    sum -= entry->bytes;
    fs::remove(entry->file, ignored);
  }
}

}  // namespace lasso::mdat
