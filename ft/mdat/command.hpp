// mdat as its user sees it: a command line, what it prints, its exit code, and the files it leaves.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lasso::ft {

using Json = nlohmann::ordered_json;

struct Answer {
  int exit_code = -1;  // -1: ended by a signal
  std::string out, err;
};

// A folder for one test, with a copy of the default mission in it; removed at the end.
class WorkFolder {
 public:
  WorkFolder();
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  // Runs `mdat ARGUMENTS` in this folder, by a shell; `environment` stands before it, NAME=VALUE each.
  Answer mdat(const std::string& arguments, const std::string& environment = "") const;

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& content) const;
  std::string read(const std::string& name) const;
  // missions/test.toml: the default mission with each of the texts replaced (which must occur).
  void write_mission(const std::vector<std::pair<std::string, std::string>>& replacements = {}) const;
  // Records `mdat RUN` (to FILE.mcap beside), and exports its scans and poses into `folder`.
  void record_scans(const std::string& run, const std::string& folder) const;
  // All files and folders below, sorted: shows what a command left behind.
  std::vector<std::string> contents(const std::string& below = "") const;

 private:
  friend class Program;
  std::filesystem::path folder_;
};

// `mdat ARGUMENTS` in a folder, in the background.
class Program {
 public:
  Program(const WorkFolder& work, const std::string& arguments);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // What it has printed so far.
  std::string printed() const;
  // As Ctrl-C does, and waits until it has ended.
  Answer interrupt();

 private:
  std::string out_, err_;
  pid_t process_;
};

// True in a build for fixed point, where noise or times of a mission may be more than its numbers hold: then it was refused, which is
// asked.
bool is_refused_by_fixed_point(const Answer& answer);
// The same of a campaign, which tells so of its cases, and goes on.
bool tells_of_fixed_point(const Answer& answer);

std::string mdat_program();                        // its path
std::string source_path(const std::string& name);  // of a file in the repository
std::string read_text(const std::filesystem::path& file);
std::vector<std::string> lines_of(const std::string& text);
std::vector<std::string> fields_of(const std::string& line);  // separated by commas

}  // namespace lasso::ft
