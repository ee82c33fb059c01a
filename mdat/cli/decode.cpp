#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/interruption.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "mdat/link/decode_text.hpp"
#include "mdat/link/headers_text.hpp"

namespace lasso::mdat {
namespace {

struct DecodeArguments {
  std::string file, format = "table";
  std::uint16_t apid = kApid;
  bool headers = false, commands = false, follow = false, of_one = false;  // of_one: --apid is given
  Selection selection;
};

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

ConstBytes view(const std::string& content) { return {reinterpret_cast<const std::uint8_t*>(content.data()), content.size()}; }

// Of a run that recorded nothing there is nothing to print; what has bytes and no packet is another file.
void require_packets(std::size_t packets, const DecodeArguments& options, const std::string& content) {
  if (packets > 0 || content.empty()) return;
  if (options.headers)
    throw InputError(options.file + ": no space packet in its " + std::to_string(content.size()) + " bytes: give a recorded stream");
  const char* const kind = options.commands ? "command" : "packet of telemetry";
  throw InputError(
      format("%s: no %s of APID %u in its %zu bytes: give a recorded stream (telemetry.ccsds of a run; one of commands with "
             "--commands; --headers lists the APIDs of any)",
             options.file.c_str(), kind, options.apid, content.size()));
}

// Leaves the headers of the one that is asked for. What lies between two of them is then other packets as well.
void require_apid(const DecodeArguments& options, HeaderList& headers) {
  const auto other = [&](const HeaderLine& line) { return line.header.apid != options.apid; };
  headers.lines.erase(std::remove_if(headers.lines.begin(), headers.lines.end(), other), headers.lines.end());
  if (headers.lines.empty())
    throw InputError(
        format("%s: no packet of APID %u; without --apid, --headers lists all that are there", options.file.c_str(), options.apid));
}

void list(const DecodeArguments& options, const std::string& content) {
  if (options.format == "pcap" || !options.selection.packet.empty() || !options.selection.items.empty()) {
    throw CLI::ValidationError("--headers", "goes with --format table, json or csv alone");
  }
  HeaderList headers = list_headers(view(content));
  require_packets(headers.lines.size(), options, content);
  if (options.of_one) require_apid(options, headers);
  if (options.format == "json") return print(headers_json(headers));
  print(options.format == "csv" ? headers_csv(headers) : headers_table(headers));
  std::fputs(headers_summary(headers).c_str(), stderr);
}

std::string text_of(const DecodedStream& stream, const DecodeArguments& options) {
  if (options.format == "json") return json_text(stream, options.selection);
  if (options.format == "csv") return csv_text(stream, options.selection);
  return options.format == "pcap" ? pcap_bytes(stream) : table_text(stream, options.selection);
}

// A file that grows, from where it was read to.
class Tail {
 public:
  explicit Tail(const std::string& file) : name_(file), file_(file, std::ios::binary) {
    if (!file_) throw InputError(file + ": no such file");
  }
  // What has come since. One that has become shorter was begun anew.
  std::string take() {
    std::error_code gone;
    const auto size = static_cast<std::streamoff>(std::filesystem::file_size(name_, gone));
    if (gone) return {};
    if (size < read_) read_ = 0;
    file_.clear();
    file_.seekg(read_);
    std::string bytes(static_cast<std::size_t>(size - read_), '\0');
    file_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file_.gcount()));
    read_ += file_.gcount();
    return bytes;
  }

 private:
  std::string name_;
  std::ifstream file_;
  std::streamoff read_ = 0;
};

// Packets as they come, until Ctrl-C. The last bytes wait for the rest of their packet.
void follow(const DecodeArguments& options) {
  constexpr std::chrono::milliseconds kLook(100);
  constexpr std::size_t kLargestPacket = 65542;
  if (options.format != "table" || options.headers) throw CLI::ValidationError("--follow", "goes with --format table alone");
  Tail tail(options.file);
  const std::atomic<bool>& interrupted = interruption();
  std::size_t begun = 0;  // of the file, where `waiting` begins
  for (std::string waiting; !interrupted; std::this_thread::sleep_for(kLook)) {
    waiting += tail.take();
    DecodedStream stream = decode_stream(view(waiting), options.commands ? PacketType::kCommand : PacketType::kTelemetry, options.apid);
    std::size_t done = waiting.size() > kLargestPacket ? waiting.size() - kLargestPacket : 0;
    if (!stream.packets.empty()) done = std::max(done, stream.packets.back().offset + stream.packets.back().bytes.size());
    for (DecodedPacket& packet : stream.packets) packet.offset += begun;
    print(table_text(stream, options.selection));
    std::fflush(stdout);
    waiting.erase(0, done);
    begun += done;
  }
}

void decode(const DecodeArguments& options) {
  check_selection(options.selection);
  if (options.follow) return follow(options);
  const std::string content = file_content(options.file);
  if (options.headers) return list(options, content);
  const DecodedStream stream = decode_stream(view(content), options.commands ? PacketType::kCommand : PacketType::kTelemetry, options.apid);
  require_packets(stream.packets.size(), options, content);
  print(text_of(stream, options));
  std::fprintf(stderr, "%s, %s that belong to none\n", amount(stream.packets.size(), "packet").c_str(),
               amount(stream.other_bytes, "byte").c_str());
}

}  // namespace

void add_decode_command(CLI::App& app) {
  const auto options = std::make_shared<DecodeArguments>();
  CLI::App* command = app.add_subcommand("decode", "print a recorded stream of packets");
  command->add_option("FILE", options->file, "packets, as they come from the component (telemetry.ccsds of a run)")->required();
  command->add_option("--format", options->format, "table, json, csv, or pcap for Wireshark")
      ->capture_default_str()
      ->check(CLI::IsMember({"table", "json", "csv", "pcap"}));
  command->add_option("--packet", options->selection.packet, "packets of this name alone");
  command->add_option("--items", options->selection.items, "these items alone, separated by commas")->delimiter(',');
  const CLI::Option* const apid = add_apid(*command, options->apid);
  command->add_flag("--commands", options->commands, "the stream is one of commands, not of telemetry");
  command->add_flag("--headers", options->headers,
                    "list headers, sequence gaps and checksums of any stream of space packets; with --apid those of one alone");
  command->add_flag("--follow", options->follow, "go on with what is added to the file, until Ctrl-C");
  command->callback([options, apid] {
    options->of_one = apid->count() > 0;
    decode(*options);
  });
}

}  // namespace lasso::mdat
