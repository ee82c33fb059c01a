#include "bsp/posix/runner.hpp"

#include <chrono>
#include <cstdio>
#include <ctime>
#include <thread>

#include "fsw/core/crc.hpp"
#include "ut/exec/component_scene.hpp"

namespace lasso::posix {
namespace {

constexpr int kFrames = 25;

std::vector<std::uint8_t> single_threaded() {
  test::ComponentScene scene(test::box_parameters(test::default_scene()));
  scene.begin();
  for (int frame = 0; frame < kFrames; ++frame) scene.run_frame();
  return scene.stream;
}

std::vector<std::uint8_t> flown(Pace pace) {
  test::ComponentScene scene(test::box_parameters(test::default_scene()));
  scene.begin();
  Runner runner(*scene.component, pace);
  std::vector<std::uint8_t> stream;
  for (int frame = 0; frame < kFrames; ++frame) {
    const FrameRecord record = runner.run_frame();
    stream.insert(stream.end(), record.telemetry.begin(), record.telemetry.end());
  }
  return stream;
}

TEST(Runner, TwoThreadsGiveTheBytesOfOne) {
  VERIFIES("LASSO-EXE-012~2 LASSO-SYS-027~1");
  const std::vector<std::uint8_t> expected = single_threaded();
  ASSERT_EQ(test::decode_all(ConstBytes(expected.data(), expected.size())).size(), kFrames - 2u);
  // The same on every processor: to be compared between host and target.
  std::printf("CRC-32C of the telemetry: %08lX\n", 0UL + crc32c(ConstBytes(expected.data(), expected.size())));
  for (int repetition = 0; repetition < 3; ++repetition) ASSERT_EQ(flown(Pace::kLockstep), expected) << repetition;
  EXPECT_EQ(flown(Pace::kAlone), expected);
}

class RunnerOfEachPace : public testing::TestWithParam<Pace> {};

TEST_P(RunnerOfEachPace, MeasuresTheEstimateThatEachFrameReports) {
  VERIFIES("LASSO-EXE-011~2 LASSO-EXE-013~1");
  test::ComponentScene scene(test::box_parameters(test::default_scene()));
  scene.begin();
  Runner runner(*scene.component, GetParam());
  for (std::uint32_t frame = 0; frame < 10; ++frame) {
    const FrameRecord record = runner.run_frame();
    EXPECT_EQ(record.frame, frame);
    EXPECT_EQ(record.boundary_us, frame * 200000);
    EXPECT_EQ(record.estimated, frame >= 2);
    EXPECT_EQ(test::decode_all(record.telemetry).empty(), frame < 2);
    if (record.estimated) {
      EXPECT_GT(record.estimate_cpu_ns, 0);
      EXPECT_LT(record.estimate_cpu_ns, record.estimate_wall_ns + 1000000);
    }
  }
}

// Five frames of 20 s each.
TEST_P(RunnerOfEachPace, SimulatedTimeDoesNotWaitForTheClock) {
  VERIFIES("LASSO-EXE-011~2");
  MissionParameters parameters = test::box_parameters(test::default_scene());
  parameters.period_s = 20;
  test::ComponentScene scene(parameters);
  scene.begin();
  Runner runner(*scene.component, GetParam());
  const auto start = std::chrono::steady_clock::now();
  for (std::uint32_t frame = 0; frame < 5; ++frame) EXPECT_EQ(runner.run_frame().boundary_us, frame * 20'000'000LL);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 50);
}

INSTANTIATE_TEST_SUITE_P(WithAWorkerAndWithout, RunnerOfEachPace, testing::Values(Pace::kLockstep, Pace::kAlone));

std::int64_t clock_ns(clockid_t clock) {
  timespec now{};
  EXPECT_EQ(clock_gettime(clock, &now), 0);
  const std::int64_t seconds = now.tv_sec;
  return 1'000'000'000 * seconds + now.tv_nsec;
}
// Of all threads but this one.
std::int64_t others_ns() { return clock_ns(CLOCK_PROCESS_CPUTIME_ID) - clock_ns(CLOCK_THREAD_CPUTIME_ID); }

// The worker does nothing but estimate, and no other thread does anything: what the others take is what the estimates take. The last
// estimate is no longer reported.
TEST(Runner, ProcessorTimeIsThatOfTheWorker) {
  VERIFIES("LASSO-EXE-013~1");
  test::ComponentScene scene(test::box_parameters(test::default_scene()));
  scene.begin();
  Runner runner(*scene.component);
  const std::int64_t began_ns = clock_ns(CLOCK_MONOTONIC), before_ns = others_ns();
  std::int64_t cpu_ns = 0, wall_ns = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const FrameRecord record = runner.run_frame();
    cpu_ns += record.estimate_cpu_ns;
    wall_ns += record.estimate_wall_ns;
  }
  constexpr std::int64_t kRounding_ns = 10'000'000;
  const std::int64_t taken_ns = others_ns() - before_ns;
  EXPECT_GT(cpu_ns, taken_ns / 2);
  EXPECT_LT(cpu_ns, taken_ns + kRounding_ns);
  EXPECT_GT(wall_ns + kRounding_ns, cpu_ns);
  EXPECT_LE(wall_ns, clock_ns(CLOCK_MONOTONIC) - began_ns);
}

TEST(Runner, RealTimeKeepsItsPace) {
  VERIFIES("LASSO-EXE-011~2");
  MissionParameters parameters = test::box_parameters(test::default_scene());
  parameters.period_s = 0.1;
  parameters.duration_s = 0.09;
  test::ComponentScene scene(parameters);
  scene.begin();
  Runner runner(*scene.component, Pace::kRealTime);
  const auto start = std::chrono::steady_clock::now();
  std::size_t packets = 0;
  for (int frame = 0; frame < 10; ++frame) packets += test::decode_all(runner.run_frame().telemetry).size();
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GE(elapsed_s, 0.995);  // from boundary 0 to the last slot of frame 9
  EXPECT_LT(elapsed_s, 5.0);    // a busy machine may be late, and catches up
  EXPECT_EQ(packets, 8u);
}

// A machine that stands still for a second stretches the time of the run. It makes up for 20 ms of that, and loses no scan.
TEST(Runner, APacedRunGivesTheBytesOfLockstepHoweverLateTheMachineIs) {
  VERIFIES("LASSO-EXE-011~2 LASSO-EXE-012~2");
  const std::vector<std::uint8_t> expected = single_threaded();
  test::ComponentScene scene(test::box_parameters(test::default_scene()));
  scene.begin();
  Runner runner(*scene.component, Pace::kPaced);
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::uint8_t> stream;
  for (int frame = 0; frame < kFrames; ++frame) {
    const FrameRecord record = runner.run_frame();
    stream.insert(stream.end(), record.telemetry.begin(), record.telemetry.end());
    if (frame == 7) std::this_thread::sleep_for(std::chrono::seconds(1));
  }
  EXPECT_EQ(stream, expected);
  EXPECT_GE(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 0.2 * kFrames - 0.02 + 0.98 - 0.02);
}

// At the shortest period and the largest scan, whether an estimate is late is up to the machine. Either way each scan is reported once, a
// late one says so, and no pose comes from half an estimate.
TEST(Runner, RealTimeReportsEachScanOnceLateOrNot) {
  VERIFIES("LASSO-EXE-003~1");
  MissionParameters parameters = test::box_parameters(test::default_scene());
  parameters.period_s = 0.01;
  parameters.duration_s = 0.009;
  parameters.points = 4096;
  parameters.iterations_max = 50;
  parameters.start_frames = 1000;
  parameters.coast_frames = 1000;
  test::ComponentScene scene(parameters);
  scene.begin();
  Runner runner(*scene.component, Pace::kRealTime);
  std::uint32_t reports = 0;
  std::uint32_t late = 0;
  for (int frame = 0; frame < 50; ++frame) {
    for (const test::Report& report : test::decode_all(runner.run_frame().telemetry)) {
      EXPECT_EQ(report.pose.scan_id, reports);  // one for each scan, late or not
      ++reports;
      late += report.pose.reason == static_cast<std::uint8_t>(PoseReason::kOverrun) ? 1u : 0u;
      EXPECT_EQ(report.pose.overruns, late);
      if (report.pose.valid == 1) {
        EXPECT_LT(scene.error(report.pose).norm(), 1e-2);
      }
    }
  }
  EXPECT_EQ(reports, 48u);
}

}  // namespace
}  // namespace lasso::posix
