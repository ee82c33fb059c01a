#include "mdat/link/decode.hpp"

#include "fsw/core/crc.hpp"
#include "fsw/link/packet_finder.hpp"
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

const std::size_t kPoseBytes = pose_packet(0).size();

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
  VERIFIES("LASSO-GND-021~2");
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

TEST(Decode, FindsTheComponentThatIsAskedForAlone) {
  VERIFIES("LASSO-LNK-044~1");
  Stream stream = pose_packet(7, {});
  const std::size_t first = stream.size();
  const Stream other = lasso::test::for_apid(pose_packet(8, {}), 0x2A5);
  stream.insert(stream.end(), other.begin(), other.end());
  const DecodedStream preset = decode_stream(view(stream), PacketType::kTelemetry);
  ASSERT_EQ(preset.packets.size(), 1U);
  EXPECT_EQ(preset.packets[0].offset, 0U);
  EXPECT_EQ(preset.other_bytes, other.size());
  const DecodedStream asked = decode_stream(view(stream), PacketType::kTelemetry, 0x2A5);
  ASSERT_EQ(asked.packets.size(), 1U);
  EXPECT_EQ(asked.packets[0].offset, first);
  EXPECT_STREQ(asked.packets[0].name(), "pose");
  EXPECT_EQ(apid_of(asked.packets[0].bytes), 0x2A5);
  EXPECT_EQ(apid_of({}), kApid);
}

TEST(Decode, AgreesWithTheFlightDecoderForAllBytes) {
  VERIFIES("LASSO-GND-021~2");
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
    EXPECT_EQ(std::get<std::int64_t>(item(ground, "inconsistent_parts").values[0]), pose.inconsistent_parts);
    EXPECT_EQ(text_of(item(ground, "bearing").values[5]), text_of(Number(pose.bearing[5])));
  }
}

TEST(Decode, FindsPacketsBetweenGarbageAndBehindABrokenOne) {
  VERIFIES("LASSO-GND-021~2");
  Stream stream = {1, 2, 0x0B, 3};
  append(stream, pose_packet(1));
  stream.resize(stream.size() - 100);  // the rest of the packet is lost
  append(stream, pose_packet(2));
  append(stream, {0x0B, 0xD1, 0xFF, 0xFF, 0xFF, 0x00});  // seems to begin a packet that is longer than the stream
  append(stream, pose_packet(3));
  const DecodedStream decoded = decode_stream(view(stream), PacketType::kTelemetry);
  ASSERT_EQ(decoded.packets.size(), 2U);
  EXPECT_EQ(decoded.packets[0].header.at(5), 2U);
  EXPECT_EQ(decoded.packets[0].offset, 4U + kPoseBytes - 100);
  EXPECT_EQ(decoded.packets[1].header.at(5), 3U);
  EXPECT_EQ(decoded.packets[1].offset, stream.size() - kPoseBytes);
  EXPECT_EQ(decoded.other_bytes, stream.size() - 2 * kPoseBytes);
}

TEST(Decode, SaysWhatTheDictionaryDoesNotHave) {
  VERIFIES("LASSO-GND-021~2");
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
  VERIFIES("LASSO-GND-021~2");
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

// Looking at every place of a stream finds what the flight code's finder finds in it.
TEST(Decode, FindsWhatTheFlightFinderFinds) {
  VERIFIES("LASSO-GND-021~2");
  test::Generator random(5);
  Stream stream;
  for (std::uint16_t count = 0; count < 20; ++count) {
    append(stream, pose_packet(count));
    for (std::uint64_t n = random.bits() % 40; n > 0; --n) stream.push_back(static_cast<std::uint8_t>(random.bits()));
    if (count % 3 == 0) append(stream, {0x0B, 0xD1, 0xC0, 0x00, 0x07, 0x00});  // a header over the next packets
    if (count % 4 == 0) stream[stream.size() - 50] ^= 4;
  }
  std::vector<std::uint8_t> buffer(65542);
  PacketFinder finder(PacketType::kTelemetry, Bytes(buffer.data(), buffer.size()));
  const DecodedStream decoded = decode_stream(view(stream), PacketType::kTelemetry);
  std::size_t taken = 0, found = 0;
  do {
    taken += finder.take(ConstBytes(stream.data() + taken, stream.size() - taken));
    if (finder.packet().empty()) continue;
    ASSERT_LT(found, decoded.packets.size());
    EXPECT_EQ(decoded.packets[found].offset, found * kPoseBytes + finder.skipped());
    ++found;
  } while (!finder.packet().empty() || finder.give_up());
  EXPECT_EQ(found, decoded.packets.size());
  EXPECT_GT(found, 10U);
}

TEST(DecodeText, MarksWhatIsOutOfRange) {
  VERIFIES("LASSO-GND-021~2");
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
  VERIFIES("LASSO-GND-021~2");
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
  VERIFIES("LASSO-GND-021~2");
  Stream stream = pose_packet(3);
  append(stream, pose_packet(4));
  const DecodedStream decoded = decode_stream(view(stream), PacketType::kTelemetry);
  const Selection selection{"pose", {"mode", "plan_center"}};
  EXPECT_EQ(csv_text(decoded, selection), "offset,sequence_count,time_s,mode,plan_center_0,plan_center_1\n0,3,1.5000000,standby,0,0\n" +
                                              std::to_string(kPoseBytes) + ",4,1.5000000,standby,0,0\n");
  EXPECT_EQ(table_text(decoded, selection), "pose       #3 1.500000 s  standby  0 0\npose       #4 1.500000 s  standby  0 0\n");
  EXPECT_THROW(check_selection({"pos", {}}), InputError);
  EXPECT_THROW(check_selection({"", {"mode", "colour"}}), InputError);
  EXPECT_NO_THROW(check_selection(selection));
}

TEST(DecodeText, CaptureHoldsThePacketsAtTheirTimes) {
  VERIFIES("LASSO-GND-021~2");
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
