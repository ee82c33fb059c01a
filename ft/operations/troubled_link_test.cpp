// Ten minutes of a flight, by the link alone: it is lost, carries garbage, and floods, again and again. The track is that of a flight whose
// link is quiet, to the bit, and each command gets its answer.
#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "cfg/capacities.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "ft/campaign/linked_flight.hpp"
#include "hal_sim/random.hpp"
#include "mdat/link/command_encoder.hpp"
#include "mdat/link/decode.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

using campaign::LinkedFlight;

constexpr std::uint32_t kFrames = 3000;    // 10 minutes
constexpr std::uint32_t kCycle = 100;      // frames: quiet, lost, quiet, garbage, flood, quiet
constexpr double kStartVariance = 0.0025;  // (3 degrees)^2, (5 cm)^2: a guess from pictures
constexpr std::uint32_t kDelayed = 2;      // scan k is reported at boundary k + 2

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

// The ground: commands up, and what came down.
class Ground {
 public:
  explicit Ground(TroubledLink& link) : link_(link) {}

  void send(const std::string& name, const std::map<std::string, std::string>& items = {}) {
    const std::vector<std::uint8_t> packet = mdat::encode_command(mdat::command_row(name), items, count_);
    link_.up.insert(link_.up.end(), packet.begin(), packet.end());
    count_ = static_cast<std::uint16_t>((count_ + 1) & kSequenceCountMask);
    ++sent;
  }
  void send_start() {
    const Pose pose = LinkedFlight::first_T_sensor_target();
    send("offer_start", {{"start_source", "uplink"},
                         {"t_us", std::to_string(LinkedFlight::first_us())},
                         {"q_sensor_target", list({pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()})},
                         {"p_sensor_target_m", list({pose.p.x(), pose.p.y(), pose.p.z()})},
                         {"omega_radps", "0,0,0"},
                         {"v_mps", "0,0,0"},
                         {"covariance", diagonal()}});
  }
  void send_garbage(std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i) link_.up.push_back(static_cast<std::uint8_t>(random_.uniform() * 256));
  }
  // Packets that came whole.
  void take() {
    const mdat::DecodedStream stream = mdat::decode_stream({link_.down.data(), link_.down.size()}, PacketType::kTelemetry);
    std::size_t end = 0;
    for (const mdat::DecodedPacket& packet : stream.packets) {
      note(packet);
      end = packet.offset + packet.bytes.size();
    }
    link_.down.erase(link_.down.begin(), link_.down.begin() + static_cast<std::ptrdiff_t>(end));
  }

  std::uint32_t sent = 0, completed = 0, refused = 0;
  std::map<std::uint32_t, PoseTelemetry> poses;

 private:
  static std::string list(const std::vector<double>& values) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ",") + mdat::text_of(value);
    return text;
  }
  static std::string diagonal() {
    std::vector<double> triangle;
    for (int row = 0; row < 6; ++row) {
      for (int column = row; column < 6; ++column) triangle.push_back(row == column ? kStartVariance : 0);
    }
    return list(triangle);
  }
  void note(const mdat::DecodedPacket& packet) {
    const std::string name = packet.name();
    if (name == "completed") ++completed;
    if (name == "refused" || name == "failed") ++refused;
    PacketHeader header;
    PoseTelemetry pose;
    if (name == "pose" && decode_pose(packet.bytes, header, pose) == PacketFault::kNone) poses[pose.scan_id] = pose;
  }
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
    ground.send("ping");
    ground.send_garbage(200);
  }
  for (std::uint32_t i = 0; at >= 45 && at < 50 && i < 10 * kMaxCommandsPerFrame; ++i) ground.send("ping");
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
  VERIFIES("LASSO-LNK-029~1 LASSO-NEED-009~1");
  TroubledLink quiet_link, troubled_link;
  LinkedFlight quiet(quiet_link), troubled(troubled_link);
  Ground observer(quiet_link), ground(troubled_link);
  observer.send_start();
  ground.send_start();
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    disturb(frame, ground, troubled_link);
    quiet.run_frame();
    troubled.run_frame();
    observer.take();
    ground.take();
  }
  EXPECT_EQ(ground.sent, 1 + kFrames / kCycle * (15 + 5 * 10 * kMaxCommandsPerFrame));
  EXPECT_EQ(ground.completed, ground.sent) << "every valid command is carried out";
  EXPECT_EQ(observer.poses.size(), kFrames - kDelayed);
  EXPECT_GT(ground.poses.size(), kFrames * 9 / 10) << "but those for which the queue had no room while the link was lost";
  const std::size_t valid = compare(ground, observer);
  EXPECT_GT(valid, ground.poses.size() - 10);
  std::printf("%u commands in 10 minutes: %u completed, %u bytes of noise answered by %u refusals; %zu of %zu poses came\n", ground.sent,
              ground.completed, kFrames / kCycle * 15 * 500, ground.refused, ground.poses.size(), observer.poses.size());
}

}  // namespace
}  // namespace lasso::ft
