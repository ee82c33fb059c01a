#include "ft/pil/world.hpp"

#include <algorithm>
#include <utility>

#include "fsw/core/invariant.hpp"
#include "fsw/exec/executive.hpp"
#include "mdat/link/command_encoder.hpp"

namespace lasso::pil {
namespace {

constexpr std::uint32_t kPingFrames = 50;

sim::ScannerModel model_of(const mdat::CaseSetup& setup) { return mdat::scanner_model(setup.scenario, setup.parameters, setup.noise); }

void append(Packet& to, const Packet& packet) { to.insert(to.end(), packet.begin(), packet.end()); }

// The end of a packet, and one of whose bits one is wrong.
Packet noise() {
  Packet ping = mdat::encode_command(mdat::command_row("ping"), {}, 0);
  Packet bytes(ping.begin() + kPrimaryHeaderBytes, ping.end());
  ping.back() ^= 1;
  append(bytes, ping);
  return bytes;
}

}  // namespace

World::World(const WorldSetup& setup, lcs::HeadMemory* head)
    : setup_(setup),
      period_us_(mdat::period_us(setup.flight.parameters)),
      motion_(mdat::make_trajectory(setup.flight.scenario, setup.flight.range_m, mdat::kEpochUs, period_us_)),
      camera_(mdat::camera_for(setup.flight, model_of(setup.flight), 0)),
      device_(*setup.flight.target, *motion_, model_of(setup.flight), setup.flight.seed, camera_),
      own_head_(*setup.flight.target, *motion_, model_of(setup.flight), setup.flight.seed, camera_),
      head_(head) {}

TimeUs World::slot_us(std::uint32_t slot) const {
  const TimeUs boundary_us = mdat::kEpochUs + slot / kSlotsPerFrame * period_us_;
  return boundary_us + slot % kSlotsPerFrame * period_us_ / kSlotsPerFrame;
}

void World::move_to(std::uint32_t slot, ConstBytes to_camera) {
  invariant(line_.to_camera.write(to_camera) == to_camera.size(), "more bytes than the camera's line carries in a slot");
  if (head_ != nullptr) own_head_.run(slot_us(slot), *head_);
  if (head_ == nullptr && slot > 0) device_.listen(slot_us(slot - 1), line_);
  if (head_ == nullptr) device_.run(slot_us(slot), line_);
  if (slot == 0) {
    if (setup_.ground_noise) append(ground_, noise());
    append(ground_, mdat::arm_for(mdat::command_row("enable_laser"), commands_++));
    append(ground_, mdat::encode_command(mdat::command_row("enable_laser"), {}, commands_++));
  } else if (slot % (kPingFrames * kSlotsPerFrame) == 7) {
    append(ground_, mdat::encode_command(mdat::command_row("ping"), {}, commands_++));
  }
}

Packet World::from_camera() {
  Packet bytes(lcs::kLineBytes);
  bytes.resize(line_.from_camera.read(Bytes(bytes.data(), bytes.size())));
  const std::uint64_t room = setup_.camera_bytes.value_or(carried_ + bytes.size()) - carried_;
  bytes.resize(std::min<std::uint64_t>(bytes.size(), room));
  carried_ += bytes.size();
  return bytes;
}

Packet World::from_ground() { return std::exchange(ground_, {}); }

}  // namespace lasso::pil
