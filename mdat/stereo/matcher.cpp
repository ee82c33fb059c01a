#include "mdat/stereo/matcher.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"

extern char** environ;

namespace lasso::mdat {
namespace {

constexpr const char* kMatcherName = "mdat-match";
constexpr int kRefused = 2, kNotThere = 127;

// Its exit code; what it says goes to `messages`.
int run_program(const std::filesystem::path& program, std::vector<std::string> arguments, const std::filesystem::path& messages) {
  arguments.insert(arguments.begin(), program.string());
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = 0;
  const int failed = posix_spawnp(&process, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return kNotThere;
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// Without the program's own name before it.
std::string first_line(const std::filesystem::path& messages) {
  std::ifstream in(messages);
  std::string line;
  std::getline(in, line);
  const std::string prefix = std::string(kMatcherName) + ": ";
  return line.rfind(prefix, 0) == 0 ? line.substr(prefix.size()) : line;
}

[[noreturn]] void refuse(int exit_code, const std::filesystem::path& messages) {
  if (exit_code == kNotThere)
    throw RunError(
        "stereo: the matcher mdat-match is not there, as it needs OpenCV: make stereo installs the Debian packages libopencv-core-dev, "
        "libopencv-imgproc-dev and libopencv-calib3d-dev, and builds it");
  if (exit_code == kRefused) throw InputError(first_line(messages));
  throw RunError("stereo: mdat-match ended with " + std::to_string(exit_code) + ": " + first_line(messages));
}

}  // namespace

std::filesystem::path matcher_program() {
  std::error_code failed;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", failed);
  const std::filesystem::path beside = own.parent_path() / kMatcherName;
  return !failed && std::filesystem::exists(beside) ? beside : std::filesystem::path(kMatcherName);
}

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "mdat-stereo-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw RunError(name + ": no folder can be made: " + std::strerror(errno));
  folder_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

DisparityMap match_files(const std::filesystem::path& program, const PairFiles& files, const MatchDepths& depths) {
  const ScratchFolder scratch;
  const std::filesystem::path disparity = scratch.path() / "disparity.png", geometry = scratch.path() / "geometry.json";
  const std::filesystem::path messages = scratch.path() / "messages.txt";
  const int exit_code = run_program(program,
                                    {"--left", files.left.string(), "--right", files.right.string(), "--calibration",
                                     files.calibration.string(), "--nearest", format("%.9g", depths.nearest_m), "--farthest",
                                     format("%.9g", depths.farthest_m), "--disparity", disparity.string(), "--geometry", geometry.string()},
                                    messages);
  if (exit_code != 0) refuse(exit_code, messages);
  return read_disparity_map(disparity, geometry);
}

}  // namespace lasso::mdat
