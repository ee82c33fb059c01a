#include "ft/mdat/live_run.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

namespace lasso::ft {
namespace {

constexpr int kMode = 0644;

void redirect(const std::string& file, int descriptor) {
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kMode);
  (void)::dup2(opened, descriptor);
  (void)::close(opened);
}

}  // namespace

LiveRun::LiveRun(const WorkFolder& work, std::string name, std::vector<std::string> arguments) : work_(work), name_(std::move(name)) {
  arguments.insert(arguments.begin(), mdat_program());
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  const std::string folder = (work / "").string(), out = (work / (name_ + ".out")).string(), err = (work / (name_ + ".err")).string();
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("no process");
  if (pid_ > 0) return;
  redirect(out, STDOUT_FILENO);
  redirect(err, STDERR_FILENO);
  if (::chdir(folder.c_str()) == 0) (void)::execv(words.front(), words.data());
  ::_exit(127);
}

LiveRun::~LiveRun() { kill(); }

std::string LiveRun::out() const { return work_.read(name_ + ".out"); }

bool LiveRun::says(const std::string& text) {
  for (int i = 0; i < 3000; ++i) {
    if (out().find(text) != std::string::npos) return true;
    siginfo_t state{};
    if (pid_ < 0 || (::waitid(P_PID, static_cast<id_t>(pid_), &state, WEXITED | WNOHANG | WNOWAIT) == 0 && state.si_pid == pid_))
      return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

void LiveRun::kill() {
  if (pid_ < 0) return;
  (void)::kill(pid_, SIGKILL);
  (void)::waitpid(pid_, nullptr, 0);
  pid_ = -1;
}

Answer LiveRun::wait() {
  int status = 0;
  (void)::waitpid(pid_, &status, 0);
  pid_ = -1;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, out(), work_.read(name_ + ".err")};
}

std::string free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool bound = ::bind(socket, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                     ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  (void)::close(socket);
  if (!bound) throw std::runtime_error("no free port");
  return std::to_string(ntohs(address.sin_port));
}

}  // namespace lasso::ft
