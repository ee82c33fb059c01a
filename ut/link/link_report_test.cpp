#include "fsw/link/link_report.hpp"

#include <iterator>
#include <utility>

#include "fsw/link/dictionary.hpp"
#include "ut/link/command_packets.hpp"
#include "ut/support/generator.hpp"

namespace lasso {
namespace {

using test::Stream;

Stream encode(std::uint8_t subservice, const Verification& verification, std::size_t room = kMaxLinkReportBytes) {
  PacketHeader header;
  header.service = kServiceVerification;
  header.subservice = subservice;
  header.message_count = 5;
  Stream packet(room);
  packet.resize(encode_verification(verification, header, Bytes(packet.data(), packet.size())));
  return packet;
}

constexpr Verification kSample{0x1BD1, 0xC007, 3, 4, 5, 6};

Stream data_of(const Stream& packet) {
  PacketHeader header;
  ConstBytes data;
  EXPECT_EQ(parse_packet(test::view(packet), header, data), PacketFault::kNone);
  return Stream(data.begin(), data.end());
}

TEST(LinkReport, AnAnswerNamesItsCommand) {
  VERIFIES("LASSO-LNK-013~2");
  const Stream answer = encode(kSubserviceRefused, kSample);
  std::uint32_t key = 0;
  ASSERT_TRUE(is_answer(test::view(answer), key));
  EXPECT_EQ(key, 0x1BD1C007u);
  EXPECT_EQ(key, command_key(test::view(Stream{0x1B, 0xD1, 0xC0, 0x07})));
  Stream other = answer;
  other[kPrimaryHeaderBytes + 1] = kServiceVerification + 1;
  EXPECT_FALSE(is_answer(test::view(other), key));
  EXPECT_FALSE(is_answer(ConstBytes(answer.data(), kPacketHeaderBytes - 1), key));
  EXPECT_EQ(key, 0x1BD1C007u);
}

TEST(LinkReport, VerificationSaysWhichCommandAndWhy) {
  VERIFIES("LASSO-LNK-013~2");
  EXPECT_EQ(data_of(encode(kSubserviceAccepted, kSample)), (Stream{0x1B, 0xD1, 0xC0, 0x07}));
  EXPECT_EQ(data_of(encode(kSubserviceRefused, kSample)), (Stream{0x1B, 0xD1, 0xC0, 0x07, 3}));
  EXPECT_EQ(data_of(encode(kSubserviceStarted, kSample)), (Stream{0x1B, 0xD1, 0xC0, 0x07}));
  EXPECT_EQ(data_of(encode(kSubserviceCompleted, kSample)), (Stream{0x1B, 0xD1, 0xC0, 0x07}));
  EXPECT_EQ(data_of(encode(kSubserviceFailed, kSample)), (Stream{0x1B, 0xD1, 0xC0, 0x07, 4, 5, 6}));
  EXPECT_EQ(encode(kSubserviceFailed, kSample)[7], 1) << "numbers of ECSS-E-ST-70-41C";
  EXPECT_EQ(encode(kSubserviceAccepted, kSample)[8], 1);
  EXPECT_EQ(encode(kSubserviceRefused, kSample)[8], 2);
  EXPECT_EQ(encode(kSubserviceStarted, kSample)[8], 3);
  EXPECT_EQ(encode(kSubserviceCompleted, kSample)[8], 7);
  EXPECT_EQ(encode(kSubserviceFailed, kSample)[8], 8);
  EXPECT_EQ(encode(kSubserviceFailed, kSample)[10], 5);
  EXPECT_TRUE(encode(kSubserviceFailed, kSample, 28).empty());
}

TEST(LinkReport, CountersAreAStructureOfTheirOwn) {
  VERIFIES("LASSO-LNK-002~1");
  const LinkTelemetry link{0x01020304, 5, 6, 0x0A0B0C0D, 0x0E0F, 1, 0, -2};
  Stream packet(kMaxLinkReportBytes);
  packet.resize(encode_link(link, PacketHeader{}, Bytes(packet.data(), packet.size())));
  EXPECT_EQ(packet[7], kServiceHousekeeping);
  EXPECT_EQ(packet[8], kSubserviceHousekeepingReport);
  EXPECT_EQ(data_of(packet), (Stream{0,    2,    1,    2, 3, 4,    0,    0,    0,    5,    6,    0x0A, 0x0B, 0x0C,
                                     0x0D, 0x0E, 0x0F, 1, 0, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFE}));
}

TEST(LinkReport, PongHasNoData) {
  VERIFIES("LASSO-LNK-002~1");
  Stream packet(kMaxLinkReportBytes);
  packet.resize(encode_pong(PacketHeader{}, Bytes(packet.data(), packet.size())));
  EXPECT_EQ(packet[7], kServiceTest);
  EXPECT_EQ(packet[8], kSubservicePong);
  EXPECT_TRUE(data_of(packet).empty());
}

// Any bytes, through the values that they stand for.
template <class Packet, std::size_t kRows>
void expect_round_trip(const TypedRow<Packet> (&rows)[kRows], test::Generator& random) {
  const auto codec = codec_of(rows);
  for (int i = 0; i < 100; ++i) {
    Stream bytes(codec.bytes), again(codec.bytes);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.bits());
    Packet packet;
    ByteReader in(test::view(bytes));
    codec.read(in, packet);
    ByteWriter out{Bytes(again.data(), again.size())};
    codec.write(packet, out);
    ASSERT_TRUE(in.ok() && in.remaining() == 0 && out.ok());
    ASSERT_EQ(again, bytes);
  }
}

TEST(LinkReport, EncodeDecodeEncodeIsByteIdenticalForEveryRow) {
  VERIFIES("LASSO-LNK-023~2");
  test::Generator random(23);
  expect_round_trip(pose_rows::kRows, random);
  expect_round_trip(health_rows::kRows, random);
  expect_round_trip(link_report_rows::kLink, random);
  expect_round_trip(sensor_report_rows::kRows, random);
  expect_round_trip(link_report_rows::kDone, random);
  expect_round_trip(link_report_rows::kRefused, random);
  expect_round_trip(link_report_rows::kFailed, random);
  expect_round_trip(command_rows::kMode, random);
  expect_round_trip(command_rows::kHold, random);
  expect_round_trip(command_rows::kStart, random);
  expect_round_trip(command_rows::kEvent, random);
  expect_round_trip(link_report_rows::kDisabled, random);
  expect_round_trip(command_rows::kArm, random);
  expect_round_trip(command_rows::kPeriod, random);
  expect_round_trip(command_rows::kTime, random);
  expect_round_trip(command_rows::kParameter, random);
  expect_round_trip(command_rows::kSetParameter, random);
  expect_round_trip(link_report_rows::kParameter, random);
  expect_round_trip(link_report_rows::kStoredEvent, random);
  expect_round_trip(command_rows::kStored, random);
  expect_round_trip(command_rows::kStructure, random);
  expect_round_trip(command_rows::kCalibration, random);
  expect_round_trip(command_rows::kKey, random);
  expect_round_trip(filter_rows::kRows, random);
  expect_round_trip(named_pose_rows::kRows, random);
  expect_round_trip(memory_rows::kBegin, random);
  expect_round_trip(memory_rows::kActivate, random);
  expect_round_trip(memory_rows::kLoad, random);
  expect_round_trip(memory_rows::kRange, random);
  expect_round_trip(memory_rows::kDumped, random);
  expect_round_trip(memory_rows::kChecked, random);
  expect_round_trip(memory_rows::kImage, random);
}

TEST(LinkReport, EveryPacketOfTheDictionaryIsAsLongAsItSays) {
  VERIFIES("LASSO-LNK-002~1");
  const std::size_t sizes[] = {835, 49, 143, 58, 146, 453, 604, 156, 35, 26, 27, 26, 26, 29, 22, 38, 41,  74, 13, 16, 16, 212, 15, 15,
                               13,  19, 15,  15, 15,  15,  15,  17,  29, 15, 23, 13, 23, 15, 19, 15, 147, 22, 22, 15, 13, 13,  18, 17};
  std::size_t next = 0;
  for (const PacketRow& packet : kPackets) {
    if (next == std::size(sizes)) break;
    EXPECT_EQ(item_offset(packet, packet.items.size()) + kPacketTrailerBytes, sizes[next++]) << packet.name;
  }
  EXPECT_EQ(encode(kSubserviceAccepted, kSample).size(), 26u);
  EXPECT_EQ(encode(kSubserviceRefused, kSample).size(), 27u);
  EXPECT_EQ(encode(kSubserviceFailed, kSample).size(), 29u);
  std::size_t event = kPackets.size() - kEvents;
  for (const std::size_t items : std::initializer_list<std::size_t>{13, 3, 2, 5, 7, 4, 4, 3, 1, 1, 6,  4, 4, 5, 6, 4, 4, 4,
                                                                    0,  0, 8, 5, 9, 6, 4, 6, 2, 1, 10, 0, 0, 0, 0, 3, 0, 6}) {
    const PacketRow& packet = kPackets[++event];
    EXPECT_EQ(item_offset(packet, packet.items.size()), 22 + items) << packet.name;
  }
}

TEST(LinkReport, RefusalsHaveTheNumbersThatTheDictionaryNames) {
  VERIFIES("LASSO-LNK-002~1 LASSO-LNK-013~2");
  const std::pair<ServiceRefusal, const char*> names[] = {{ServiceRefusal::kNone, "none"},
                                                          {ServiceRefusal::kNoSuchEvent, "no_such_event"},
                                                          {ServiceRefusal::kNotArmed, "not_armed"},
                                                          {ServiceRefusal::kNotHazardous, "not_hazardous"},
                                                          {ServiceRefusal::kNoSuchStructure, "no_such_structure"},
                                                          {ServiceRefusal::kNoSuchParameter, "no_such_parameter"},
                                                          {ServiceRefusal::kFixedParameter, "fixed_parameter"},
                                                          {ServiceRefusal::kOutOfLimits, "out_of_limits"},
                                                          {ServiceRefusal::kInconsistent, "inconsistent"},
                                                          {ServiceRefusal::kNoImageBuffer, "no_image_buffer"},
                                                          {ServiceRefusal::kTooLong, "too_long"},
                                                          {ServiceRefusal::kNotOpen, "not_open"},
                                                          {ServiceRefusal::kOutside, "outside"},
                                                          {ServiceRefusal::kNotWhole, "not_whole"},
                                                          {ServiceRefusal::kIncomplete, "incomplete"},
                                                          {ServiceRefusal::kImageBusy, "image_busy"},
                                                          {ServiceRefusal::kImageNotReady, "image_not_ready"},
                                                          {ServiceRefusal::kOtherImage, "other_image"},
                                                          {ServiceRefusal::kDoesNotFit, "does_not_fit"},
                                                          {ServiceRefusal::kNotAllowed, "not_allowed"},
                                                          {ServiceRefusal::kModeSafe, "mode_safe"},
                                                          {ServiceRefusal::kNoStore, "no_store"},
                                                          {ServiceRefusal::kStoreFailed, "store_failed"},
                                                          {ServiceRefusal::kNothingStored, "nothing_stored"},
                                                          {ServiceRefusal::kOtherTable, "other_table"},
                                                          {ServiceRefusal::kNoCalibration, "no_calibration"},
                                                          {ServiceRefusal::kNoSuchKey, "no_such_key"},
                                                          {ServiceRefusal::kKeyOnTrial, "key_on_trial"},
                                                          {ServiceRefusal::kNoKeyOnTrial, "no_key_on_trial"},
                                                          {ServiceRefusal::kNotByNewKey, "not_by_new_key"},
                                                          {ServiceRefusal::kNotKept, "not_kept"}};
  ASSERT_EQ(kServiceRefusal.choices.size(), std::size(names));
  for (const auto& [refusal, name] : names)
    EXPECT_STREQ(Span<const Choice>(kServiceRefusal.choices)[static_cast<std::size_t>(refusal)].name, name);
}

}  // namespace
}  // namespace lasso
