#include "bsp/posix/reset_note.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <system_error>

namespace lasso::posix {
namespace {

constexpr mode_t kFileMode = 0644;
constexpr int kSignals[] = {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};

std::atomic<int> g_file{-1};  // for the handler

void write_cause(int file, ResetCause cause) {
  const auto byte = static_cast<unsigned char>(cause);
  if (pwrite(file, &byte, 1, 0) == 1) (void)fdatasync(file);
}

// The watchdog's timer sends the same signal as abort().
ResetCause cause_of(int signal, const siginfo_t& info) {
  if (signal != SIGABRT) return ResetCause::kException;
  return info.si_code == SI_TIMER ? ResetCause::kWatchdog : ResetCause::kInvariant;
}

// Of calls that a handler may make.
extern "C" void lasso_note_reset(int signal, siginfo_t* info, void*) {
  write_cause(g_file, cause_of(signal, *info));
  (void)::signal(signal, SIG_DFL);
  (void)::raise(signal);
}

}  // namespace

ResetNote::ResetNote(const std::string& folder) {
  const std::string path = folder + "/reset";
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kFileMode);
  if (file < 0) throw std::system_error(errno, std::generic_category(), path);
  unsigned char byte = 0;
  if (pread(file, &byte, 1, 0) == 1 && byte <= static_cast<unsigned char>(ResetCause::kException)) cause_ = static_cast<ResetCause>(byte);
  write_cause(file, ResetCause::kPowerOn);
  g_file = file;
  struct sigaction action {};
  action.sa_sigaction = lasso_note_reset;
  action.sa_flags = SA_SIGINFO;
  for (const int signal : kSignals) (void)sigaction(signal, &action, nullptr);
}

ResetNote::~ResetNote() {
  for (const int signal : kSignals) (void)::signal(signal, SIG_DFL);
  (void)::close(g_file.exchange(-1));
}

}  // namespace lasso::posix
