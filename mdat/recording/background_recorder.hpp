// A run's recorder in a thread of its own: the run goes on while its frames are put into messages, compressed and written.
//
// The file is that of a FrameRecorder, byte for byte: each call is kept with a copy of all that it was given, and made in the order of the
// run. kMostWaiting calls wait at most; then the run does. An InputError by which one of them failed is thrown in the run's thread, by the
// next call or by close().
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "mdat/recording/finished_scans.hpp"
#include "mdat/recording/frame_recorder.hpp"

namespace lasso::mdat {

constexpr std::size_t kMostWaiting = 16;  // calls: of some eight frames, of which one has 50 kB, with pictures 1 MB

class BackgroundRecorder final : public RunListener {
 public:
  // As a FrameRecorder.
  BackgroundRecorder(const std::filesystem::path& file, const CompiledMission& mission, const RecordingHead& head,
                     std::shared_ptr<sim::SensorRecording> scans, RecordingContent content = RecordingContent::kAll);
  // What waits is written first, as far as it can be.
  ~BackgroundRecorder() override;
  BackgroundRecorder(const BackgroundRecorder&) = delete;
  BackgroundRecorder& operator=(const BackgroundRecorder&) = delete;

  void on_packets(TimeUs boundary_us, ConstBytes packets) override;
  void on_frame(const FlownFrame& frame) override;
  void on_commands(TimeUs slot_us, ConstBytes bytes) override;
  void on_pair(const TakenPair& pair) override;
  // As FrameRecorder::close; the file has its end when this returns. Nothing is called after it.
  void close(const std::vector<std::uint8_t>& image);

 private:
  using Call = std::function<void()>;
  void later(Call call);
  void end();
  void work();

  FrameRecorder recorder_;  // of the thread alone
  FinishedScans scans_;     // of the run's thread
  std::mutex mutex_;        // guards what follows
  std::condition_variable changed_;
  std::deque<Call> waiting_;
  bool ending_ = false;
  std::exception_ptr failure_;  // of the first call that failed; those behind it are not made
  std::thread thread_;          // last: uses all of the above
};

}  // namespace lasso::mdat
