#include "mdat/campaign/engine.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <thread>

#include "mdat/campaign/records.hpp"
#include "mdat/common/errors.hpp"
#include "ut/mdat/campaign/chunk_folder.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::ChunkFolder;
using test::kPlan;
using test::message_of;

std::string fields_of_case(std::uint32_t number) { return "ok," + std::to_string(number * 2654435761U); }

MakeFly flies(Fly fly) {
  return [fly = std::move(fly)] { return fly; };
}

MakeFly flies_in(std::chrono::microseconds time) {
  return flies([time](std::uint32_t number) {
    std::this_thread::sleep_for(time);
    return fields_of_case(number);
  });
}

EngineOptions options_of(const ChunkFolder& folder, std::uint32_t cases, unsigned jobs, Chunk chunk = {}) {
  EngineOptions options;
  options.folder = folder.path();
  options.plan_digest = kPlan;
  options.cases = cases;
  options.jobs = jobs;
  options.chunk = chunk;
  return options;
}

bool goes_on(std::uint32_t, const std::string&) { return true; }

// What is said on standard error stays out of the test's log.
struct Quiet {
  Quiet() { ::testing::internal::CaptureStderr(); }
  ~Quiet() {
    if (!taken) (void)::testing::internal::GetCapturedStderr();
  }
  std::string said() {
    taken = true;
    return ::testing::internal::GetCapturedStderr();
  }
  bool taken = false;
};

std::string merged(const ChunkFolder& folder, std::uint32_t cases) {
  const Records records(folder.path(), kPlan, cases);
  std::string text;
  for (std::uint32_t i = 0; i < cases; ++i) text += std::string(records.of(i).value_or("missing")) + "\n";
  return text;
}

std::string undisturbed(std::uint32_t cases) {
  std::string text;
  for (std::uint32_t i = 0; i < cases; ++i) text += fields_of_case(i) + "\n";
  return text;
}

// The engine in a process of its own, as the command is.
pid_t start_engine(const EngineOptions& options, const MakeFly& make_fly) {
  const pid_t process = fork();
  if (process != 0) return process;
  (void)!freopen("/dev/null", "w", stderr);
  try {
    _exit(exit_code_of(fly_cases(options, make_fly, goes_on).end));
  } catch (const std::exception&) {
    _exit(kExitFailed);
  }
}

int status_of(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return status;
}

TEST(CampaignEngine, GivesTheSameForAnyChunksAndJobs) {
  VERIFIES("LASSO-GND-091~1 LASSO-GND-062~1");
  Quiet quiet;
  for (const auto& [chunks, jobs] : {std::pair{1U, 1U}, {1U, 3U}, {2U, 1U}, {13U, 4U}}) {
    const ChunkFolder folder;
    for (std::uint32_t i = chunks; i >= 1; --i) {
      const EngineResult result = fly_cases(options_of(folder, 11, jobs, {i, chunks}), flies(fields_of_case), goes_on);
      EXPECT_EQ(result.end, EngineEnd::kDone);
      EXPECT_EQ(result.missing, 0U);
    }
    EXPECT_EQ(merged(folder, 11), undisturbed(11));
    for (const auto& file : std::filesystem::directory_iterator(folder.path() / "chunks")) EXPECT_EQ(file.path().extension(), ".done");
  }
}

TEST(CampaignEngine, FliesWhatIsMissingWhateverTheChunksWere) {
  VERIFIES("LASSO-GND-091~1");
  Quiet quiet;
  const ChunkFolder folder;
  fly_cases(options_of(folder, 20, 1, {2, 3}), flies(fields_of_case), goes_on);
  std::map<std::uint32_t, int> calls;
  const EngineResult result =
      fly_cases(options_of(folder, 20, 2), flies(fields_of_case), [&](std::uint32_t number, const std::string& fields) {
        EXPECT_EQ(fields, fields_of_case(number));
        ++calls[number];
        return true;
      });
  EXPECT_EQ(result.found, 7U);
  EXPECT_EQ(result.flown, 13U);
  EXPECT_EQ(calls.size(), 20U);
  EXPECT_EQ(merged(folder, 20), undisturbed(20));
}

TEST(CampaignEngine, ACaseThatThrowsOrCrashesHasFailedAndTheOthersAreFlown) {
  VERIFIES("LASSO-GND-091~1");
  Quiet quiet;
  const ChunkFolder folder;
  const Fly fly = [](std::uint32_t number) -> std::string {
    if (number == 3) throw RunError("a pose, refused");
    if (number == 5) {
      (void)signal(SIGSEGV, SIG_DFL);
      (void)raise(SIGSEGV);
    }
    if (number == 6) _exit(0);
    return fields_of_case(number);
  };
  EXPECT_EQ(fly_cases(options_of(folder, 9, 2), flies(fly), goes_on).end, EngineEnd::kDone);
  const Records records(folder.path(), kPlan, 9);
  EXPECT_EQ(records.of(3), "failed:a pose; refused");
  EXPECT_EQ(records.of(5), "failed:crashed with signal 11");
  EXPECT_EQ(records.of(6), "failed:its process ended by itself");
  EXPECT_EQ(records.failed(), 3U);
  EXPECT_EQ(records.missing(), 0U);
  const std::string said = quiet.said();
  EXPECT_NE(said.find("warning: case 5: its process was ended by signal 11 (Segmentation fault)\n"), std::string::npos) << said;
  EXPECT_NE(said.find("case 3 failed: a pose; refused\n"), std::string::npos) << said;
}

TEST(CampaignEngine, ACaseThatIsKilledIsFlownAgain) {
  VERIFIES("LASSO-GND-091~1");
  Quiet quiet;
  const ChunkFolder folder;
  const auto mark = folder.path() / "killed";
  const Fly fly = [&](std::uint32_t number) {
    if (number == 2 && !std::filesystem::exists(mark)) {
      std::ofstream{mark};
      (void)raise(SIGKILL);
    }
    if (number == 4) (void)raise(SIGKILL);
    return fields_of_case(number);
  };
  EXPECT_EQ(fly_cases(options_of(folder, 6, 2), flies(fly), goes_on).end, EngineEnd::kDone);
  const Records records(folder.path(), kPlan, 6);
  EXPECT_EQ(records.of(2), fields_of_case(2));
  EXPECT_EQ(records.of(4), "failed:killed 3 times");
  EXPECT_EQ(records.failed(), 1U);
}

// Case 0 crashes after SIGTERM, while case 2 is still waited for until after the time that case 0 had: that must not give it a second
// record.
TEST(CampaignEngine, ACaseThatCrashesInTheEndHasOneRecord) {
  VERIFIES("LASSO-GND-090~1 LASSO-GND-091~1");
  const ChunkFolder folder;
  const auto flying = folder.path() / "flying", told = folder.path() / "told";
  const auto wait_for = [](const std::filesystem::path& mark) {
    while (!std::filesystem::exists(mark)) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  };
  const MakeFly fly = flies([&](std::uint32_t number) {
    if (number == 2) std::ofstream{flying};
    if (number == 0) wait_for(told);
    std::this_thread::sleep_for(std::chrono::milliseconds(number == 0 ? 10 : 300 * number * number));  // case 1 and then 2: 1.5 s
    if (number == 0) (void)raise(SIGABRT);
    return fields_of_case(number);
  });
  EngineOptions options = options_of(folder, 3, 2);
  options.case_time_limit_s = 1.4;
  const pid_t process = start_engine(options, fly);
  wait_for(flying);
  kill(process, SIGTERM);
  std::ofstream{told};
  (void)status_of(process);
  EXPECT_EQ(Records(folder.path(), kPlan, 3).of(0), "failed:crashed with signal 6");
}

TEST(CampaignEngine, ASignalFromOutsideIsNoCrash) {
  VERIFIES("LASSO-GND-091~1");
  Quiet quiet;
  const ChunkFolder folder;
  const auto mark = folder.path() / "limited";
  const Fly fly = [&](std::uint32_t number) {
    if (number == 1 && !std::filesystem::exists(mark)) {
      std::ofstream{mark};
      (void)raise(SIGUSR1);
    }
    return fields_of_case(number);
  };
  EXPECT_EQ(fly_cases(options_of(folder, 3, 1), flies(fly), goes_on).end, EngineEnd::kDone);
  EXPECT_EQ(Records(folder.path(), kPlan, 3).of(1), fields_of_case(1));
}

TEST(CampaignEngine, ACaseThatDoesNotEndHasFailed) {
  VERIFIES("LASSO-GND-091~1");
  Quiet quiet;
  const ChunkFolder folder;
  EngineOptions options = options_of(folder, 3, 2);
  options.case_time_limit_s = 0.15;
  const Fly fly = [](std::uint32_t number) {
    while (number == 1) pause();
    return fields_of_case(number);
  };
  EXPECT_EQ(fly_cases(options, flies(fly), goes_on).end, EngineEnd::kDone);
  EXPECT_EQ(Records(folder.path(), kPlan, 3).of(1), "failed:longer than 0.15 s");
  EXPECT_EQ(Records(folder.path(), kPlan, 3).of(2), fields_of_case(2));
}

TEST(CampaignEngine, EndsWhereItsMissionIsRefused) {
  VERIFIES("LASSO-GND-091~1");
  Quiet quiet;
  const ChunkFolder folder;
  const MakeFly refused = []() -> Fly { throw InputError("m.toml:3: no"); };
  const MakeFly crashes = []() -> Fly { abort(); };
  EXPECT_EQ(message_of<InputError>([&] { fly_cases(options_of(folder, 3, 2), refused, goes_on); }), "m.toml:3: no");
  const std::string message = message_of<RunError>([&] { fly_cases(options_of(folder, 3, 2), crashes, goes_on); });
  EXPECT_NE(message.find("a worker was ended by signal 6 (Aborted) before it flew a case"), std::string::npos) << message;
  EXPECT_EQ(fly_cases(options_of(folder, 3, 2), flies(fields_of_case), goes_on).end, EngineEnd::kDone);
}

TEST(CampaignEngine, StopsWhereItIsDecided) {
  VERIFIES("LASSO-GND-091~1");
  Quiet quiet;
  const ChunkFolder folder;
  std::uint32_t seen = 0;
  const auto after_four = [&](std::uint32_t, const std::string&) { return ++seen < 4; };
  EngineResult result = fly_cases(options_of(folder, 100, 2), flies(fields_of_case), after_four);
  EXPECT_EQ(result.end, EngineEnd::kDecided);
  EXPECT_EQ(result.flown, 4U);
  EXPECT_TRUE(folder.has("1of1.done"));
  seen = 0;  // the records that are found decide it again
  result = fly_cases(options_of(folder, 100, 2), flies(fields_of_case), after_four);
  EXPECT_EQ(result.end, EngineEnd::kDecided);
  EXPECT_EQ(result.flown, 0U);
}

TEST(CampaignEngine, StopsBeforeItsTimeLimit) {
  VERIFIES("LASSO-GND-091~1");
  Quiet quiet;
  const ChunkFolder folder;
  EngineOptions options = options_of(folder, 100, 1);
  options.time_limit_s = 0.25;
  const auto begin = std::chrono::steady_clock::now();
  const EngineResult result = fly_cases(options, flies_in(std::chrono::milliseconds(60)), goes_on);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(400));
  EXPECT_EQ(result.end, EngineEnd::kTimeLimit);
  EXPECT_EQ(exit_code_of(result.end), 75);
  EXPECT_GT(result.flown, 0U);
  EXPECT_LE(result.flown, 4U);
  EXPECT_TRUE(folder.has("1of1.part"));
  EXPECT_NE(quiet.said().find("cases are done; the same command goes on"), std::string::npos);
}

TEST(CampaignEngine, SigtermKeepsTheCaseThatIsFlown) {
  VERIFIES("LASSO-GND-091~1");
  const ChunkFolder folder;
  const auto mark = folder.path() / "flying";
  const MakeFly slow = flies([&](std::uint32_t number) {
    std::ofstream{mark};
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return fields_of_case(number);
  });
  const pid_t process = start_engine(options_of(folder, 50, 2), slow);
  while (!std::filesystem::exists(mark)) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  kill(process, SIGTERM);
  const int status = status_of(process);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 75);
  EXPECT_GE(Records(folder.path(), kPlan, 50).done(), 1U);
  EXPECT_LE(Records(folder.path(), kPlan, 50).done(), 4U);
}

TEST(CampaignEngine, KilledAtRandomItGivesTheSameInTheEnd) {
  VERIFIES("LASSO-GND-090~1 LASSO-GND-091~1 LASSO-GND-062~1");
  constexpr int kKills = 100, kLeastKills = 20;
  constexpr std::uint32_t kCases = 3000;
  const ChunkFolder folder;
  std::chrono::duration<double> time_of_20 = std::chrono::hours(1);
  for (int i = 0; i < 3; ++i) {  // the shortest of three, on a machine that has other work
    const ChunkFolder trial;
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(status_of(start_engine(options_of(trial, 20, 2), flies_in(std::chrono::microseconds(500)))), 0);
    time_of_20 = std::min<std::chrono::duration<double>>(time_of_20, std::chrono::steady_clock::now() - begin);
  }
  test::Generator random(33);
  int kills = 0;
  for (bool killed = true; killed && kills < kKills; kills += killed ? 1 : 0) {
    const pid_t process = start_engine(options_of(folder, kCases, 2), flies_in(std::chrono::microseconds(500)));
    std::this_thread::sleep_for(random.uniform(0, 1) * time_of_20);
    kill(process, SIGKILL);
    killed = WIFSIGNALED(status_of(process));  // unless all cases are done: the machine has lost other work since the trials
  }
  EXPECT_GE(kills, kLeastKills);
  EXPECT_GT(Records(folder.path(), kPlan, kCases).done(), 0U);
  EXPECT_EQ(status_of(start_engine(options_of(folder, kCases, 2), flies(fields_of_case))), 0);
  EXPECT_EQ(merged(folder, kCases), undisturbed(kCases));
  EXPECT_FALSE(folder.has("1of1.damaged"));
}

TEST(CampaignEngine, MemoryOfAWorkerDoesNotGrow) {
  VERIFIES("LASSO-GND-091~1");
  Quiet quiet;
  const ChunkFolder folder;
  const Fly fly = [](std::uint32_t) {
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    return "ok," + std::to_string(use.ru_maxrss);  // KiB
  };
  fly_cases(options_of(folder, 5000, 1), flies(fly), goes_on);
  const Records records(folder.path(), kPlan, 5000);
  const auto kib_of = [&](std::uint32_t number) { return std::stol(std::string(records.of(number)->substr(3))); };
  EXPECT_LE(kib_of(4999), kib_of(500) + 512);
}

// What a worker sends is bounded: a record that was cut would be taken for a whole one.
TEST(CampaignEngine, ARecordThatIsTooLongFailsItsCase) {
  VERIFIES("LASSO-GND-062~1");
  const ChunkFolder folder;
  const Quiet quiet;
  const auto flown = flies([](std::uint32_t number) { return number == 1 ? "ok," + std::string(70000, '7') : fields_of_case(number); });
  fly_cases(options_of(folder, 3, 1), flown, goes_on);
  EXPECT_EQ(merged(folder, 3), fields_of_case(0) + "\nfailed:its record is too long: fly fewer frames a case\n" + fields_of_case(2) + "\n");
}

}  // namespace
}  // namespace lasso::mdat
