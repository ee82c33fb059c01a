#include "mdat/recording/background_recorder.hpp"

#include <utility>

namespace lasso::mdat {
namespace {

std::vector<std::uint8_t> copy_of(ConstBytes bytes) { return {bytes.begin(), bytes.end()}; }
ConstBytes view(const std::vector<std::uint8_t>& bytes) { return {bytes.data(), bytes.size()}; }

// What it throws; null: nothing.
std::exception_ptr failure_of(const std::function<void()>& call) {
  try {
    call();
  } catch (...) {
    return std::current_exception();
  }
  return nullptr;
}

}  // namespace

BackgroundRecorder::BackgroundRecorder(const std::filesystem::path& file, const CompiledMission& mission, const RecordingHead& head,
                                       std::shared_ptr<sim::SensorRecording> scans, RecordingContent content)
    : recorder_(file, mission, head, nullptr, content), scans_(std::move(scans)), thread_(&BackgroundRecorder::work, this) {}

BackgroundRecorder::~BackgroundRecorder() { end(); }

void BackgroundRecorder::on_packets(TimeUs boundary_us, ConstBytes packets) {
  later([this, boundary_us, bytes = copy_of(packets), scans = scans_.take(false)]() mutable {
    recorder_.on_packets(boundary_us, view(bytes));
    recorder_.on_scans(std::move(scans));
  });
}

void BackgroundRecorder::on_frame(const FlownFrame& frame) {
  later([this, telemetry = frame.telemetry, truth = frame.truth, samples = frame.samples] {
    recorder_.on_frame({telemetry, truth, samples});
  });
}

void BackgroundRecorder::on_commands(TimeUs slot_us, ConstBytes bytes) {
  later([this, slot_us, copy = copy_of(bytes)] { recorder_.on_commands(slot_us, view(copy)); });
}

void BackgroundRecorder::on_pair(const TakenPair& pair) {
  later([this, pair] { recorder_.on_pair(pair); });
}

void BackgroundRecorder::close(const std::vector<std::uint8_t>& image) {
  later([this, scans = scans_.take(true)]() mutable { recorder_.on_scans(std::move(scans)); });
  end();
  if (failure_) std::rethrow_exception(failure_);
  recorder_.close(image);
}

void BackgroundRecorder::later(Call call) {
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.size() < kMostWaiting || failure_; });
    if (failure_) std::rethrow_exception(failure_);
    waiting_.push_back(std::move(call));
  }
  changed_.notify_all();
}

void BackgroundRecorder::end() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

// A call stays among those that wait while it is made. What it held is given back before the lock is taken again.
void BackgroundRecorder::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!failure_) {
    changed_.wait(lock, [this] { return !waiting_.empty() || ending_; });
    if (waiting_.empty()) return;
    std::exception_ptr failure;
    {
      const Call call = std::move(waiting_.front());
      lock.unlock();
      failure = failure_of(call);
    }
    lock.lock();
    failure_ = failure;
    waiting_.pop_front();
    changed_.notify_all();
  }
}

}  // namespace lasso::mdat
