#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "bsp/posix/links.hpp"
#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "mdat/link/command_encoder.hpp"
#include "mdat/link/decode_text.hpp"
#include "mdat/link/station.hpp"

namespace lasso::mdat {
namespace {

using Packet = std::vector<std::uint8_t>;

constexpr double kNobody_s = 2, kCompiling_s = 120;
constexpr std::chrono::milliseconds kLookAgain(100);

struct CommandArguments {
  std::string name, to, out, key;
  std::vector<std::string> arguments;
  std::optional<std::uint16_t> count;
  std::uint16_t apid = kApid;
  std::optional<double> wait_s;
  double listen_s = 0;
  bool list = false, arm = false, poses = false;
};

// Prints what comes, one packet after the other.
Station::Listener printer(bool poses) {
  return [poses](const DecodedPacket& packet) {
    if (packet.name() == std::string("pose") && !poses) return;
    DecodedStream one;
    one.packets.push_back(packet);
    std::fputs(table_text(one, {}).c_str(), stdout);
  };
}

// Opens the link once somebody is there: a run that was started just now may not have come so far.
std::unique_ptr<posix::PosixLink> connect(const CommandArguments& options) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.wait_s.value_or(kNobody_s));
  for (;;) {
    const bool over = std::chrono::steady_clock::now() >= end;
    try {
      auto link = posix::connect_link(options.to);
      if (!link->unreached()) return link;
      if (over) throw RunError(options.to + ": no answer: nobody listens at this port");
    } catch (const posix::NobodyThere& error) {
      if (over) throw RunError(error.what());
    }
    std::this_thread::sleep_for(kLookAgain);
  }
}

// An answer of another application process is none.
std::string others_of(const Station& station, const CommandArguments& options) {
  if (station.other_bytes() == 0) return "";
  return format("; %s came that belong to no packet of APID %u (--apid)", amount(station.other_bytes(), "byte").c_str(), options.apid);
}

void send(const CommandArguments& options, const PacketRow& row, const std::map<std::string, std::string>& values) {
  const std::unique_ptr<posix::PosixLink> link = connect(options);
  Station station(*link, options.to, printer(options.poses), options.apid);
  station.end_where([&link] { return link->ended(); });
  if (options.count) station.set_count(*options.count);
  if (!options.key.empty()) station.sign_with(load_key(options.key));
  const double wait_s = options.wait_s.value_or(kCompiling_s);
  if (!options.wait_s) {
    station.on_silence(kNobody_s, [&] {
      std::fprintf(stderr, "%s: no answer yet: a run answers once its mission is compiled; waiting %s s at most (--wait)\n",
                   options.to.c_str(), text_of(wait_s).c_str());
    });
  }
  const CommandAnswer answer = station.command(row, values, options.arm, wait_s);
  static_cast<void>(station.listen(options.listen_s, [&link] { return link->ended(); }));
  if (answer.outcome == Outcome::kOpen)
    throw RunError(options.to + ": no answer within " + text_of(wait_s) + " s" + others_of(station, options));
  if (answer.outcome != Outcome::kDone) throw RunError(std::string(row.name) + ": not carried out: " + answer.why);
}

void write(const CommandArguments& options, const PacketRow& row, const std::map<std::string, std::string>& values) {
  std::uint16_t count = options.count.value_or(0);
  std::vector<Packet> packets;
  if (options.arm) packets.push_back(arm_for(row, count++, options.apid));
  packets.push_back(encode_command(row, values, count, options.apid));
  std::optional<Signer> signer;
  if (!options.key.empty()) signer.emplace(load_key(options.key));
  Packet bytes;
  for (const Packet& packet : packets) {
    const Packet sent = signer ? signer->sign(packet) : packet;
    bytes.insert(bytes.end(), sent.begin(), sent.end());
  }
  write_file(options.out, std::string(bytes.begin(), bytes.end()));
}

// A number that goes far ahead uses up those before it for good.
void check_key_number(const CommandArguments& options, const std::map<std::string, std::string>& values) {
  if (options.name != "change_key" || options.key.empty()) return;
  check_next_key(load_key(options.key).number, static_cast<std::uint32_t>(std::stoul(values.at("number"))));
}

void command(const CommandArguments& options) {
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
  static_cast<void>(encode_command(row, values, 0, options.apid));  // what is wrong is said before anything is sent
  check_key_number(options, values);
  options.to.empty() ? write(options, row, values) : send(options, row, values);
}

}  // namespace

void add_command_command(CLI::App& app) {
  const auto options = std::make_shared<CommandArguments>();
  CLI::App* subcommand = app.add_subcommand("command", "send a command to a component, or write it to a file");
  subcommand->add_option("NAME", options->name, "of the dictionary; alone: shows its items");
  subcommand->add_option("ITEM=VALUE", options->arguments, "its items; elements are separated by commas, choices may be given by name");
  subcommand->add_flag("--list", options->list, "list the commands");
  subcommand->add_option("--to", options->to,
                         "udp://HOST:PORT, tcp://HOST:PORT, serial:DEVICE or unix:PATH: send it, and print what is answered");
  subcommand->add_option("--out", options->out, "file for the packet");
  subcommand->add_option("--key", options->key,
                         "file with the key that the component asks commands to be signed with (64 hexadecimal digits)");
  subcommand->add_flag("--arm", options->arm, "arm a hazardous command before it");
  subcommand->add_option("--count", options->count, "sequence count (with --to: one that the component takes; with --out: 0)")
      ->check(CLI::Range(0, 16383));
  add_apid(*subcommand, options->apid);
  subcommand->add_option("--wait", options->wait_s, "seconds to wait for the answer (2 where nobody listens, 120 for a run that compiles)")
      ->check(number_between(0.0, 3600.0));
  subcommand->add_option("--listen", options->listen_s, "seconds to go on printing what comes after the answer")
      ->capture_default_str()
      ->check(number_between(0.0, 3600.0));
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
