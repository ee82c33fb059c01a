// For tests of scan files: a folder of their own, and what an error says.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "hal_sim/scan_file.hpp"

namespace lasso::test {

// A new folder that disappears with the object.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "lasso_scan_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) ADD_FAILURE() << "no folder for the test";
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::filesystem::path path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

// Reading `content` as a file `name` fails with one line that has the file's path, followed by `place_and_value`, and the remedy in it.
inline void expect_refused(const std::string& name, const std::string& content, const std::string& place_and_value,
                           const std::string& remedy) {
  const Folder folder;
  const auto file = folder.write(name, content);
  try {
    (void)sim::read_scan_file(file);
    ADD_FAILURE() << "accepted: " << content.substr(0, 200);
  } catch (const sim::ScanFileError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find(file.string() + place_and_value), 0u) << what;
    EXPECT_NE(what.find(remedy), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  }
}

}  // namespace lasso::test
