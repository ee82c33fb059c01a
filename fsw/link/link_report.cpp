#include "fsw/link/link_report.hpp"

#include "fsw/link/commands.hpp"
#include "fsw/link/link_report_rows.hpp"

namespace lasso {
namespace {

constexpr auto kDone = codec_of(link_report_rows::kDone);
constexpr auto kRefused = codec_of(link_report_rows::kRefused);
constexpr auto kFailed = codec_of(link_report_rows::kFailed);
constexpr auto kLink = codec_of(link_report_rows::kLink);

void write_items(const Verification& verification, std::uint8_t subservice, ByteWriter& writer) {
  if (subservice == kSubserviceRefused) return kRefused.write(verification, writer);
  if (subservice == kSubserviceFailed) return kFailed.write(verification, writer);
  kDone.write(verification, writer);
}

}  // namespace

std::uint32_t command_key(ConstBytes command) {
  ByteReader in(command);
  const std::uint32_t packet_id = in.u16();
  return packet_id << 16 | in.u16();
}

bool is_answer(ConstBytes telemetry, std::uint32_t& key) {
  constexpr std::size_t kServiceAt = kPrimaryHeaderBytes + 1;
  if (telemetry.size() < kPacketHeaderBytes || telemetry[kServiceAt] != kServiceVerification) return false;
  key = command_key(telemetry.subspan(kPacketHeaderBytes, telemetry.size() - kPacketHeaderBytes));
  return true;
}

std::size_t encode_verification(const Verification& verification, const PacketHeader& header, Bytes out) {
  ByteWriter writer(out);
  begin_packet(header, writer);
  write_items(verification, header.subservice, writer);
  return finish_packet(writer, out);
}

std::size_t encode_pong(PacketHeader header, Bytes out) {
  header.service = kServiceTest;
  header.subservice = kSubservicePong;
  ByteWriter writer(out);
  begin_packet(header, writer);
  return finish_packet(writer, out);
}

std::size_t encode_link(const LinkTelemetry& link, PacketHeader header, Bytes out) {
  header.service = kServiceHousekeeping;
  header.subservice = kSubserviceHousekeepingReport;
  ByteWriter writer(out);
  begin_packet(header, writer);
  writer.u16(kLinkStructureId);
  kLink.write(link, writer);
  return finish_packet(writer, out);
}

}  // namespace lasso
