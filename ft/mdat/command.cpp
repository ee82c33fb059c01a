#include "ft/mdat/command.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "ut/support/places.hpp"

namespace lasso::ft {

namespace fs = std::filesystem;

namespace {

// Beside the folder; of its own for each program.
std::string next_file(const fs::path& folder) {
  static std::atomic<int> number{0};
  return folder.string() + "." + std::to_string(++number);
}

std::string command_line(const fs::path& folder, const std::string& command, const std::string& out, const std::string& err) {
  return "cd '" + folder.string() + "' && " + command + " >'" + out + "' 2>'" + err + "'";
}

Answer answer_of(int status, const std::string& out, const std::string& err) {
  Answer answer{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(out), read_text(err)};
  fs::remove(out);
  fs::remove(err);
  return answer;
}

}  // namespace

WorkFolder::WorkFolder() {
  std::string name = (fs::temp_directory_path() / "mdat-ft-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = name;
  fs::create_directories(folder_ / "missions/models");
  fs::copy(source_path("cfg/models/hubble_tenth.toml"), folder_ / "missions/models");
  write_mission();
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

Answer WorkFolder::mdat(const std::string& arguments, const std::string& environment) const {
  const std::string out = next_file(folder_), err = next_file(folder_);
  const int status = std::system(command_line(folder_, environment + " '" + mdat_program() + "' " + arguments, out, err).c_str());
  return answer_of(status, out, err);
}

Program::Program(const WorkFolder& work, const std::string& arguments) : out_(next_file(work.folder_)), err_(next_file(work.folder_)) {
  const std::string command = command_line(work.folder_, "exec '" + mdat_program() + "' " + arguments, out_, err_);
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("no process");
  if (process_ > 0) return;
  execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
  _exit(127);
}

Program::~Program() {
  if (process_ > 0) interrupt();
}

std::string Program::printed() const { return fs::exists(out_) ? read_text(out_) : ""; }

Answer Program::interrupt() {
  int status = 0;
  kill(process_, SIGINT);
  waitpid(process_, &status, 0);
  process_ = 0;
  return answer_of(status, out_, err_);
}

void WorkFolder::write(const std::string& name, const std::string& content) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name, std::ios::binary) << content;
}

std::string WorkFolder::read(const std::string& name) const { return read_text(folder_ / name); }

void WorkFolder::write_mission(const std::vector<std::pair<std::string, std::string>>& replacements) const {
  std::string text = read_text(source_path("cfg/missions/hubble_tenth.toml"));
  for (const auto& [from, to] : replacements) {
    const std::size_t place = text.find(from);
    if (place == std::string::npos) throw std::runtime_error("not in the mission: " + from);
    text.replace(place, from.size(), to);
  }
  write("missions/test.toml", text);
}

void WorkFolder::record_scans(const std::string& run, const std::string& folder) const {
  const Answer recorded = mdat(run + " --no-report --force --out recorded_run --record recorded_run.mcap");
  EXPECT_EQ(recorded.exit_code, 0) << recorded.err;
  const Answer exported = mdat("recording export recorded_run.mcap --format scans --force -o " + folder);
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  std::filesystem::remove_all(folder_ / "recorded_run");
  std::filesystem::remove(folder_ / "recorded_run.mcap");
}

std::vector<std::string> WorkFolder::contents(const std::string& below) const {
  std::vector<std::string> names;
  const fs::path folder = folder_ / below;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) names.push_back(fs::relative(entry.path(), folder).string());
  std::sort(names.begin(), names.end());
  return names;
}

bool tells_of_fixed_point(const Answer& answer) {
  if (!FIXED_POINT) return false;
  EXPECT_NE(answer.err.find("than the number type holds"), std::string::npos) << answer.err;
  return true;
}

bool is_refused_by_fixed_point(const Answer& answer) {
  if (!tells_of_fixed_point(answer)) return false;
  EXPECT_NE(answer.exit_code, 0);
  return true;
}

std::string mdat_program() { return (test::build_folder() / "mdat/mdat").string(); }

std::string source_path(const std::string& name) { return (test::source_folder() / name).string(); }

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> fields;
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace lasso::ft
