#include "ft/campaign/flight.hpp"

#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/run/case.hpp"

namespace lasso::campaign {
namespace {

void expect(Status status, const char* what) {
  if (status != Status::kOk) throw mdat::RunError(std::string("the component refuses ") + what + ": " + to_string(status));
}

}  // namespace

void begin(Component& component, Bytes image) {
  const LoadFailure failure = component.load_image(image);
  if (failure.status != Status::kOk) throw mdat::RunError(mdat::to_string(failure));
  expect(component.begin(mdat::kEpochUs), "to begin");
}

void start_tracking(Component& component, const Pose& T_sensor_target) {
  expect(component.start_tracking(T_sensor_target, {}, component.next_slot_us()), "a start");
}

void run_slot(Component& component) { static_cast<void>(step(component, component.next_slot_us())); }

std::vector<std::uint8_t> take_telemetry(Component& component) {
  std::vector<std::uint8_t> bytes(kTelemetryQueueBytes);
  bytes.resize(component.take_telemetry(Bytes(bytes.data(), bytes.size())));
  return bytes;
}

std::vector<std::uint8_t> run_frame(Component& component) {
  for (std::uint32_t slot = 0; slot < kSlotsPerFrame; ++slot) run_slot(component);
  return take_telemetry(component);
}

Decoded decode(ConstBytes stream) {
  Decoded decoded;
  while (!stream.empty()) {
    const std::size_t size = packet_size(stream);
    if (size == 0 || size > stream.size()) {
      ++decoded.broken;
      break;
    }
    PacketHeader header;
    PoseTelemetry pose;
    const PacketFault fault = decode_pose(stream.first(size), header, pose);
    if (fault == PacketFault::kNone) decoded.poses.push_back(pose);
    if (fault != PacketFault::kNone && fault != PacketFault::kUnknown) ++decoded.broken;  // unknown: an event, an answer
    stream = stream.subspan(size, stream.size() - size);
  }
  return decoded;
}

}  // namespace lasso::campaign
