// Ten minutes of a flight, by the link alone: it is lost, carries garbage, and floods, again and again. The track is that of a flight whose
// link is quiet, to the bit, and each command gets its answer.
#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <set>

#include "fsw/exec/link_pump.hpp"
#include "fsw/link/command_rows.hpp"
#include "ft/campaign/flight.hpp"
#include "hal_sim/random.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/run/simulation.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::campaign {
namespace {

constexpr std::uint32_t kFrames = 3000;  // 10 minutes
constexpr std::uint32_t kCycle = 100;    // frames: quiet, lost, quiet, garbage, flood, quiet
constexpr double kPoints = 256;          // of a scan

// A stream of bytes that can be cut.
class TroubledLink final : public ByteLink {
 public:
  bool datagrams() const override { return false; }
  std::size_t read(Bytes out) override {
    std::size_t taken = 0;
    for (; !cut && taken < out.size() && !up.empty(); ++taken) {
      out[taken] = up.front();
      up.pop_front();
    }
    return taken;
  }
  std::size_t write(ConstBytes packets) override {
    if (cut) return 0;
    down.insert(down.end(), packets.begin(), packets.end());
    return packets.size();
  }
  bool cut = false;
  std::deque<std::uint8_t> up;
  std::vector<std::uint8_t> down;
};

const mdat::CompiledMission& hubble() {
  static const mdat::CompiledMission mission = mdat::compile_mission(std::string(LASSO_SOURCES) + "/cfg/missions/hubble_tenth.toml");
  return mission;
}

// A flight of the tenth-scale Hubble.
class Flight {
 public:
  Flight()
      : mission_(hubble()),
        scenario_(mdat::scenario_of(mission_.source, "spin")),
        parameters_(with_points(mdat::parameters_for(mission_.source, "spin"))),
        trajectory_(mdat::make_trajectory(scenario_, 4, mdat::kEpochUs, mdat::period_us(parameters_))),
        target_(mdat::make_target(mission_.mesh)),
        scanner_(*target_, *trajectory_, mdat::scanner_model(scenario_, parameters_, true), 7),
        component_(std::make_unique<Component>(scanner_)),
        pump_(*component_, link) {
    const std::vector<std::uint8_t> bytes = mdat::image_bytes(mission_, parameters_);
    image_ = mdat::aligned_copy(bytes);
    begin(*component_, mdat::view(image_, bytes.size()));
    start_tracking(*component_, trajectory_->at(mdat::kEpochUs).T_sensor_target);
  }

  void run_frame() {
    for (std::uint32_t slot = 0; slot < kSlotsPerFrame; ++slot) {
      pump_.receive(component_->next_slot_us());
      run_slot(*component_);
      pump_.send();
    }
  }

  TroubledLink link;

 private:
  static MissionParameters with_points(MissionParameters parameters) {
    parameters.points = kPoints;
    return parameters;
  }
  const mdat::CompiledMission& mission_;
  const mdat::Scenario& scenario_;
  MissionParameters parameters_;
  std::unique_ptr<sim::Trajectory> trajectory_;
  std::unique_ptr<sim::RayCaster> target_;
  sim::SimulatedScanner scanner_;
  std::vector<std::uint64_t> image_;
  std::unique_ptr<Component> component_;
  LinkPump pump_;
};

// The ground: commands up, and what came down.
class Ground {
 public:
  explicit Ground(TroubledLink& link) : link_(link) {}

  void send_ping() {
    const PacketRow& row = command_rows::row_of(CommandKind::kPing);
    std::uint8_t packet[kMaxCommandBytes];
    ByteWriter writer{Bytes(packet)};
    begin_command({kApid, count_, kAcknowledgeCompletion, row.service, row.subservice, 0}, writer);
    const std::size_t size = finish_packet(writer, Bytes(packet));
    link_.up.insert(link_.up.end(), packet, packet + size);
    count_ = static_cast<std::uint16_t>((count_ + 1) & kSequenceCountMask);
    ++sent;
  }
  void send_garbage(std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i) link_.up.push_back(static_cast<std::uint8_t>(random_.uniform() * 256));
  }
  // Packets that came whole.
  void take() {
    ConstBytes stream(link_.down.data(), link_.down.size());
    while (stream.size() >= kPrimaryHeaderBytes && packet_size(stream) <= stream.size()) {
      const ConstBytes packet = stream.first(packet_size(stream));
      if (packet[7] == kServiceVerification) ++(packet[8] == kSubserviceCompleted ? completed : refused);
      for (const PoseTelemetry& pose : decode(packet).poses) poses[pose.scan_id] = pose;
      stream = stream.subspan(packet.size(), stream.size() - packet.size());
    }
    link_.down.erase(link_.down.begin(), link_.down.end() - static_cast<std::ptrdiff_t>(stream.size()));
  }

  std::uint32_t sent = 0, completed = 0, refused = 0;
  std::map<std::uint32_t, PoseTelemetry> poses;

 private:
  TroubledLink& link_;
  std::uint16_t count_ = 0;
  sim::Random random_ = sim::ray_stream(29, 0, 0);
};

// What the ground and the link do in a frame; without trouble one command a frame comes.
void disturb(std::uint32_t frame, Ground& ground, TroubledLink& link) {
  const std::uint32_t at = frame % kCycle;
  link.cut = at >= 5 && at < 20;
  if (at >= 25 && at < 40) {
    ground.send_garbage(300);
    ground.send_ping();
    ground.send_garbage(200);
  }
  for (std::uint32_t i = 0; at >= 45 && at < 50 && i < 10 * kMaxCommandsPerFrame; ++i) ground.send_ping();
}

// How many valid poses came, each as it came without trouble, to the bit.
std::size_t compare(const Ground& ground, const Ground& observer) {
  std::size_t valid = 0, different = 0;
  for (const auto& [scan, pose] : ground.poses) {
    const PoseTelemetry& other = observer.poses.at(scan);
    const bool same =
        pose.valid == other.valid &&
        std::memcmp(pose.filter_p_sensor_target_m, other.filter_p_sensor_target_m, sizeof pose.filter_p_sensor_target_m) == 0 &&
        std::memcmp(pose.q_sensor_target, other.q_sensor_target, sizeof pose.q_sensor_target) == 0;
    different += same ? 0U : 1U;
    valid += pose.valid;
  }
  EXPECT_EQ(different, 0U);
  return valid;
}

TEST(TroubledLinkFlight, TenMinutesOfLossGarbageAndFloodsLeaveTheTrackAsItIs) {
  VERIFIES("LASSO-LNK-029~1");
  Flight quiet, troubled;
  Ground observer(quiet.link), ground(troubled.link);
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    disturb(frame, ground, troubled.link);
    quiet.run_frame();
    troubled.run_frame();
    observer.take();
    ground.take();
  }
  EXPECT_EQ(ground.sent, kFrames / kCycle * (15 + 5 * 10 * kMaxCommandsPerFrame));
  EXPECT_EQ(ground.completed, ground.sent) << "every valid command is carried out";
  EXPECT_EQ(observer.poses.size(), kFrames - kPipelineFrames);
  EXPECT_GT(ground.poses.size(), kFrames * 9 / 10) << "but those for which the queue had no room while the link was lost";
  const std::size_t valid = compare(ground, observer);
  EXPECT_GT(valid, ground.poses.size() - 10);
  std::printf("%u commands in 10 minutes: %u completed, %u bytes of noise answered by %u refusals; %zu of %zu poses came\n", ground.sent,
              ground.completed, kFrames / kCycle * 15 * 500, ground.refused, ground.poses.size(), observer.poses.size());
}

}  // namespace
}  // namespace lasso::campaign
