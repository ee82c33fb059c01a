// golden_replay IMAGE TRACE TELEMETRY: runs the flight component on one thread against a trace (ft/golden/trace.hpp), writes its telemetry
// and says one line about it. Nothing here depends on the processor or the clock.
// Exit codes: 0 done, 1 the component left the trace or refused its input, 2 usage or unreadable files.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "fsw/core/crc.hpp"
#include "fsw/exec/component.hpp"
#include "fsw/link/packet.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "ft/golden/files.hpp"
#include "ft/golden/trace_sensor.hpp"

// Where an instruction counter (ft/ppc603e) begins and ends to count one estimate: addresses to find in the executable.
extern "C" {
[[gnu::noinline]] void lasso_estimate_begins() { asm volatile(""); }
[[gnu::noinline]] void lasso_estimate_ends() { asm volatile("" ::: "memory"); }
}

namespace lasso::golden {
namespace {

int fail(int code, const std::string& what) {
  std::fprintf(stderr, "golden_replay: %s\n", what.c_str());
  return code;
}

void run_frame(Component& component, std::vector<std::uint8_t>& telemetry) {
  do {
    component.run_slot(component.next_slot_us());
    if (!component.estimation_pending()) continue;
    lasso_estimate_begins();
    component.run_estimation();
    lasso_estimate_ends();
  } while (!component.next_slot_is_boundary());
  std::uint8_t buffer[kTelemetryQueueBytes];
  const std::size_t size = component.take_telemetry(Bytes(buffer));
  telemetry.insert(telemetry.end(), buffer, buffer + size);
}

Status begin(Component& component, Bytes image, const TraceHeader& header) {
  const LoadFailure failure = component.load_image(image);
  if (failure.status != Status::kOk) return failure.status;
  const Status begun = component.begin(header.boundary_0_us);
  if (begun != Status::kOk) return begun;
  return component.start_tracking(header.T_sensor_target, header.rates, header.t_us);
}

struct Tally {
  std::size_t poses = 0;
  std::size_t valid = 0;
  std::size_t returns = 0;
};

Tally tally(ConstBytes stream) {
  Tally result;
  while (!stream.empty()) {
    const ConstBytes packet = stream.first(packet_size(stream));
    PacketHeader header;
    PoseTelemetry pose;
    stream = stream.subspan(packet.size(), stream.size() - packet.size());
    const PacketFault fault = decode_pose(packet, header, pose);
    invariant(fault == PacketFault::kNone || fault == PacketFault::kUnknown, "telemetry that cannot be decoded");
    if (fault == PacketFault::kUnknown) continue;  // another structure
    ++result.poses;
    result.valid += pose.valid;
    result.returns += pose.returns;
  }
  return result;
}

int report(const char* name, const TracePlayer& player, ConstBytes telemetry) {
  if (!player.finished()) {
    return fail(1, "the component left the trace after scan " + std::to_string(player.scans()) + ", at byte " +
                       std::to_string(kTraceHeaderBytes + player.position()));
  }
  if (!write_file(name, telemetry)) return fail(2, std::string("cannot write ") + name);
  const Tally sum = tally(telemetry);
  std::printf("%zu poses, %zu valid, %zu returns a scan, %zu bytes, CRC-32C %08lX\n", sum.poses, sum.valid,
              sum.returns / std::max<std::size_t>(sum.poses, 1), telemetry.size(), 0UL + crc32c(telemetry));
  return 0;
}

int replay(const char* image_name, const char* trace_name, const char* telemetry_name) {
  File image, trace;
  if (!read_file(image_name, image)) return fail(2, std::string("cannot read ") + image_name);
  if (!read_file(trace_name, trace)) return fail(2, std::string("cannot read ") + trace_name);

  TraceHeader header;
  ByteReader in(trace.bytes());
  const Status readable = get(in, header);
  if (readable != Status::kOk) return fail(2, std::string(trace_name) + ": not a trace: " + to_string(readable));
  TracePlayer player(in.bytes(in.remaining()));

  const auto component = std::make_unique<Component>(player);
  const Status begun = begin(*component, image.bytes(), header);
  if (begun != Status::kOk) return fail(1, std::string("the component refused to begin: ") + to_string(begun));
  std::vector<std::uint8_t> telemetry;
  for (std::uint32_t frame = 0; frame < header.frames; ++frame) run_frame(*component, telemetry);
  return report(telemetry_name, player, ConstBytes(telemetry.data(), telemetry.size()));
}

}  // namespace
}  // namespace lasso::golden

int main(int argc, char** argv) {
  if (argc != 4) return lasso::golden::fail(2, "usage: golden_replay IMAGE TRACE TELEMETRY");
  return lasso::golden::replay(argv[1], argv[2], argv[3]);
}
