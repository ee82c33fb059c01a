#include "mdat/campaign/worker.hpp"

#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <vector>

#include "mdat/campaign/record.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/source/mission_error.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kLongestMessage = 1U << 16U;

// Messages keep their bounds: the sockets are of SOCK_SEQPACKET. False where nobody is there any more.
bool send_message(int socket, Worker::Kind kind, std::string text) {
  text.insert(text.begin(), static_cast<char>(kind));
  text.resize(std::min(text.size(), kLongestMessage));
  return send(socket, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
}

ssize_t receive_bytes(int socket, void* bytes, std::size_t size) {
  ssize_t received = -1;
  do received = recv(socket, bytes, size, 0);
  while (received < 0 && errno == EINTR);
  return received;
}

std::string fields_of(const Fly& fly, std::uint32_t number) {
  try {
    std::string fields = fly(number);
    return fields.size() < kLongestMessage ? fields : failed_fields("its record is too long: fly fewer frames a case");
  } catch (const std::exception& error) {
    return failed_fields(error.what());
  }
}

bool fly_each(int socket, const Fly& fly) {
  std::uint32_t number = 0;
  while (receive_bytes(socket, &number, sizeof number) == sizeof number)
    if (!send_message(socket, Worker::Kind::kFields, fields_of(fly, number))) return false;
  return true;
}

void serve(int socket, const MakeFly& make_fly) {
  try {
    const Fly fly = make_fly();
    (void)(send_message(socket, Worker::Kind::kReady, "") && fly_each(socket, fly));
  } catch (const InputError& error) {
    (void)send_message(socket, Worker::Kind::kBadInput, error.what());
  } catch (const MissionError& error) {
    (void)send_message(socket, Worker::Kind::kBadInput, error.what());
  } catch (const std::exception& error) {
    (void)send_message(socket, Worker::Kind::kError, error.what());
  }
}

// It never outlives its parent. Ctrl-C reaches all processes of a terminal, and a scheduler's SIGTERM those of a job: the parent decides.
[[noreturn]] void be_worker(pid_t parent, int socket, const MakeFly& make_fly, const std::function<void()>& in_child) {
  (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kExitFailed);
  (void)std::signal(SIGINT, SIG_IGN);
  (void)std::signal(SIGTERM, SIG_IGN);
  in_child();
  serve(socket, make_fly);
  (void)std::fflush(nullptr);
  _exit(kExitDone);  // not exit(): what the parent has registered for its own end is not done twice
}

}  // namespace

Worker::Worker(const MakeFly& make_fly, const std::function<void()>& in_child) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
    throw RunError(std::string("no socket for a worker: ") + std::strerror(errno));
  (void)std::fflush(nullptr);
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) {
    close(ends[0]);
    be_worker(parent, ends[1], make_fly, in_child);
  }
  const int error = errno;
  close(ends[1]);
  socket_ = ends[0];
  if (process_ > 0) return;
  close(socket_);
  throw RunError(std::string("no process for a worker: ") + std::strerror(error) + "; fewer --jobs need fewer");
}

Worker::~Worker() { end(); }

void Worker::give(std::uint32_t case_number) {
  (void)!send(socket_, &case_number, sizeof case_number, MSG_NOSIGNAL);  // to a dead one: its end is received next
}

Worker::Message Worker::receive() {
  std::vector<char> bytes(kLongestMessage);
  const ssize_t size = receive_bytes(socket_, bytes.data(), bytes.size());
  if (size > 0) return {static_cast<Kind>(bytes[0]), std::string(bytes.data() + 1, static_cast<std::size_t>(size - 1))};
  end();
  return {Kind::kDead, ""};
}

// A process that has ended by itself is not changed by the signal: its own end is what is told.
void Worker::end() {
  if (process_ < 0) return;
  close(socket_);
  (void)kill(process_, SIGKILL);
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  signal_ = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  process_ = -1;
}

}  // namespace lasso::mdat
