#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "bsp/posix/links.hpp"
#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/link/command_encoder.hpp"
#include "mdat/link/decode_text.hpp"

namespace lasso::mdat {
namespace {

using Clock = std::chrono::steady_clock;
using Packet = std::vector<std::uint8_t>;

struct Options {
  std::string name, to, out;
  std::vector<std::string> arguments;
  std::optional<std::uint16_t> count;
  double wait_s = 2;
  bool list = false, arm = false, poses = false;
};

enum class Outcome { kOpen, kDone, kFailed, kRepeated };

// Who sends one command at a time knows of no counts before: the clock's is after the last one, or one of two about half of all
// counts further on is, since half of them are after any last one.
constexpr std::uint16_t kHalf = 1U << 13;
std::uint16_t first_count() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint16_t>(std::chrono::duration_cast<std::chrono::milliseconds>(now).count() / 100 & kSequenceCountMask);
}

class Station {
 public:
  Station(const Options& options) : options_(options), link_(posix::connect_link(options.to)) {}

  // Sends a command, and says what comes back until it is answered or nobody answers in time.
  Outcome send(const Packet& packet) {
    if (link_->write({packet.data(), packet.size()}) != packet.size()) throw RunError(options_.to + ": does not take the command");
    sent_ = packet;
    outcome_ = Outcome::kOpen;
    listen(options_.wait_s, true);
    return outcome_;
  }

  // Prints telemetry for some time.
  void listen(double seconds, bool until_answered) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < end && !(until_answered && outcome_ != Outcome::kOpen)) {
      Packet bytes(65536);
      bytes.resize(link_->read(Bytes(bytes.data(), bytes.size())));
      if (bytes.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      stream_.insert(stream_.end(), bytes.begin(), bytes.end());
      take_packets();
    }
  }

 private:
  void take_packets() {
    const DecodedStream decoded = decode_stream({stream_.data(), stream_.size()}, PacketType::kTelemetry);
    if (decoded.packets.empty()) return;
    for (const DecodedPacket& packet : decoded.packets) note(packet);
    const DecodedPacket& last = decoded.packets.back();
    stream_.erase(stream_.begin(), stream_.begin() + static_cast<std::ptrdiff_t>(last.offset + last.bytes.size()));
  }

  void note(const DecodedPacket& packet) {
    const bool pose = packet.name() == std::string("pose");
    if (pose && !options_.poses) return;
    DecodedStream one;
    one.packets.push_back(packet);
    std::fputs(table_text(one, {}).c_str(), stdout);
    const bool verifies = packet.bytes[7] == kServiceVerification;
    if (!verifies || !std::equal(sent_.begin(), sent_.begin() + 4, packet.bytes.begin() + kPacketHeaderBytes)) return;
    if (packet.bytes[8] == kSubserviceCompleted) outcome_ = Outcome::kDone;
    if (packet.bytes[8] == kSubserviceFailed) outcome_ = Outcome::kFailed;
    if (packet.bytes[8] != kSubserviceRefused) return;
    const bool repeated = packet.bytes[kPacketHeaderBytes + 4] == static_cast<std::uint8_t>(PacketFault::kRepeated);
    outcome_ = repeated ? Outcome::kRepeated : Outcome::kFailed;
  }

  const Options& options_;
  std::unique_ptr<posix::PosixLink> link_;
  Packet sent_, stream_;
  Outcome outcome_ = Outcome::kOpen;
};

void send(const Options& options, const PacketRow& row, const std::map<std::string, std::string>& values) {
  Station station(options);
  std::uint16_t count = options.count.value_or(first_count());
  const auto send_next = [&](bool arms) {
    const Packet packet = arms ? arm_for(row, count) : encode_command(row, values, count);
    ++count;
    return station.send(packet);
  };
  Outcome outcome = send_next(options.arm);
  for (int tries = 0; tries < 2 && outcome == Outcome::kRepeated && !options.count; ++tries) {
    count = static_cast<std::uint16_t>(count + (tries == 0 ? kHalf - 2 : 1U));
    outcome = send_next(options.arm);
  }
  if (options.arm && outcome == Outcome::kDone) outcome = send_next(false);
  if (outcome == Outcome::kOpen) throw RunError(options.to + ": no answer within " + std::to_string(options.wait_s) + " s");
  if (outcome != Outcome::kDone) throw RunError(std::string(row.name) + ": not carried out");
}

void write(const Options& options, const PacketRow& row, const std::map<std::string, std::string>& values) {
  std::uint16_t count = options.count.value_or(0);
  Packet bytes;
  if (options.arm) bytes = arm_for(row, count++);
  const Packet packet = encode_command(row, values, count);
  bytes.insert(bytes.end(), packet.begin(), packet.end());
  write_file(options.out, std::string(bytes.begin(), bytes.end()));
}

void command(const Options& options) {
  if (options.list) return (void)std::fputs(command_list().c_str(), stdout);
  if (options.name.empty()) throw InputError("command: which one? mdat command --list shows all");
  const PacketRow& row = command_row(options.name);
  if (options.to.empty() == options.out.empty()) {
    if (!options.to.empty()) throw InputError("--to or --out, not both");
    return (void)std::fputs(command_help(row).c_str(), stdout);
  }
  if (options.arm && row.hazard == Hazard::kNone) throw InputError(options.name + ": is not hazardous; leave --arm out");
  std::map<std::string, std::string> values;
  for (const std::string& argument : options.arguments) values.insert(split_argument(argument));
  static_cast<void>(encode_command(row, values, 0));  // what is wrong is said before anything is sent
  options.to.empty() ? write(options, row, values) : send(options, row, values);
}

}  // namespace

void add_command_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* subcommand = app.add_subcommand("command", "send a command to a component, or write it to a file");
  subcommand->add_option("NAME", options->name, "of the dictionary; alone: shows its items");
  subcommand->add_option("ITEM=VALUE", options->arguments, "its items; elements are separated by commas, choices may be given by name");
  subcommand->add_flag("--list", options->list, "list the commands");
  subcommand->add_option("--to", options->to, "udp://HOST:PORT or tcp://HOST:PORT: send it, and print what is answered");
  subcommand->add_option("--out", options->out, "file for the packet");
  subcommand->add_flag("--arm", options->arm, "arm a hazardous command before it");
  subcommand->add_option("--count", options->count, "sequence count (with --to: one that the component takes; with --out: 0)")
      ->check(CLI::Range(0, 16383));
  subcommand->add_option("--wait", options->wait_s, "seconds to wait for the answer")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 3600.0));
  subcommand->add_flag("--poses", options->poses, "print poses, too");
  subcommand->callback([options] {
    try {
      command(*options);
    } catch (const posix::LinkError& error) {
      throw InputError(error.what());
    }
  });
}

}  // namespace lasso::mdat
