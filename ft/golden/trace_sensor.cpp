#include "ft/golden/trace_sensor.hpp"

#include <algorithm>

namespace lasso::golden {

Status TraceRecorder::start(const ScanPlan& plan, TimeUs t_start_us) {
  std::uint8_t buffer[kMaxCallBytes];
  ByteWriter out{Bytes(buffer)};
  const Status status = sensor_.start(plan, t_start_us);
  put_start(out, plan, t_start_us);
  out.u8(static_cast<std::uint8_t>(status));
  append(out.written());
  return status;
}

SensorPoll TraceRecorder::poll(TimeUs now_us, Span<RangeSample> samples) {
  std::uint8_t buffer[kMaxCallBytes];
  ByteWriter out{Bytes(buffer)};
  const SensorPoll poll = sensor_.poll(now_us, samples);
  put_poll(out, now_us, samples.size());
  put_answer(out, poll, samples.first(poll.count));
  invariant(out.ok(), "more samples than one poll may have");
  append(out.written());
  return poll;
}

void TraceRecorder::abort() {
  std::uint8_t buffer[kMaxCallBytes];
  ByteWriter out{Bytes(buffer)};
  sensor_.abort();
  put_abort(out);
  append(out.written());
}

bool TracePlayer::next_is(ConstBytes call) {
  if (differs_) return false;
  ByteReader ahead = calls_;
  const ConstBytes expected = ahead.bytes(call.size());
  differs_ = !ahead.ok() || !std::equal(call.begin(), call.end(), expected.begin());
  if (!differs_) calls_ = ahead;
  return !differs_;
}

Status TracePlayer::start(const ScanPlan& plan, TimeUs t_start_us) {
  std::uint8_t buffer[kMaxCallBytes];
  ByteWriter call{Bytes(buffer)};
  put_start(call, plan, t_start_us);
  if (!next_is(call.written())) return Status::kTimeout;
  ++scans_;
  return static_cast<Status>(calls_.u8());
}

SensorPoll TracePlayer::poll(TimeUs now_us, Span<RangeSample> samples) {
  SensorPoll poll;
  std::uint8_t buffer[kMaxCallBytes];
  ByteWriter call{Bytes(buffer)};
  put_poll(call, now_us, samples.size());
  if (next_is(call.written())) differs_ = !get_answer(calls_, poll, samples);
  if (!differs_) return poll;
  poll = SensorPoll{};
  poll.status = Status::kTimeout;
  return poll;
}

void TracePlayer::abort() {
  std::uint8_t buffer[kMaxCallBytes];
  ByteWriter call{Bytes(buffer)};
  put_abort(call);
  static_cast<void>(next_is(call.written()));
}

}  // namespace lasso::golden
