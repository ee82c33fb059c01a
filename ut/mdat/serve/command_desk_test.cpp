#include "mdat/serve/command_desk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "fsw/core/byte_codec.hpp"
#include "fsw/link/downlink.hpp"
#include "fsw/link/link_report.hpp"
#include "mdat/serve/http.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

// A component that reports each command with these subservices, in this order.
class AnsweringLink final : public ByteLink {
 public:
  explicit AnsweringLink(std::vector<std::uint8_t> subservices) : subservices_(std::move(subservices)) {}
  bool datagrams() const override { return true; }
  std::size_t read(Bytes out) override { return downlink_.take(out); }
  std::size_t write(ConstBytes command) override {
    commands.emplace_back(command.data(), command.data() + command.size());
    for (const std::uint8_t subservice : subservices_) {
      ByteReader reader(command);
      Verification verification;
      verification.packet_id = reader.u16();
      verification.sequence_control = reader.u16();
      verification.fault = subservice == kSubserviceRefused ? static_cast<std::uint8_t>(PacketFault::kNotAuthentic) : 0;
      verification.service_refusal = subservice == kSubserviceFailed ? 1 : 0;
      std::uint8_t packet[kMaxLinkReportBytes];
      const PacketHeader header = downlink_.next_header({kServiceVerification, subservice}, 0);
      downlink_.send({packet, encode_verification(verification, header, Bytes(packet))});
    }
    return command.size();
  }
  std::vector<std::vector<std::uint8_t>> commands;

 private:
  std::vector<std::uint8_t> subservices_;
  Downlink downlink_;
};

// The phases of one command, as they were told.
std::vector<std::string> phases(AnsweringLink& link, const CommandOrder& order, std::string& why) {
  CommandDesk desk;
  desk.order(order);
  EXPECT_TRUE(desk.waiting());
  Station station(link, "link", [](const DecodedPacket&) {});
  std::vector<std::string> told = {phase_name(desk.records().back().phase)};
  desk.work(station, [&] { told.emplace_back(phase_name(desk.records().back().phase)); });
  EXPECT_FALSE(desk.waiting());
  why = desk.records().back().why;
  return told;
}

TEST(CommandDesk, ACommandTellsHowFarItIs) {
  VERIFIES("LASSO-WEB-023~1");
  std::string why;
  AnsweringLink done({kSubserviceAccepted, kSubserviceCompleted});
  EXPECT_EQ(phases(done, {"ping", {}, false}, why), (std::vector<std::string>{"waiting", "sent", "accepted", "executed"}));
  EXPECT_EQ(why, "");
  AnsweringLink failed({kSubserviceAccepted, kSubserviceFailed});
  EXPECT_EQ(phases(failed, {"ping", {}, false}, why), (std::vector<std::string>{"waiting", "sent", "accepted", "failed"}));
  EXPECT_NE(why, "");
  AnsweringLink refused({kSubserviceRefused});
  EXPECT_EQ(phases(refused, {"ping", {}, false}, why), (std::vector<std::string>{"waiting", "sent", "refused"}));
  EXPECT_NE(why.find("not_authentic"), std::string::npos) << why;
  AnsweringLink silent({});
  EXPECT_EQ(phases(silent, {"ping", {}, false}, why), (std::vector<std::string>{"waiting", "sent", "unanswered"}));
}

TEST(CommandDesk, ArmingSendsTheCommandThatArmsAndNothingElse) {
  VERIFIES("LASSO-WEB-024~1");
  std::string why;
  AnsweringLink link({kSubserviceCompleted});
  EXPECT_EQ(phases(link, {"enable_laser", {}, true}, why).back(), "executed");
  ASSERT_EQ(link.commands.size(), 1U);
  const std::vector<std::uint8_t>& sent = link.commands.front();
  EXPECT_EQ(decode_packet({sent.data(), sent.size()}, PacketType::kCommand).name(), std::string("arm"));
}

TEST(CommandDesk, WhatTheDictionaryDoesNotHaveIsRefusedInItsWords) {
  VERIFIES("LASSO-WEB-023~1");
  CommandDesk desk;
  const auto why = [&](const CommandOrder& order) -> std::string {
    try {
      desk.order(order);
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.status, 400U);
      return refusal.what;
    }
    return "";
  };
  EXPECT_NE(why({"fly", {}, false}).find("fly: no command of the dictionary"), std::string::npos);
  EXPECT_NE(why({"set_mode", {{"mode", "away"}}, false}).find("mode=away"), std::string::npos);
  EXPECT_NE(why({"set_mode", {}, false}).find("mode is missing"), std::string::npos);
  EXPECT_NE(why({"ping", {}, true}).find("is not hazardous"), std::string::npos);
  EXPECT_EQ(why({"set_mode", {}, false}).find('\n'), std::string::npos);
  EXPECT_TRUE(desk.records().empty());
  for (int i = 0; i < 8; ++i) desk.order({"ping", {}, false});
  EXPECT_THROW(desk.order({"ping", {}, false}), Refusal);
  EXPECT_EQ(desk.records().size(), 8U);
}

TEST(CommandDesk, WhatWaitsForALostLinkIsNotSentLater) {
  VERIFIES("LASSO-WEB-023~1");
  CommandDesk desk;
  desk.order({"ping", {}, false});
  desk.order({"ping", {}, false});
  AnsweringLink link({kSubserviceCompleted});
  Station station(link, "link", [](const DecodedPacket&) {});
  desk.work(station, [] {});
  desk.drop("the link has ended");
  desk.work(station, [] {});
  EXPECT_EQ(link.commands.size(), 1U);
  EXPECT_EQ(phase_name(desk.records().front().phase), std::string("executed"));
  EXPECT_EQ(phase_name(desk.records().back().phase), std::string("not_sent"));
  EXPECT_EQ(desk.records().back().why, "the link has ended");
}

TEST(CommandDesk, AllCommandsAreToldWithTheirItemsAndChoices) {
  VERIFIES("LASSO-WEB-023~1");
  const nlohmann::json told = nlohmann::json::parse(commands_json());
  std::size_t commands = 0;
  for (const PacketRow& row : kPackets) {
    if (row.type != PacketType::kCommand) continue;
    ++commands;
    const auto found =
        std::find_if(told["commands"].begin(), told["commands"].end(), [&](const auto& one) { return one["name"] == row.name; });
    ASSERT_NE(found, told["commands"].end()) << row.name;
    EXPECT_EQ((*found)["hazardous"], row.hazard != Hazard::kNone) << row.name;
    EXPECT_EQ((*found)["items"].size(), row.items.size()) << row.name;
    for (const auto& item : (*found)["items"]) {
      if (item.contains("enumeration")) {
        EXPECT_TRUE(told["enumerations"].contains(item["enumeration"].get<std::string>())) << item;
      }
    }
  }
  EXPECT_EQ(told["commands"].size(), commands);
}

}  // namespace
}  // namespace lasso::mdat::serve
