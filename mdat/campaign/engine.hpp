// Flies the missing cases of a campaign, or of one of its chunks, in processes of this machine, and writes each down when it is finished.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>

#include "mdat/campaign/chunk.hpp"
#include "mdat/campaign/worker.hpp"

namespace lasso::mdat {

struct EngineOptions {
  std::filesystem::path folder;  // of the campaign; the records go to its chunks/
  std::string plan_digest;
  std::uint32_t cases = 0;                                             // of the plan
  Chunk chunk;                                                         // which of them; 1 of 1: all
  unsigned jobs = 1;                                                   // processes at a time
  double time_limit_s = std::numeric_limits<double>::infinity();       // of the whole: no case begins that would probably end later
  double case_time_limit_s = std::numeric_limits<double>::infinity();  // a case that takes longer is ended, and has failed
};

enum class EngineEnd : std::uint8_t {
  kDone,         // no case of the chunk is missing
  kDecided,      // on_case wanted no more
  kInterrupted,  // Ctrl-C or SIGTERM
  kTimeLimit,
};

struct EngineResult {
  EngineEnd end = EngineEnd::kDone;
  std::uint32_t found = 0, flown = 0, missing = 0;  // cases of the chunk: recorded before, recorded now, neither
};

// Called with each record of the chunk: those found first, then those flown, as they come. False: no more cases are needed.
using OnCase = std::function<bool(std::uint32_t case_number, const std::string& fields)>;

// One writer, this process; `jobs` workers. A worker that dies is replaced. Its case has the record "failed:crashed with signal N", except
// where the signal came from outside (SIGKILL as memory was short, SIGXCPU, SIGHUP): then the case is flown again, three times in all. On
// Ctrl-C or SIGTERM cases that end within ten seconds are written down, others are dropped; the same call goes on later. Shows progress and
// the first failures on standard error. Must be called before threads are started in this process (Embree's, too): make_fly is called in
// each worker. Throws InputError, RunError; what is finished stays.
EngineResult fly_cases(const EngineOptions& options, const MakeFly& make_fly, const OnCase& on_case);

// The exit code of the command: 0 done or decided, 75 (EX_TEMPFAIL) if the same command is to go on later.
constexpr int kExitGoOn = 75;
int exit_code_of(EngineEnd end);

}  // namespace lasso::mdat
