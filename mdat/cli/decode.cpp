#include <cstdio>
#include <memory>

#include "mdat/cli/commands.hpp"
#include "mdat/common/output.hpp"
#include "mdat/link/decode_text.hpp"

namespace lasso::mdat {
namespace {

struct Options {
  std::string file, format = "table";
  bool headers = false, commands = false;
  Selection selection;
};

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

ConstBytes view(const std::string& content) { return {reinterpret_cast<const std::uint8_t*>(content.data()), content.size()}; }

void list(const Options& options, const std::string& content) {
  if (options.format == "pcap" || !options.selection.packet.empty() || !options.selection.items.empty()) {
    throw CLI::ValidationError("--headers", "goes with --format table, json or csv alone");
  }
  const HeaderList headers = list_headers(view(content));
  if (options.format == "json") return print(headers_json(headers));
  print(options.format == "csv" ? headers_csv(headers) : headers_table(headers));
  std::fputs(headers_summary(headers).c_str(), stderr);
}

std::string text_of(const DecodedStream& stream, const Options& options) {
  if (options.format == "json") return json_text(stream, options.selection);
  if (options.format == "csv") return csv_text(stream, options.selection);
  return options.format == "pcap" ? pcap_bytes(stream) : table_text(stream, options.selection);
}

void decode(const Options& options) {
  check_selection(options.selection);
  const std::string content = file_content(options.file);
  if (options.headers) return list(options, content);
  const DecodedStream stream = decode_stream(view(content), options.commands ? PacketType::kCommand : PacketType::kTelemetry);
  print(text_of(stream, options));
  std::fprintf(stderr, "%zu packets, %zu bytes that belong to none\n", stream.packets.size(), stream.other_bytes);
}

}  // namespace

void add_decode_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("decode", "print a recorded stream of packets");
  command->add_option("FILE", options->file, "packets, as they come from the component (telemetry.ccsds of a run)")->required();
  command->add_option("--format", options->format, "table, json, csv, or pcap for Wireshark")
      ->capture_default_str()
      ->check(CLI::IsMember({"table", "json", "csv", "pcap"}));
  command->add_option("--packet", options->selection.packet, "packets of this name alone");
  command->add_option("--items", options->selection.items, "these items alone, separated by commas")->delimiter(',');
  command->add_flag("--commands", options->commands, "the stream is one of commands, not of telemetry");
  command->add_flag("--headers", options->headers, "list headers, sequence gaps and check sums of any stream of space packets");
  command->callback([options] { decode(*options); });
}

}  // namespace lasso::mdat
