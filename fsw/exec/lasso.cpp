#include "fsw/exec/lasso.hpp"

#include <new>

namespace lasso {
namespace {

// Is there a sensor at all, and none of them null? Loop bound: kMaxSensors.
bool has_sensors(const SensorBank& sensors) {
  for (const Sensor* sensor : sensors) {
    if (sensor == nullptr) return false;
  }
  return !sensors.empty();
}

}  // namespace

Component* create(void* memory, std::size_t size, const SensorBank& sensors, const Identity& identity) {
  if (memory == nullptr || size < required_memory() || !has_sensors(sensors) || !is_valid(identity)) return nullptr;
  if (reinterpret_cast<std::uintptr_t>(memory) % required_alignment() != 0) return nullptr;
  return new (memory) Component(sensors, identity);
}

Component* create(void* memory, std::size_t size, Sensor& sensor, const Identity& identity) {
  return create(memory, size, only(sensor), identity);
}

Status use_memory(Component& component, const BoardMemory& memory) { return component.use_memory(memory); }

void set_watchdog(Component& component, Watchdog& watchdog) { component.set_watchdog(watchdog); }

void set_reset_cause(Component& component, ResetCause cause) { component.set_reset_cause(cause); }

void use_authenticator(Component& component, Authenticator& authenticator) { component.use_authenticator(authenticator); }

void authenticate_images(Component& component, Authenticator& authenticator) { component.authenticate_images(authenticator); }

void accept_unsigned_images(Component& component) { component.accept_unsigned_images(); }

LoadFailure load_stored_image(Component& component) { return component.load_stored_image(); }

LoadFailure load_image(Component& component, Bytes image) { return component.load_image(image); }

Status begin(Component& component, TimeUs boundary_0_us) { return component.begin(boundary_0_us); }

Status start_tracking(Component& component, const Pose& T_sensor_target, const Twist& rates, TimeUs t_us) {
  return component.start_tracking(T_sensor_target, rates, t_us);
}

Status stop_tracking(Component& component) { return component.stop_tracking(); }

StartRefusal offer_start(Component& component, InitialPoseSource source, const StartOffer& offer) {
  return component.offer_start(source, offer);
}

ModeRefusal command_mode(Component& component, TrackingMode mode) { return component.command_mode(mode); }

void hold_mode(Component& component, bool held) { component.hold_mode(held); }

std::size_t receive(Component& component, ConstBytes bytes, TimeUs now_us) { return component.receive(bytes, now_us); }

bool receive_packet(Component& component, ConstBytes packet, TimeUs now_us) { return component.receive_packet(packet, now_us); }

std::size_t take_telemetry(Component& component, Bytes out) { return component.take_telemetry(out); }

bool step(Component& component, TimeUs now_us) {
  if (!component.slot_is_due(now_us)) return false;
  component.run_slot(now_us);
  component.run_estimation();
  return true;
}

TimeUs next_slot_us(const Component& component) { return component.next_slot_us(); }

bool reset_due(const Component& component) { return component.reset_due(); }

}  // namespace lasso
