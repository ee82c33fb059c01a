// The component for those who build it into a program of their own: a few functions, no threads, memory that the caller owns.
// docs/embedding/ shows a whole host program. Boards with two threads use Component itself (fsw/exec/component.hpp).
#pragma once

#include <cstddef>

#include "fsw/exec/component.hpp"
#include "fsw/exec/report.hpp"

namespace lasso {

// The memory that create() needs, image apart, and its alignment: `alignas(required_alignment()) std::uint8_t memory[required_memory()]`.
constexpr std::size_t required_memory() { return sizeof(Component); }
constexpr std::size_t required_alignment() { return alignof(Component); }

// A component in `memory`; null when it is too small or not aligned, there is no sensor, one of them is null, or no
// component can have this identity. There is
// nothing to destroy: the memory may be reused at any time. The sensors, in the order of the mission's, and `memory` outlive it.
Component* create(void* memory, std::size_t size, const SensorBank& sensors, const Identity& identity = {});
Component* create(void* memory, std::size_t size, Sensor& sensor, const Identity& identity = {});

// See the functions of the same name of Component. What a board gives, before begin(): memory for images in flight (before the first
// image), a watchdog, the reason of the start, and who says that a command or an image is authentic (before the first image).
Status use_memory(Component& component, const BoardMemory& memory);
void set_watchdog(Component& component, Watchdog& watchdog);
void set_reset_cause(Component& component, ResetCause cause);
void use_authenticator(Component& component, Authenticator& authenticator);
void authenticate_images(Component& component, Authenticator& authenticator);
void accept_unsigned_images(Component& component);
LoadFailure load_stored_image(Component& component);
LoadFailure load_image(Component& component, Bytes image);
Status begin(Component& component, TimeUs boundary_0_us);
Status start_tracking(Component& component, const Pose& T_sensor_target, const Twist& rates, TimeUs t_us);
Status stop_tracking(Component& component);
StartRefusal offer_start(Component& component, InitialPoseSource source, const StartOffer& offer);
ModeRefusal command_mode(Component& component, TrackingMode mode);
void hold_mode(Component& component, bool held);
// Bytes from the ground; see Component::receive and receive_packet.
std::size_t receive(Component& component, ConstBytes bytes, TimeUs now_us);
bool receive_packet(Component& component, ConstBytes packet, TimeUs now_us);
std::size_t take_telemetry(Component& component, Bytes out);

// Runs the next slot, and the estimate that it may leave pending, if the slot's time has come at now_us. False, and nothing has
// happened, when it has not, or before begin(). Call it until it says false.
bool step(Component& component, TimeUs now_us);
// When the next slot's time comes: until then a host may sleep.
TimeUs next_slot_us(const Component& component);
// A command has asked for a reset, and its frame is over: take the telemetry, and create a component anew with ResetCause::kCommanded.
bool reset_due(const Component& component);

}  // namespace lasso
