#include "mdat/link/decode.hpp"

#include "fsw/core/crc.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "fsw/link/telecommand.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/link/decode_text.hpp"
#include "ut/link/command_packets.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::Stream;
using test::view;

void append(Stream& stream, const Stream& more) { stream.insert(stream.end(), more.begin(), more.end()); }

Stream pose_packet(std::uint16_t count, const PoseTelemetry& pose = {}) {
  PacketHeader header;
  header.sequence_count = count;
  header.t_us = 1500000;
  Stream packet(kMaxPosePacketBytes);
  packet.resize(encode_pose(pose, header, Bytes(packet.data(), packet.size())));
  return packet;
}

void repair_crc(Stream& packet) {
  const std::uint16_t crc = crc16_ccitt(ConstBytes(packet.data(), packet.size() - 2));
  packet[packet.size() - 2] = static_cast<std::uint8_t>(crc >> 8);
  packet[packet.size() - 1] = static_cast<std::uint8_t>(crc & 0xFF);
}

const DecodedItem& item(const DecodedPacket& packet, const std::string& name) {
  for (const DecodedItem& each : packet.items) {
    if (name == each.row->name) return each;
  }
  throw std::runtime_error("no item " + name);
}

TEST(Decode, GivesBackWhatTheFlightCodePacked) {
  VERIFIES("LASSO-GND-021~1");
  PoseTelemetry pose;
  pose.scan_id = 4000000000;
  pose.t_measurement_us = -5;
  pose.reason = 11;
  pose.p_sensor_target_m[2] = 1.0 / 3;
  pose.covariance[20] = 0.1;
  const Stream stream = pose_packet(7, pose);
  const DecodedStream decoded = decode_stream(view(stream), PacketType::kTelemetry);
  ASSERT_EQ(decoded.packets.size(), 1U);
  EXPECT_EQ(decoded.other_bytes, 0U);
  const DecodedPacket& packet = decoded.packets.front();
  EXPECT_STREQ(packet.name(), "pose");
  EXPECT_EQ(packet.header.at(5), 7U) << "sequence count";
  EXPECT_EQ(packet.header.at(13), 1U) << "seconds";
  EXPECT_EQ(packet.header.at(14), 1U << 23) << "fraction";
  EXPECT_EQ(std::get<std::int64_t>(item(packet, "scan_id").values.at(0)), 4000000000);
  EXPECT_EQ(std::get<std::int64_t>(item(packet, "t_measurement_us").values.at(0)), -5);
  EXPECT_STREQ(choice_of(*item(packet, "reason").row, item(packet, "reason").values.at(0))->name, "implausible");
  EXPECT_EQ(std::get<double>(item(packet, "p_sensor_target_m").values.at(2)), 1.0 / 3);
  EXPECT_EQ(std::get<double>(item(packet, "covariance").values.at(20)), 0.1);
}

TEST(Decode, AgreesWithTheFlightDecoderForAllBytes) {
  VERIFIES("LASSO-GND-021~1");
  test::Generator random(3);
  for (int round = 0; round < 100; ++round) {
    Stream packet = pose_packet(0);
    for (std::size_t i = 22; i + 2 < packet.size(); ++i) packet[i] = static_cast<std::uint8_t>(random.bits());
    repair_crc(packet);
    PacketHeader header;
    PoseTelemetry pose;
    ASSERT_EQ(decode_pose(view(packet), header, pose), PacketFault::kNone);
    const DecodedStream decoded = decode_stream(view(packet), PacketType::kTelemetry);
    ASSERT_EQ(decoded.packets.size(), 1U);
    const DecodedPacket& ground = decoded.packets.front();
    EXPECT_EQ(std::get<std::int64_t>(item(ground, "image_crc").values[0]), pose.image_crc);
    EXPECT_EQ(std::get<std::int64_t>(item(ground, "t_search_us").values[0]), pose.t_search_us);
    EXPECT_EQ(std::get<std::int64_t>(item(ground, "odd_parts").values[0]), pose.odd_parts);
    EXPECT_EQ(text_of(item(ground, "bearing").values[5]), text_of(Number(pose.bearing[5])));
  }
}

TEST(Decode, FindsPacketsBetweenGarbageAndBehindABrokenOne) {
  VERIFIES("LASSO-GND-021~1");
  Stream stream = {1, 2, 0x0B, 3};
  append(stream, pose_packet(1));
  stream.resize(stream.size() - 100);  // the rest of the packet is lost
  append(stream, pose_packet(2));
  append(stream, {0x0B, 0xD1, 0xFF, 0xFF, 0xFF, 0x00});  // seems to begin a packet that is longer than the stream
  append(stream, pose_packet(3));
  const DecodedStream decoded = decode_stream(view(stream), PacketType::kTelemetry);
  ASSERT_EQ(decoded.packets.size(), 2U);
  EXPECT_EQ(decoded.packets[0].header.at(5), 2U);
  EXPECT_EQ(decoded.packets[0].offset, 4U + 735U);
  EXPECT_EQ(decoded.packets[1].header.at(5), 3U);
  EXPECT_EQ(decoded.packets[1].offset, stream.size() - 835);
  EXPECT_EQ(decoded.other_bytes, stream.size() - std::size_t{2} * 835);
}

TEST(Decode, SaysWhatTheDictionaryDoesNotHave) {
  VERIFIES("LASSO-GND-021~1");
  Stream other = pose_packet(1);
  other[8] = 99;
  repair_crc(other);
  Stream shorter = pose_packet(1);
  shorter.resize(shorter.size() - 4);
  shorter[5] = static_cast<std::uint8_t>(shorter[5] - 4);
  repair_crc(shorter);
  Stream structure = pose_packet(1);
  structure[21] = 9;
  repair_crc(structure);
  Stream tiny = {0x0B, 0xD1, 0xC0, 0x00, 0x00, 0x02, 0, 0, 0};
  repair_crc(tiny);
  for (const Stream& packet : {other, shorter, structure, tiny}) {
    const DecodedStream decoded = decode_stream(view(packet), PacketType::kTelemetry);
    ASSERT_EQ(decoded.packets.size(), 1U);
    EXPECT_STREQ(decoded.packets.front().name(), "unknown");
    EXPECT_TRUE(decoded.packets.front().items.empty());
    EXPECT_EQ(json_text(decoded, {}).find("\"items\": {}") != std::string::npos, true);
  }
}

TEST(Decode, ReadsCommandsAndTheirAnswers) {
  VERIFIES("LASSO-GND-021~1");
  CommandHeader command;
  command.sequence_count = 9;
  command.service = kServiceFunction;
  command.subservice = kSubservicePerform;
  Stream packet(kMaxCommandBytes);
  ByteWriter writer{Bytes(packet.data(), packet.size())};
  begin_command(command, writer);
  writer.u16(1);
  writer.u8(5);
  packet.resize(finish_packet(writer, Bytes(packet.data(), packet.size())));
  const std::string text = table_text(decode_stream(view(packet), PacketType::kCommand), {});
  EXPECT_EQ(text, "set_mode   #9 (16 bytes at 0)\n  mode                       bearing\n");

  PacketHeader header;
  header.service = kServiceVerification;
  header.subservice = kSubserviceRefused;
  Stream answer(kMaxLinkReportBytes);
  answer.resize(encode_verification({0x1BD1, 0xC009, 3, 0, 0}, header, Bytes(answer.data(), answer.size())));
  const DecodedStream decoded = decode_stream(view(answer), PacketType::kTelemetry);
  ASSERT_EQ(decoded.packets.size(), 1U);
  EXPECT_STREQ(decoded.packets.front().name(), "refused");
  EXPECT_NE(table_text(decoded, {}).find("fault                      bad_crc\n"), std::string::npos);
}

TEST(Headers, ListsAnyPacketsGapsAndCheckSums) {
  VERIFIES("LASSO-GND-021~1");
  // Two applications, one with the type of commands; a count that wraps; a gap of 2; a wrong check sum.
  const auto packet = [](std::uint8_t first, std::uint8_t apid, std::uint16_t count) {
    Stream bytes = {first, apid, static_cast<std::uint8_t>(0xC0 | count >> 8), static_cast<std::uint8_t>(count), 0, 4, 1, 2, 3, 0, 0};
    repair_crc(bytes);
    return bytes;
  };
  Stream stream = packet(0x04, 0xC0, 0x3FFF);
  append(stream, packet(0x14, 0xC0, 5));
  append(stream, packet(0x04, 0xC0, 0));
  append(stream, packet(0x04, 0xC0, 3));
  Stream wrong = packet(0x14, 0xC0, 6);
  wrong[7] ^= 1;
  append(stream, wrong);
  append(stream, {0x04, 0xC0, 0xC0});
  const HeaderList list = list_headers(view(stream));
  ASSERT_EQ(list.lines.size(), 5U);
  EXPECT_EQ(list.left_over, 3U);
  EXPECT_EQ(list.lines[0].header.apid, 0x4C0);
  EXPECT_EQ(list.lines[1].header.type, PacketType::kCommand);
  EXPECT_EQ(list.lines[2].missing, 0U);
  EXPECT_EQ(list.lines[3].missing, 2U);
  EXPECT_EQ(list.lines[4].missing, 0U);
  EXPECT_TRUE(list.lines[3].crc_right);
  EXPECT_FALSE(list.lines[4].crc_right);
  EXPECT_EQ(
      headers_summary(list),
      "5 packets: CRC right in 4, wrong in 1; 1 gaps in the sequence, 2 packets missing, 0 repeated or out of order; 3 bytes left over\n");
}

TEST(Headers, ARepeatedPacketIsNoGap) {
  VERIFIES("LASSO-GND-021~1");
  Stream stream;
  for (const std::uint16_t count : std::initializer_list<std::uint16_t>{0x3FFE, 0x3FFF, 0x3FFF, 0, 0x3FFF, 1, 3, 2, 4})
    append(stream, pose_packet(count));
  const HeaderList list = list_headers(view(stream));
  std::string behind, missing;
  for (const HeaderLine& line : list.lines) {
    behind += line.behind ? '1' : '0';
    missing += std::to_string(line.missing);
  }
  EXPECT_EQ(behind, "001010010");
  EXPECT_EQ(missing, "000000100");
  EXPECT_NE(headers_summary(list).find("1 gaps in the sequence, 1 packets missing, 3 repeated or out of order"), std::string::npos);
}

TEST(Headers, EndsWhereNoPacketCanBe) {
  VERIFIES("LASSO-GND-021~1");
  const Stream version = {0x24, 0xC0, 0xC0, 0, 0, 0, 0};
  EXPECT_EQ(list_headers(view(version)).left_over, version.size());
  const Stream cut = {0x04, 0xC0, 0xC0, 0, 0, 9, 0};
  EXPECT_EQ(list_headers(view(cut)).left_over, cut.size());
  EXPECT_EQ(list_headers({}).left_over, 0U);
}

TEST(DecodeText, MarksWhatIsOutOfRange) {
  VERIFIES("LASSO-GND-021~1");
  PoseTelemetry pose;
  pose.inlier_share = 1.5F;
  pose.mode = 77;
  const Stream stream = pose_packet(0, pose);
  const std::string text = table_text(decode_stream(view(stream), PacketType::kTelemetry), {});
  EXPECT_NE(text.find("inlier_share               1.5 (!)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("mode                       77 (!)\n"), std::string::npos);
  EXPECT_NE(text.find("reason                     valid\n"), std::string::npos);
}

TEST(DecodeText, WritesTheSmallestAndLargestNumbersAsTheyAre) {
  VERIFIES("LASSO-GND-021~1");
  PoseTelemetry pose;
  pose.p_sensor_target_m[0] = 5e-324;
  pose.p_sensor_target_m[1] = -1.7976931348623157e308;
  pose.rms_m = 1e-45F;
  const Stream stream = pose_packet(0, pose);
  const std::string text = json_text(decode_stream(view(stream), PacketType::kTelemetry), {});
  EXPECT_NE(text.find("5e-324"), std::string::npos);
  EXPECT_NE(text.find("-1.7976931348623157e+308"), std::string::npos);
  EXPECT_NE(text.find("\"rms_m\": 1e-45"), std::string::npos);
}

TEST(DecodeText, ShowsTheSelectedItems) {
  VERIFIES("LASSO-GND-021~1");
  Stream stream = pose_packet(3);
  append(stream, pose_packet(4));
  const DecodedStream decoded = decode_stream(view(stream), PacketType::kTelemetry);
  const Selection selection{"pose", {"mode", "plan_center"}};
  EXPECT_EQ(csv_text(decoded, selection),
            "offset,sequence_count,time_s,mode,plan_center_0,plan_center_1\n0,3,1.5000000,standby,0,0\n835,4,1.5000000,standby,0,0\n");
  EXPECT_EQ(table_text(decoded, selection), "pose       #3 1.500000 s  standby  0 0\npose       #4 1.500000 s  standby  0 0\n");
  EXPECT_THROW(check_selection({"pos", {}}), InputError);
  EXPECT_THROW(check_selection({"", {"mode", "colour"}}), InputError);
  EXPECT_NO_THROW(check_selection(selection));
}

TEST(DecodeText, CaptureHoldsThePacketsAtTheirTimes) {
  VERIFIES("LASSO-GND-021~1");
  const Stream stream = pose_packet(3);
  const std::string capture = pcap_bytes(decode_stream(view(stream), PacketType::kTelemetry));
  ASSERT_EQ(capture.size(), 24 + 16 + stream.size());
  EXPECT_EQ(capture.substr(0, 4), "\xD4\xC3\xB2\xA1");
  EXPECT_EQ(static_cast<unsigned char>(capture[20]), 147);
  EXPECT_EQ(capture.substr(24, 8), std::string("\x01\0\0\0\x20\xA1\x07\0", 8)) << "1 s, 500000 us";
  EXPECT_EQ(capture.substr(40), std::string(stream.begin(), stream.end()));
}

}  // namespace
}  // namespace lasso::mdat
