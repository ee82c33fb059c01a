#include "mdat/common/output.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <system_error>

#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

fs::path partial(const fs::path& file) {
  fs::path result = file;
  result += ".partial";
  return result;
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why) { throw InputError(path.string() + ": cannot be written: " + why); }

void write_partial(const fs::path& file, std::string_view content) {
  errno = 0;
  std::ofstream out(partial(file), std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (out) return;
  const std::string why = errno != 0 ? std::strerror(errno) : "check its folder, its space and your rights to it";
  std::error_code ignored;
  fs::remove(partial(file), ignored);
  refuse(file, why);
}

void rename_partial(const fs::path& file) {
  std::error_code error;
  fs::rename(partial(file), file, error);
  if (!error) return;
  std::error_code ignored;
  fs::remove(partial(file), ignored);
  refuse(file, error.message());
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder) : folder_(folder.empty() ? fs::path(".") : folder) {
  try {
    make_folders();
    check_writable(folder_ / "write-test");
  } catch (...) {
    remove_made_folders();
    throw;
  }
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  for (const std::string& name : names_) fs::remove(partial(folder_ / name), ignored);
  remove_made_folders();
}

void OutputFolder::make_folders() {
  fs::path path;
  for (const fs::path& part : folder_) {
    path /= part;
    std::error_code error;
    if (fs::is_directory(path, error)) continue;
    if (fs::exists(path, error)) refuse(folder_, path.string() + " is not a folder");
    if (!fs::create_directory(path, error) && error) refuse(folder_, error.message());
    made_.push_back(path);
  }
}

void OutputFolder::remove_made_folders() {
  std::error_code ignored;
  for (; !made_.empty(); made_.pop_back()) fs::remove(made_.back(), ignored);  // only if empty
}

void OutputFolder::write(const std::string& name, std::string_view content) {
  names_.push_back(name);
  write_partial(folder_ / name, content);
}

void OutputFolder::commit() {
  for (const std::string& name : names_) rename_partial(folder_ / name);
  names_.clear();
  made_.clear();
}

void OutputFolder::remove(const std::string& name) {
  std::error_code ignored;
  fs::remove(folder_ / name, ignored);
}

void write_file(const fs::path& file, std::string_view content) {
  write_partial(file, content);
  rename_partial(file);
}

void check_writable(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) refuse(file, "it is a folder");
  if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) refuse(file, "it is there and is not a file");
  write_partial(file, "");
  fs::remove(partial(file), ignored);
}

void refuse_to_replace(const std::vector<fs::path>& files, const std::string& remedy) {
  for (const fs::path& file : files) {
    struct stat about {};
    if (stat(file.c_str(), &about) != 0 || !S_ISREG(about.st_mode)) continue;
    char since[32] = "";
    std::tm local{};
    (void)std::strftime(since, sizeof since, "%Y-%m-%d %H:%M", localtime_r(&about.st_mtime, &local));
    throw InputError(file.string() + ": is there since " + since + "; " + remedy);
  }
}

std::string file_content(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) throw InputError(file.string() + ": no such file");
  if (!fs::is_regular_file(file, error)) throw InputError(file.string() + ": not a file");
  std::ifstream in(file, std::ios::binary);
  std::string content((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in) throw InputError(file.string() + ": cannot be read");
  return content;
}

}  // namespace lasso::mdat
