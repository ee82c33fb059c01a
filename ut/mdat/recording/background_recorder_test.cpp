#include "mdat/recording/background_recorder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <atomic>
#include <csignal>
#include <future>

#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"
#include "ut/mdat/link/some_telemetry.hpp"
#include "ut/mdat/recording/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr TimeUs kNoisyFrame_us = 500'000;
constexpr std::size_t kRays = 400;

// A square plate, and a sensor that the defaults describe.
CompiledMission plate() {
  CompiledMission mission;
  mission.mesh.vertices = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)};
  mission.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mission;
}

// Frames of noise, which no compression makes small, and all other calls that a run makes.
class NoisyRun {
 public:
  std::shared_ptr<sim::SensorRecording> scans = std::make_shared<sim::SensorRecording>();

  template <class Recorder>
  void fly(Recorder& recorder, int frames) {
    for (int i = 0; i < frames; ++i) {
      const std::vector<RangeSample> samples = scan();
      PoseTelemetry pose;
      pose.t_measurement_us = t_us_ += kNoisyFrame_us;
      pose.p_sensor_target_m[2] = 4;
      pose.valid = 1;
      scans->emplace_back();
      scans->back().t_start_us = t_us_;
      scans->back().samples = samples;
      const std::vector<std::uint8_t> packet = pose_packet(pose, PacketHeader{});
      recorder.on_commands(t_us_, {packet.data(), packet.size()});
      recorder.on_packets(t_us_, {packet.data(), packet.size()});
      recorder.on_frame({pose, {small_pose(to_seconds(t_us_)), {}}, samples});
      if (i % 5 == 0) recorder.on_pair({t_us_, {}, "left", "right"});
      ++flown;
    }
  }
  std::atomic<int> flown{0};

 private:
  std::vector<RangeSample> scan() {
    std::vector<RangeSample> samples(kRays);
    for (RangeSample& sample : samples) {
      const Vec3 direction = Vec3(random_.uniform(-0.3, 0.3), random_.uniform(-0.3, 0.3), 1).normalized();
      for (int k = 0; k < 3; ++k) sample.direction[k] = static_cast<float>(direction[k]);
      sample.state = static_cast<RayState>(random_.bits() % 4);
      sample.range_m = static_cast<float>(random_.uniform(1, 9));
      sample.t_us = t_us_ + kNoisyFrame_us;
    }
    return samples;
  }
  sim::Random random_{7};
  TimeUs t_us_ = 0;
};

class BackgroundRecorderTest : public SmallRecording {
 protected:
  // By the run's own thread.
  std::string plain(int frames, RecordingContent content = RecordingContent::kAll) {
    NoisyRun run;
    FrameRecorder recorder(file("plain.mcap"), mission_, {}, run.scans, content);
    run.fly(recorder, frames);
    recorder.close({1, 2, 3});
    return bytes_of(file("plain.mcap"));
  }
  CompiledMission mission_ = plate();
};

// More frames than wait at most, in more than one chunk.
TEST_F(BackgroundRecorderTest, WritesTheFileThatTheRunsOwnThreadWrites) {
  VERIFIES("LASSO-REC-046~1 LASSO-REC-001~1 LASSO-REC-020~1");
  for (const RecordingContent content : {RecordingContent::kAll, RecordingContent::kReplay}) {
    NoisyRun run;
    BackgroundRecorder recorder(file("run.mcap"), mission_, {}, run.scans, content);
    run.fly(recorder, 120);
    recorder.close({1, 2, 3});
    const std::string expected = plain(120, content);
    EXPECT_GT(expected.size(), mcap::kChunkBytes / 2);
    EXPECT_TRUE(bytes_of(file("run.mcap")) == expected);
  }
}

// A run that an error ends closes nothing: the chunks that were full by then are in the file, as they were before.
TEST_F(BackgroundRecorderTest, WritesWhatWaitsWhereTheRunEndsByAnError) {
  VERIFIES("LASSO-REC-046~1 LASSO-REC-006~1");
  {
    NoisyRun run, plain_run;
    BackgroundRecorder recorder(file("run.mcap"), mission_, {}, run.scans);
    FrameRecorder plain_recorder(file("plain.mcap"), mission_, {}, plain_run.scans);
    run.fly(recorder, 60);
    plain_run.fly(plain_recorder, 60);
  }
  EXPECT_GT(bytes_of(file("plain.mcap")).size(), mcap::kChunkBytes / 2);
  EXPECT_TRUE(bytes_of(file("run.mcap")) == bytes_of(file("plain.mcap")));
}

// Files of this program may not grow beyond some bytes, while this lives.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    before_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    (void)getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limited = before_;
    limited.rlim_cur = bytes;
    (void)setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~FullDisk() {
    (void)setrlimit(RLIMIT_FSIZE, &before_);
    (void)std::signal(SIGXFSZ, before_handler_);
  }

 private:
  rlimit before_{};
  void (*before_handler_)(int) = nullptr;
};

template <class Call>
std::string input_error_of(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(BackgroundRecorderTest, ThrowsInTheRunWhatTheDiskRefuses) {
  VERIFIES("LASSO-REC-046~1");
  const FullDisk full(400'000);
  NoisyRun plain_run, run;
  const std::string expected = input_error_of([&] {
    FrameRecorder recorder(file("run.mcap"), mission_, {}, plain_run.scans);
    plain_run.fly(recorder, 100);
  });
  EXPECT_NE(expected.find("run.mcap: cannot be written: "), std::string::npos) << expected;
  BackgroundRecorder recorder(file("run.mcap"), mission_, {}, run.scans);
  EXPECT_EQ(input_error_of([&] { run.fly(recorder, 100); }), expected);
  EXPECT_LE(run.flown, plain_run.flown + static_cast<int>(kMostWaiting));
  EXPECT_EQ(input_error_of([&] { recorder.close({}); }), expected) << "again";
}

// What the last frames leave is written when the file is closed.
TEST_F(BackgroundRecorderTest, ThrowsAtItsEndWhatTheDiskRefusesThere) {
  VERIFIES("LASSO-REC-046~1");
  NoisyRun run;
  const FullDisk full(20'000);
  BackgroundRecorder recorder(file("run.mcap"), mission_, {}, run.scans);
  run.fly(recorder, 2);
  EXPECT_NE(input_error_of([&] { recorder.close({}); }).find("run.mcap: cannot be written: "), std::string::npos);
}

// The file is a pipe that nobody empties for a while: a disk that stands still. The run waits for it, and nothing is lost.
TEST_F(BackgroundRecorderTest, LetsTheRunWaitForADiskThatIsSlow) {
  VERIFIES("LASSO-REC-046~1");
  constexpr int kFrames = 150;
  const std::string expected = plain(kFrames);
  const std::string pipe = file("pipe").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::promise<void> go;
  std::future<std::string> read = std::async(std::launch::async, [&] {
    std::ifstream in(pipe, std::ios::binary);
    go.get_future().wait();
    return std::string(std::istreambuf_iterator<char>(in), {});
  });
  NoisyRun run;
  BackgroundRecorder recorder(pipe, mission_, {}, run.scans);
  std::future<void> flight = std::async(std::launch::async, [&] { run.fly(recorder, kFrames); });
  EXPECT_EQ(flight.wait_for(std::chrono::milliseconds(500)), std::future_status::timeout);
  EXPECT_LT(run.flown, kFrames);
  go.set_value();
  flight.get();
  recorder.close({1, 2, 3});
  EXPECT_TRUE(read.get() == expected);
}

}  // namespace
}  // namespace lasso::mdat
