// A stranger who knows the dictionary, the key's form and all that was said before, but not the key, floods a component while it tracks:
// nothing of his is accepted, the poses are those of a flight that he has left alone, to the bit, and each command of the operator is
// answered within two frames. LASSO_STRANGERS says how many packets he sends: make campaign WHAT=strangers sends a million.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "fsw/core/crc.hpp"
#include "fsw/link/byte_link.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "ft/campaign/linked_flight.hpp"
#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/link/command_encoder.hpp"
#include "mdat/link/decode.hpp"
#include "mdat/link/signature.hpp"
#include "mdat/link/station.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

using campaign::LinkedFlight;
using Packet = std::vector<std::uint8_t>;

constexpr std::size_t kFewPackets = 20'000;
constexpr std::size_t kPerFrame = 250;      // 1,250 a second
constexpr std::size_t kInventions = 3'000;  // valid commands, which are then changed
constexpr std::size_t kHeard = 200;         // of the operator's packets, that are sent again
constexpr std::size_t kSignature = 24, kCrc = 2;
constexpr std::uint32_t kAnswered = 2;  // frames
const mdat::Key kKey{Packet(32, 0x2A), 0};
const char* const kOrders[] = {"ping", "report_parameter parameter=tracking.coast_frames", "report_structure structure=health",
                               "set_hold held=no", "report_disabled_events"};

// Datagrams, as by UDP.
class Datagrams final : public ByteLink {
 public:
  bool datagrams() const override { return true; }
  std::size_t read(Bytes out) override {
    if (up.empty()) return 0;
    const std::size_t size = std::min(out.size(), up.front().size());
    std::copy_n(up.front().begin(), size, out.begin());
    up.pop_front();
    return size;
  }
  std::size_t write(ConstBytes packet) override {
    down.emplace_back(packet.begin(), packet.end());
    return packet.size();
  }
  std::deque<Packet> up;
  std::vector<Packet> down;
};

std::size_t packets_to_send() {
  const char* const text = std::getenv("LASSO_STRANGERS");
  return text == nullptr ? kFewPackets : std::strtoull(text, nullptr, 10);
}

void repair_crc(Packet& packet) {
  if (packet.size() < kCrc) return;
  const std::uint16_t crc = crc16_ccitt(ConstBytes(packet.data(), packet.size() - kCrc));
  packet[packet.size() - 2] = static_cast<std::uint8_t>(crc >> 8);
  packet[packet.size() - 1] = static_cast<std::uint8_t>(crc & 0xFF);
}

// Sizes of headers are as they were: what follows is of its length field.
void repair(Packet& packet) {
  if (packet.size() >= 7) {
    const std::size_t stated = packet.size() - 7;
    packet[4] = static_cast<std::uint8_t>(stated >> 8);
    packet[5] = static_cast<std::uint8_t>(stated & 0xFF);
  }
  repair_crc(packet);
}

class Stranger {
 public:
  explicit Stranger(std::uint64_t seed) : random_(seed) {
    while (inventions_.size() < kInventions) invent();
  }

  // What the operator has sent, and the component has had.
  void hear(const Packet& packet) {
    heard_.push_back(packet);
    if (heard_.size() > kHeard) heard_.pop_front();
    last_count_ = static_cast<std::uint16_t>((packet[2] << 8 | packet[3]) & 0x3FFF);
  }

  // The next packet, in one of the ways below.
  Packet next() {
    Packet packet = inventions_[below(inventions_.size())];
    set_count(packet);
    switch (below(heard_.empty() ? 5 : 8)) {
      case 0:
        repair(packet);  // as it is: without a signature
        return packet;
      case 1:
        return with_signature(packet);
      case 2:
        return other_key_.sign(packet);
      case 3:
        return below(2) == 0 ? next_key_.sign(packet) : zero_key_.sign(packet);
      case 4:
        return torn(with_signature(packet));
      case 5:
        return heard_[below(heard_.size())];  // sent again
      case 6:
        return changed(heard_[below(heard_.size())]);
      default:
        return spliced(packet, heard_[below(heard_.size())]);
    }
  }

 private:
  std::size_t below(std::size_t n) { return random_.bits() % n; }
  std::uint8_t byte() { return static_cast<std::uint8_t>(random_.bits()); }

  std::string value_of(const ItemRow& item) {
    const double low = std::max(item.range.minimum, 0.0), high = std::min(item.range.maximum, is_real(item.type) ? 1e3 : 255.0);
    const double value = low + (high - low) * random_.uniform();
    return is_real(item.type) ? mdat::text_of(value) : std::to_string(static_cast<long>(value));
  }
  // A command of the dictionary, with arguments that are in range; one that the ground tool refuses to make is another one's turn.
  void invent() {
    const PacketRow& row = commands()[below(commands().size())];
    std::map<std::string, std::string> values;
    for (const ItemRow& item : row.items) {
      std::string text;
      for (std::uint16_t i = 0; i < item.count; ++i) text += (i > 0 ? "," : "") + value_of(item);
      values[item.name] = text;
    }
    try {
      inventions_.push_back(mdat::encode_command(row, values, 0));
    } catch (const mdat::InputError&) {
    }
  }
  // Of those that the component would take next.
  void set_count(Packet& packet) {
    const auto count = static_cast<std::uint16_t>((last_count_ + 1 + below(8000)) & 0x3FFF);
    packet[2] = static_cast<std::uint8_t>(0xC0 | count >> 8);
    packet[3] = static_cast<std::uint8_t>(count & 0xFF);
    repair_crc(packet);
  }
  // A guess: a number of now, or the last one's and a few more; any code.
  Packet with_signature(Packet packet) {
    packet.resize(packet.size() - kCrc);
    const std::uint64_t number = mdat::number_of_now() + below(1'000'000);
    for (int shift = 56; shift >= 0; shift -= 8) packet.push_back(static_cast<std::uint8_t>(number >> shift));
    const std::uint8_t fill = byte();
    const bool alike = below(4) == 0;
    for (std::size_t i = 8; i < kSignature; ++i) packet.push_back(alike ? fill : byte());
    packet.resize(packet.size() + kCrc);
    repair(packet);
    return packet;
  }
  Packet torn(Packet packet) {
    packet.resize(below(2) == 0 ? 1 + below(packet.size()) : packet.size() + below(64), byte());
    if (below(2) == 0) repair(packet);
    return packet;
  }
  // One or two bits that the code has to cover, and a checksum that is right.
  Packet changed(Packet packet) {
    for (std::size_t i = below(2) + 1; i > 0; --i) {
      std::uint8_t& place = packet[below(packet.size() - kCrc)];
      place = static_cast<std::uint8_t>(place ^ (1U << below(8)));
    }
    repair_crc(packet);
    return packet;
  }
  // A command of his own before a signature that was right for another one.
  Packet spliced(Packet packet, const Packet& heard) {
    packet.resize(packet.size() - kCrc);
    packet.insert(packet.end(), heard.end() - static_cast<std::ptrdiff_t>(kSignature + kCrc), heard.end());
    repair(packet);
    return packet;
  }

  static Span<const PacketRow> commands() { return Span<const PacketRow>(command_rows::kCommands); }

  sim::Random random_;
  std::vector<Packet> inventions_;
  std::deque<Packet> heard_;
  std::uint16_t last_count_ = 0;
  mdat::Signer other_key_{mdat::Key{Packet(32, 0x2B), 0}}, zero_key_{mdat::Key{Packet(32, 0), 0}};
  mdat::Signer next_key_{mdat::derive_command_key(kKey, 1)};  // stolen before its time
};

// One flight with its operator, who has the key, and sends the same in each.
class Operated {
 public:
  void fly_frame(std::uint32_t frame, const std::vector<Packet>& orders, const std::vector<Packet>& strangers, std::size_t place) {
    for (std::size_t i = 0; i <= strangers.size(); ++i) {
      if (i == place) link_.up.insert(link_.up.end(), orders.begin(), orders.end());
      if (i < strangers.size()) link_.up.push_back(strangers[i]);
    }
    for (const Packet& order : orders) sent_[key_of(order)] = frame;
    flight_.run_frame();
    for (const Packet& packet : link_.down) note({packet.data(), packet.size()}, frame);
    link_.down.clear();
  }

  std::size_t left_over() const { return link_.up.size(); }
  std::size_t unanswered() const { return sent_.size(); }

  std::vector<Packet> poses;  // what each packet says behind its header
  std::size_t valid = 0, refusals = 0, done = 0;
  std::uint32_t slowest = 0;  // frames from a command to its answer
  double accepted = 0, refused = 0;
  std::set<std::string> others;  // that the operator's commands do not explain

 private:
  static std::uint32_t key_of(const Packet& packet) {
    return static_cast<std::uint32_t>(packet[0]) << 24 | static_cast<std::uint32_t>(packet[1]) << 16 |
           static_cast<std::uint32_t>(packet[2]) << 8 | packet[3];
  }
  void note(ConstBytes packet, std::uint32_t frame) {
    const mdat::DecodedStream decoded = mdat::decode_stream(packet, PacketType::kTelemetry);
    ASSERT_EQ(decoded.packets.size(), 1U);
    const mdat::DecodedPacket& told = decoded.packets.front();
    const std::string name = told.name();
    if (name == "pose") note_pose(packet);
    if (name == "refused") ++refusals;
    if (name == "failed" || name == "image_ready" || name == "laser_enabled" || name == "key_on_trial") others.insert(name);
    if (name == "link") {
      accepted = mdat::item_value(told, "accepted_commands");
      refused = mdat::item_value(told, "refused_commands");
    }
    if (name != "completed") return;
    const auto key = static_cast<std::uint32_t>(mdat::item_value(told, "packet_id")) << 16 |
                     static_cast<std::uint32_t>(mdat::item_value(told, "sequence_control"));
    const auto sent = sent_.find(key);
    if (sent == sent_.end()) return (void)others.insert("completed what the operator did not send");
    slowest = std::max(slowest, frame - sent->second);
    sent_.erase(sent);
    ++done;
  }
  void note_pose(ConstBytes packet) {
    PacketHeader header;
    ConstBytes data;
    PoseTelemetry pose;
    ASSERT_EQ(parse_packet(packet, header, data), PacketFault::kNone);
    ASSERT_EQ(decode_pose(packet, header, pose), PacketFault::kNone);
    valid += pose.valid;
    poses.emplace_back(data.begin(), data.end());
  }

  Datagrams link_;
  mdat::SignatureCheck check_{kKey};
  LinkedFlight flight_{link_, &check_};
  std::map<std::uint32_t, std::uint32_t> sent_;
};

// Where two flights' poses differ first; empty: nowhere.
std::string difference(const std::vector<Packet>& a, const std::vector<Packet>& b) {
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const auto [here, there] = std::mismatch(a[i].begin(), a[i].end(), b[i].begin(), b[i].end());
    if (here == a[i].end() && there == b[i].end()) continue;
    return "pose " + std::to_string(i) + ", byte " + std::to_string(here - a[i].begin()) + " behind the header";
  }
  return a.size() == b.size() ? "" : std::to_string(a.size()) + " poses, and " + std::to_string(b.size());
}

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ",") + mdat::text_of(value);
  return text;
}

Packet start(std::uint16_t count) {
  const Pose pose = LinkedFlight::first_T_sensor_target();
  std::vector<double> triangle;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) triangle.push_back(row == column ? 0.0025 : 0);
  }
  return mdat::encode_command(mdat::command_row("offer_start"),
                              {{"start_source", "uplink"},
                               {"t_us", std::to_string(LinkedFlight::first_us())},
                               {"q_sensor_target", list({pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()})},
                               {"p_sensor_target_m", list({pose.p.x(), pose.p.y(), pose.p.z()})},
                               {"omega_radps", "0,0,0"},
                               {"v_mps", "0,0,0"},
                               {"covariance", list(triangle)}},
                              count);
}

Packet order(std::uint32_t number, std::uint16_t count) {
  const std::string text = kOrders[number % std::size(kOrders)];
  const std::size_t space = text.find(' ');
  std::map<std::string, std::string> values;
  if (space != std::string::npos) values.insert(mdat::split_argument(text.substr(space + 1)));
  return mdat::encode_command(mdat::command_row(text.substr(0, space)), values, count);
}

TEST(StrangerFlight, WhoHasNotTheKeyMovesNothing) {
  VERIFIES("LASSO-LNK-049~1");
  const std::size_t packets = packets_to_send();
  const auto frames = static_cast<std::uint32_t>((packets + kPerFrame - 1) / kPerFrame);
  Stranger stranger(1);
  sim::Random random(2);
  mdat::Signer signer(kKey);
  Operated quiet, flooded;
  std::uint16_t count = 0;
  std::size_t orders = 0;
  // The start comes before the flood, so that it is taken at the same boundary.
  for (std::uint32_t frame = 0; frame <= frames + 3; ++frame) {
    const bool floods = frame > 0 && frame <= frames;
    std::vector<Packet> sent, strangers;
    if (frame == 0) sent.push_back(signer.sign(start(count++)));
    if (floods && frame % 3 == 0) sent.push_back(signer.sign(order(frame / 3, count++ & 0x3FFF)));
    orders += sent.size();
    for (std::size_t i = 0; floods && i < kPerFrame; ++i) strangers.push_back(stranger.next());
    quiet.fly_frame(frame, sent, {}, 0);
    flooded.fly_frame(frame, sent, strangers, random.bits() % (strangers.size() + 1));
    for (const Packet& packet : sent) stranger.hear(packet);
  }
  EXPECT_EQ(flooded.left_over(), 0U);
  EXPECT_EQ(flooded.accepted, static_cast<double>(orders)) << "the operator's alone";
  EXPECT_EQ(flooded.refused, static_cast<double>(frames * kPerFrame)) << "each of the stranger's";
  EXPECT_TRUE(flooded.others.empty()) << *flooded.others.begin();
  EXPECT_EQ(flooded.done, orders);
  EXPECT_EQ(flooded.unanswered(), 0U);
  EXPECT_LE(flooded.slowest, kAnswered);
  EXPECT_EQ(difference(flooded.poses, quiet.poses), "");
  EXPECT_GE(flooded.poses.size(), frames);
  EXPECT_GT(quiet.valid, quiet.poses.size() / 2) << "a track that could have been disturbed";
  std::printf(
      "%zu packets of a stranger in %u frames: %.0f accepted besides the operator's %zu, which were answered within %u frames; %zu poses "
      "(%zu valid), all as without him; %zu of his packets answered\n",
      frames * kPerFrame, frames, flooded.accepted - static_cast<double>(orders), orders, flooded.slowest, flooded.poses.size(),
      flooded.valid, flooded.refusals);
}

}  // namespace
}  // namespace lasso::ft
