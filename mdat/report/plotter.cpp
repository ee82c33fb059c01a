#include "mdat/report/plotter.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <vector>

#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr int kCannotRun = -1;
constexpr std::size_t kLongestMessage = 200;  // characters of gnuplot's

// The environment without what changes gnuplot: its own variables (GNUTERM, GNUPLOT_LIB, FIT_LOG, ...) and the language.
std::vector<std::string> plain_environment() {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    const auto begins = [&](const char* prefix) { return text.rfind(prefix, 0) == 0; };
    if (!begins("GNU") && !begins("FIT_") && !begins("LC_") && !begins("LANG")) variables.push_back(text);
  }
  variables.emplace_back("LC_ALL=C.UTF-8");
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

// Runs gnuplot without a shell in `folder`, with nothing to read; what it says goes to `messages`. Its exit code; kCannotRun: errno says
// why.
int run_gnuplot(std::vector<std::string> arguments, const std::filesystem::path& folder, const std::string& messages) {
  arguments.insert(arguments.begin(), "gnuplot");
  std::vector<std::string> variables = plain_environment();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = 0;
  errno = posix_spawnp(&process, "gnuplot", &actions, nullptr, pointers(arguments).data(), pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  if (errno != 0) return kCannotRun;
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string cannot_run(const std::string& why) { return "gnuplot cannot be run (" + why + "); install the package gnuplot-nox"; }

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// gnuplot repeats the line that it stumbles over, and says at the end what is wrong with it.
std::string last_line(const std::string& text) {
  std::istringstream in(text);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  }
  return last.substr(0, kLongestMessage);
}

std::string quoted(const std::string& text) { return "'" + text + "'"; }

// Of an SVG file only the element: it stands inside of an HTML page.
std::string element_of(const std::string& svg) {
  const std::size_t begin = svg.find("<svg");
  return begin == std::string::npos ? svg : svg.substr(begin);
}

std::string size_text(int width, int height) { return " size " + std::to_string(width) + "," + std::to_string(height); }

}  // namespace

Plotter::Plotter(const std::filesystem::path& parent) {
  std::string name = (std::filesystem::absolute(parent) / ".mdat-figures-XXXXXX").string();
  if (mkdtemp(name.data()) != nullptr)
    folder_ = name;
  else
    failure_ = name + ": no folder can be made for the figures: " + std::strerror(errno);
}

Plotter::~Plotter() {
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

std::string Plotter::data(std::string_view content) {
  const std::string name = "data" + std::to_string(files_++);
  if (!folder_.empty()) std::ofstream(folder_ / name, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  return quoted(name);
}

std::string Plotter::svg(int width, int height, const std::string& script) {
  return element_of(
      draw("svg" + size_text(width, height) + " dynamic enhanced font 'Arial,13' linewidth 1.2 background '#ffffff'", script));
}

std::string Plotter::png(int width, int height, double scale, const std::string& script) {
  const std::string size = size_text(static_cast<int>(scale * width), static_cast<int>(scale * height));
  return draw(
      "pngcairo" + size +
          format(" enhanced font 'Sans,14' fontscale %g pointscale %g linewidth %g background '#ffffff'", scale, scale, 1.5 * scale),
      script);
}

std::string Plotter::or_missing(const std::function<std::string()>& draw) {
  try {
    return draw();
  } catch (const PictureError& error) {
    if (missing_.empty()) missing_ = error.what();
    return "<p class='missing'>This figure is missing: " + escape(error.what()) + ".</p>";
  }
}

std::string Plotter::draw(const std::string& terminal, const std::string& script) {
  if (folder_.empty()) throw PictureError(failure_);
  std::ofstream(folder_ / "script") << "set encoding utf8\nset terminal " << terminal << "\nset output 'figure'\n"
                                    << script << "\nunset output\n";
  std::filesystem::remove(folder_ / "figure");
  const int code = run_gnuplot({"-d", "script"}, folder_, "messages");
  if (code == kCannotRun) throw PictureError(cannot_run(std::strerror(errno)));
  const std::string figure = content_of(folder_ / "figure");
  if (code != 0 || figure.empty())
    throw PictureError("gnuplot failed (code " + std::to_string(code) + "): " + last_line(content_of(folder_ / "messages")));
  return figure;
}

std::string why_no_plotter() {
  const int code = run_gnuplot({"-d", "--version"}, "/", "/dev/null");
  if (code == 0) return "";
  return cannot_run(code == kCannotRun ? std::strerror(errno) : "its code is " + std::to_string(code));
}

}  // namespace lasso::mdat
