#include "mdat/link/station.hpp"

#include <gtest/gtest.h>

#include "fsw/core/byte_codec.hpp"
#include "fsw/link/downlink.hpp"
#include "fsw/link/link_report.hpp"
#include "mdat/common/errors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// A component that answers each command alike.
class AlikeLink final : public ByteLink {
 public:
  AlikeLink(std::uint8_t subservice, PacketFault fault, std::uint8_t service_refusal, std::uint16_t apid = kApid)
      : subservice_(subservice), fault_(fault), service_refusal_(service_refusal), downlink_(apid) {}
  bool datagrams() const override { return true; }
  std::size_t read(Bytes out) override { return downlink_.take(out); }
  std::size_t write(ConstBytes command) override {
    ByteReader reader(command);
    Verification verification;
    verification.packet_id = reader.u16();
    verification.sequence_control = reader.u16();
    verification.fault = static_cast<std::uint8_t>(fault_);
    verification.service_refusal = service_refusal_;
    std::uint8_t packet[kMaxLinkReportBytes];
    const PacketHeader header = downlink_.next_header({kServiceVerification, subservice_}, 0);
    downlink_.send({packet, encode_verification(verification, header, Bytes(packet))});
    return command.size();
  }

 private:
  std::uint8_t subservice_;
  PacketFault fault_;
  std::uint8_t service_refusal_;
  Downlink downlink_;
};

// Why sending without waiting failed, by an answer of each kind.
std::string failure_after(std::uint8_t subservice, PacketFault fault, std::uint8_t service_refusal) {
  AlikeLink link(subservice, fault, service_refusal);
  Station station(link, "link", [](const DecodedPacket&) {});
  station.send(command_row("ping"), {});
  EXPECT_EQ(station.unanswered(), 1U);
  EXPECT_TRUE(station.listen(5, [&] { return station.unanswered() == 0; }));
  return station.failure();
}

TEST(Station, WhatOthersOvertookIsLostAndHasNotFailed) {
  VERIFIES("LASSO-IMG-012~1");
  EXPECT_EQ(failure_after(kSubserviceCompleted, PacketFault::kNone, 0), "");
  EXPECT_EQ(failure_after(kSubserviceRefused, PacketFault::kRepeated, 0), "");
  EXPECT_EQ(failure_after(kSubserviceRefused, PacketFault::kNotAuthentic, 0), "");
  EXPECT_NE(failure_after(kSubserviceFailed, PacketFault::kNone, 1), "");
}

TEST(Station, ACommandThatIsRefusedIsNotDoneAndSaysWhy) {
  VERIFIES("LASSO-IMG-012~1");
  AlikeLink link(kSubserviceRefused, PacketFault::kNotAuthentic, 0);
  Station station(link, "link", [](const DecodedPacket&) {});
  const CommandAnswer answer = station.command(command_row("ping"), {}, false, 5);
  EXPECT_EQ(answer.outcome, Outcome::kRefused);
  EXPECT_NE(answer.why.find("not_authentic"), std::string::npos) << answer.why;
}

// A component that is sent, with the operator's command, another packet of its count: it refuses that, and carries out the command.
class ImitatedLink final : public ByteLink {
 public:
  explicit ImitatedLink(bool before) : before_(before) {}
  bool datagrams() const override { return false; }
  std::size_t read(Bytes out) override { return downlink_.take(out); }
  std::size_t write(ConstBytes command) override {
    for (const bool refuses : {before_, !before_}) {
      Verification verification;
      verification.packet_id = static_cast<std::uint16_t>(command_key(command) >> 16);
      verification.sequence_control = static_cast<std::uint16_t>(command_key(command));
      verification.fault = static_cast<std::uint8_t>(refuses ? PacketFault::kNotAuthentic : PacketFault::kNone);
      std::uint8_t packet[kMaxLinkReportBytes];
      const std::uint8_t subservice = refuses ? kSubserviceRefused : kSubserviceCompleted;
      downlink_.send(
          {packet, encode_verification(verification, downlink_.next_header({kServiceVerification, subservice}, 0), Bytes(packet))});
    }
    return command.size();
  }

 private:
  bool before_;
  Downlink downlink_;
};

TEST(Station, ARefusalOfAnothersPacketIsNoneOfASignedCommand) {
  VERIFIES("LASSO-LNK-049~1");
  for (const bool before : {true, false}) {
    ImitatedLink link(before);
    Station station(link, "link", [](const DecodedPacket&) {});
    station.sign_with(Key{std::vector<std::uint8_t>(32, 1), 0});
    EXPECT_EQ(station.command(command_row("ping"), {}, false, 5).outcome, Outcome::kDone) << before;
  }
}

TEST(Station, ACallThatIsRefusedSaysWhyUntilOneIsTaken) {
  VERIFIES("LASSO-IMG-012~1");
  AlikeLink refusing(kSubserviceRefused, PacketFault::kNotAuthentic, 0);
  Station station(refusing, "link", [](const DecodedPacket&) {});
  EXPECT_EQ(station.call_refusal(), "");
  ASSERT_TRUE(station.call());
  EXPECT_TRUE(station.listen(5, [&] { return !station.call_refusal().empty(); }));
  EXPECT_NE(station.call_refusal().find("not_authentic"), std::string::npos) << station.call_refusal();
  AlikeLink repeating(kSubserviceRefused, PacketFault::kRepeated, 0);
  Station overtaken(repeating, "link", [](const DecodedPacket&) {});
  ASSERT_TRUE(overtaken.call());
  EXPECT_FALSE(overtaken.listen(0.05, [&] { return !overtaken.call_refusal().empty(); })) << "its count alone";
}

// Where there is no authenticator, a signature is bytes too many.
TEST(Station, ASignatureThatNobodyAskedForIsToldAsSuch) {
  VERIFIES("LASSO-IMG-012~1");
  for (const bool is_signed : {false, true}) {
    AlikeLink link(kSubserviceRefused, PacketFault::kBadLength, 0);
    Station station(link, "link", [](const DecodedPacket&) {});
    if (is_signed) station.sign_with(Key{});
    const CommandAnswer answer = station.command(command_row("ping"), {}, false, 5);
    EXPECT_EQ(answer.why.find("--key") != std::string::npos, is_signed) << answer.why;
  }
}

// A component whose last command had the count half of all before the first one that comes.
class CountingLink final : public ByteLink {
 public:
  bool datagrams() const override { return true; }
  std::size_t read(Bytes out) override { return downlink_.take(out); }
  std::size_t write(ConstBytes command) override {
    ++sent;
    const bool repeated = sent <= repeated_first;
    accepted += repeated ? 0U : 1U;
    Verification verification;
    verification.packet_id = static_cast<std::uint16_t>(command_key(command) >> 16);
    verification.sequence_control = static_cast<std::uint16_t>(command_key(command));
    verification.fault = static_cast<std::uint8_t>(repeated ? PacketFault::kRepeated : PacketFault::kNone);
    std::uint8_t packet[kMaxLinkReportBytes];
    const std::uint8_t subservice = repeated ? kSubserviceRefused : kSubserviceCompleted;
    const PacketHeader header = downlink_.next_header({kServiceVerification, subservice}, 0);
    downlink_.send({packet, encode_verification(verification, header, Bytes(packet))});
    return command.size();
  }
  std::uint32_t repeated_first = 0, sent = 0, accepted = 0;

 private:
  Downlink downlink_;
};

TEST(Station, ACallThatIsRefusedForItsCountIsMadeOnceMore) {
  VERIFIES("LASSO-GND-161~2");
  CountingLink link;
  Station station(link, "link", [](const DecodedPacket&) {});
  link.repeated_first = 1;
  ASSERT_TRUE(station.call());
  EXPECT_TRUE(station.listen(5, [&] { return link.accepted == 1; }));
  link.repeated_first = 1000;
  ASSERT_TRUE(station.call());
  EXPECT_FALSE(station.listen(0.1, [&] { return link.sent > 4; })) << "no storm";
}

TEST(Station, ACommandOvertakenByAnothersCountIsSentWithOneThatIsTaken) {
  VERIFIES("LASSO-GND-165~1");
  CountingLink link;
  Station station(link, "link", [](const DecodedPacket&) {});
  EXPECT_EQ(station.command(command_row("ping"), {}, false, 5).outcome, Outcome::kDone);
  link.repeated_first = link.sent + 1;
  EXPECT_EQ(station.command(command_row("ping"), {}, false, 5).outcome, Outcome::kDone);
  station.set_count(7);
  link.repeated_first = link.sent + 1;
  EXPECT_EQ(station.command(command_row("ping"), {}, false, 5).outcome, Outcome::kRepeated) << "the user's count is kept";
}

// Nobody is there.
class MuteLink final : public ByteLink {
 public:
  bool datagrams() const override { return true; }
  std::size_t read(Bytes) override { return 0; }
  std::size_t write(ConstBytes command) override { return command.size(); }
};

TEST(Station, SilenceIsToldOnceAndWaitedThroughAsLongAsWasAsked) {
  VERIFIES("LASSO-GND-164~1");
  MuteLink link;
  Station station(link, "link", [](const DecodedPacket&) {});
  int told = 0;
  station.on_silence(0.02, [&] { ++told; });
  EXPECT_EQ(station.command(command_row("ping"), {}, false, 0.06).outcome, Outcome::kOpen);
  EXPECT_EQ(station.command(command_row("ping"), {}, false, 0.06).outcome, Outcome::kOpen);
  EXPECT_EQ(told, 1);
}

TEST(Station, WhoHasGoneIsNotWaitedFor) {
  VERIFIES("LASSO-GND-164~1");
  MuteLink link;
  Station station(link, "link", [](const DecodedPacket&) {});
  station.end_where([] { return true; });
  try {
    static_cast<void>(station.command(command_row("ping"), {}, false, 60));
    ADD_FAILURE();
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("link: the other end has closed the link", 0), 0U) << error.what();
  }
  EXPECT_TRUE(station.listen(60, [] { return true; })) << "what is done is done";
}

TEST(Station, SpeaksWithTheComponentThatItIsMadeFor) {
  VERIFIES("LASSO-LNK-044~1");
  for (const std::uint16_t apid : {kApid, std::uint16_t{0x2A5}}) {
    AlikeLink link(kSubserviceCompleted, PacketFault::kNone, 0, 0x2A5);
    Station station(
        link, "link", [](const DecodedPacket&) {}, apid);
    const bool is_its_own = apid == 0x2A5;
    const CommandAnswer answer = station.command(command_row("ping"), {}, false, is_its_own ? 5 : 0.02);
    EXPECT_EQ(answer.outcome, is_its_own ? Outcome::kDone : Outcome::kOpen) << apid;
    EXPECT_EQ(station.other_bytes() == 0, is_its_own) << apid;
  }
}

}  // namespace
}  // namespace lasso::mdat
