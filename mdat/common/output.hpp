// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lasso::mdat {

// Several files of one folder that appear together: each is written beside its place, commit() renames all. Without commit() neither they
// nor the folders made for them stay.
class OutputFolder {
 public:
  // Makes the folder (and those above it) and tries to write in it, before any long work. Throws InputError.
  explicit OutputFolder(const std::filesystem::path& folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  // Throws InputError when the file cannot be written.
  void write(const std::string& name, std::string_view content);
  void commit();
  // A file of an earlier run, which the new one does not have.
  void remove(const std::string& name);
  const std::filesystem::path& path() const { return folder_; }

 private:
  void make_folders();
  void remove_made_folders();
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> made_;  // outermost first
  std::vector<std::string> names_;           // written, not yet renamed
};

// One file, in its own folder, which must exist. Throws InputError.
void write_file(const std::filesystem::path& file, std::string_view content);

// Tries to write beside `file`. Throws InputError; changes nothing.
void check_writable(const std::filesystem::path& file);

// One of these files is there: throws InputError that says since when, and ends with the remedy.
void refuse_to_replace(const std::vector<std::filesystem::path>& files, const std::string& remedy);

// A file's bytes. Throws InputError.
std::string file_content(const std::filesystem::path& file);

}  // namespace lasso::mdat
