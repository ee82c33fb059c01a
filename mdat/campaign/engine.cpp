#include "mdat/campaign/engine.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

#include "mdat/campaign/chunk_file.hpp"
#include "mdat/campaign/records.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/interruption.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kGraceSeconds = 10;  // schedulers leave thirty or more between SIGTERM and SIGKILL
constexpr int kPollMilliseconds = 100;
constexpr std::uint8_t kTries = 3;
constexpr std::uint32_t kFailuresShown = 5;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

// A line beside the progress bar.
void say(const std::string& text) { std::fprintf(stderr, "%s%s\n", isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "", text.c_str()); }

class Engine {
 public:
  Engine(const EngineOptions& options, const MakeFly& make_fly, const OnCase& on_case);
  EngineResult run();

 private:
  struct Slot {
    std::unique_ptr<Worker> worker;
    std::optional<std::uint32_t> flying;
    Clock::time_point since;
  };
  void find(const Records& records);
  void repair(const Records& records);
  std::optional<std::uint32_t> take_next();
  void start_worker(Slot& slot);
  void give_next(Slot& slot);
  void receive(Slot& slot);
  void replace_dead(Slot& slot);
  void leave_or_start_anew(Slot& slot);
  std::string record_of_dead(std::uint32_t number, int signal);
  void keep(std::uint32_t number, const std::string& fields);
  void show_failure(std::uint32_t number, const std::string& fields);
  void poll_workers();
  void check_case_times();
  void check_interruption();
  bool may_begin() const;
  bool is_over() const;
  void end_as(EngineEnd end);
  EngineResult conclude();

  const EngineOptions options_;
  const MakeFly& make_fly_;
  const OnCase& on_case_;
  const std::atomic<bool>& interrupted_;
  std::unique_ptr<ChunkFile> file_;
  std::vector<bool> recorded_;       // by case
  std::vector<std::uint8_t> kills_;  // from outside, by case
  std::vector<std::uint32_t> again_;
  std::uint32_t next_, failures_ = 0;
  std::uint8_t killed_starts_ = 0;
  std::vector<Slot> slots_;
  EngineResult result_;
  bool ending_ = false;
  Clock::time_point begin_ = Clock::now(), ending_since_;
  double longest_s_ = 0;
  std::unique_ptr<ProgressBar> bar_;
};

Engine::Engine(const EngineOptions& options, const MakeFly& make_fly, const OnCase& on_case)
    : options_(options),
      make_fly_(make_fly),
      on_case_(on_case),
      interrupted_(interruption()),
      recorded_(options.cases),
      kills_(options.cases),
      next_(options.chunk.number - 1) {
  (void)std::signal(SIGXFSZ, SIG_IGN);  // a file that has become too large is an error of write()
  file_ = std::make_unique<ChunkFile>(options.folder, chunk_name(options.chunk), options.plan_digest);
  for (const std::string& note : file_->notes()) say("warning: " + note);
  const Records records(options.folder, options.plan_digest, options.cases, options.chunk);
  find(records);
  repair(records);
}

void Engine::find(const Records& records) {
  for (std::uint32_t number = next_; number < options_.cases; number += options_.chunk.of) {
    const std::optional<std::string_view> fields = records.of(number);
    recorded_[number] = fields.has_value();
    ++(fields ? result_.found : result_.missing);
    if (fields && !ending_ && !on_case_(number, std::string(*fields))) end_as(EngineEnd::kDecided);
  }
}

// Of other chunks: their runners do it themselves.
void Engine::repair(const Records& records) {
  for (const std::filesystem::path& file : records.damaged_files()) {
    if (in_flight(file)) continue;
    const TakenOut taken = repair_chunk(
        file, options_.plan_digest, [](const CaseRecord&) { return false; }, ".damaged");
    for (const std::string& note : taken.damaged) say("warning: " + note);
  }
}

std::optional<std::uint32_t> Engine::take_next() {
  if (!again_.empty()) {
    const std::uint32_t number = again_.back();
    again_.pop_back();
    return number;
  }
  while (next_ < options_.cases && recorded_[next_]) next_ += options_.chunk.of;
  if (next_ >= options_.cases) return std::nullopt;
  const std::uint32_t number = next_;
  next_ += options_.chunk.of;
  return number;
}

void Engine::start_worker(Slot& slot) {
  slot.worker = std::make_unique<Worker>(make_fly_, [this] {
    file_.reset();
    for (Slot& other : slots_)
      if (other.worker) close(other.worker->socket());
  });
}

bool Engine::may_begin() const { return !ending_ && seconds_since(begin_) + longest_s_ < options_.time_limit_s; }

void Engine::give_next(Slot& slot) {
  if (!ending_ && !may_begin()) end_as(EngineEnd::kTimeLimit);
  slot.flying = ending_ ? std::nullopt : take_next();
  slot.since = Clock::now();
  if (slot.flying) {
    slot.worker->give(*slot.flying);
  } else {
    slot.worker.reset();
  }
}

void Engine::receive(Slot& slot) {
  const Worker::Message message = slot.worker->receive();
  if (message.kind == Worker::Kind::kDead) return replace_dead(slot);
  if (message.kind == Worker::Kind::kBadInput) throw InputError(message.text);
  if (message.kind == Worker::Kind::kError) throw RunError(message.text);
  if (message.kind == Worker::Kind::kFields && slot.flying) {
    longest_s_ = std::max(longest_s_, seconds_since(slot.since));
    keep(*slot.flying, message.text);
  }
  give_next(slot);
}

// Signals that a program brings upon itself: the same case would do so again. All others come from outside, such as SIGKILL where memory
// is short, SIGXCPU of a limit, SIGHUP of a terminal that closes.
bool is_crash(int signal) {
  constexpr int kCrashes[] = {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGSYS, SIGTRAP};
  return std::find(std::begin(kCrashes), std::end(kCrashes), signal) != std::end(kCrashes);
}

// The record of a case whose worker was ended by a signal (0: it left by itself); empty if it is to be flown again.
std::string Engine::record_of_dead(std::uint32_t number, int signal) {
  if (signal == 0) return failed_fields("its process ended by itself");
  if (is_crash(signal)) return failed_fields("crashed with signal " + std::to_string(signal));
  if (++kills_[number] == kTries) return failed_fields("killed " + std::to_string(kTries) + " times");
  again_.push_back(number);
  return "";
}

void Engine::replace_dead(Slot& slot) {
  const int signal = slot.worker->signal();
  const std::string how = signal == 0 ? "ended by itself" : format("was ended by signal %d (%s)", signal, strsignal(signal));
  if (!slot.flying && (signal == 0 || is_crash(signal) || ++killed_starts_ == kTries))
    throw RunError("a worker " + how + " before it flew a case: it may be short of memory (fewer --jobs need less)");
  if (slot.flying) {
    const std::string fields = record_of_dead(*slot.flying, signal);
    say(format("warning: case %u: its process %s%s", *slot.flying, how.c_str(), fields.empty() ? "; it is flown again" : ""));
    if (!fields.empty()) keep(*slot.flying, fields);
  }
  leave_or_start_anew(slot);
}

// A slot without a worker flies nothing: its case has its record, or is flown again.
void Engine::leave_or_start_anew(Slot& slot) {
  slot.worker.reset();
  slot.flying.reset();
  if (!ending_) start_worker(slot);
}

void Engine::keep(std::uint32_t number, const std::string& fields) {
  file_->append(number, fields);
  recorded_[number] = true;
  ++result_.flown;
  --result_.missing;
  if (is_failed(fields)) show_failure(number, fields);
  bar_->show(result_.flown);
  if (!on_case_(number, fields)) end_as(EngineEnd::kDecided);
}

void Engine::show_failure(std::uint32_t number, const std::string& fields) {
  if (++failures_ <= kFailuresShown) say(format("case %u failed: %s", number, fields.c_str() + fields.find(':') + 1));
  if (failures_ == kFailuresShown) say("further failed cases are counted, and not shown");
}

void Engine::poll_workers() {
  std::vector<pollfd> sockets;
  std::vector<Slot*> slots;
  for (Slot& slot : slots_) {
    if (!slot.worker) continue;
    sockets.push_back({slot.worker->socket(), POLLIN, 0});
    slots.push_back(&slot);
  }
  if (poll(sockets.data(), sockets.size(), kPollMilliseconds) <= 0) return;  // also where a signal came
  for (std::size_t i = 0; i < slots.size() && !is_over(); ++i)
    if (sockets[i].revents != 0) receive(*slots[i]);
}

void Engine::check_case_times() {
  for (Slot& slot : slots_) {
    if (!slot.flying || seconds_since(slot.since) < options_.case_time_limit_s) continue;
    keep(*slot.flying, failed_fields(format("longer than %g s", options_.case_time_limit_s)));
    leave_or_start_anew(slot);
  }
}

void Engine::end_as(EngineEnd end) {
  if (ending_) return;
  ending_ = true;
  result_.end = end;
  ending_since_ = Clock::now();
}

// Cases that were begun before a time limit are waited for, but not against the user's wish.
void Engine::check_interruption() {
  if (!interrupted_ || (ending_ && result_.end != EngineEnd::kTimeLimit)) return;
  ending_ = false;
  end_as(EngineEnd::kInterrupted);
  say(format("stopping: cases that end within %.0f s are kept", kGraceSeconds));
}

// Nobody flies a case any more, or whoever still does is not waited for.
bool Engine::is_over() const {
  const bool flying = std::any_of(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.worker && slot.flying; });
  if (!ending_) return std::none_of(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.worker != nullptr; });
  if (!flying || result_.end == EngineEnd::kDecided) return true;
  return result_.end == EngineEnd::kTimeLimit ? seconds_since(begin_) > options_.time_limit_s
                                              : seconds_since(ending_since_) > kGraceSeconds;
}

EngineResult Engine::run() {
  slots_.resize(ending_ ? 0 : std::min(std::max(options_.jobs, 1U), result_.missing));
  bar_ = std::make_unique<ProgressBar>("campaign", result_.missing, "cases");
  for (Slot& slot : slots_) start_worker(slot);
  for (; !is_over(); check_case_times()) {
    check_interruption();
    poll_workers();
  }
  return conclude();
}

EngineResult Engine::conclude() {
  slots_.clear();
  if (result_.missing == 0) result_.end = EngineEnd::kDone;
  if (result_.end == EngineEnd::kDone || result_.end == EngineEnd::kDecided) {
    if (result_.flown > 0)
      result_.missing == 0 ? bar_->finish() : say(format("campaign: decided after %u cases", result_.found + result_.flown));
    file_->complete();
  } else {
    say(format("stopped: %u of %u cases are done; the same command goes on", result_.found + result_.flown,
               result_.found + result_.flown + result_.missing));
  }
  return result_;
}

}  // namespace

EngineResult fly_cases(const EngineOptions& options, const MakeFly& make_fly, const OnCase& on_case) {
  return Engine(options, make_fly, on_case).run();
}

int exit_code_of(EngineEnd end) { return end == EngineEnd::kInterrupted || end == EngineEnd::kTimeLimit ? kExitGoOn : kExitDone; }

}  // namespace lasso::mdat
