#include "mdat/link/connection.hpp"

#include <gtest/gtest.h>

#include "mdat/common/errors.hpp"
#include "ut/link/command_packets.hpp"
#include "ut/mdat/link/some_telemetry.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// What the component's end hears, within some seconds.
TelemetryBytes heard_by(posix::PosixLink& component, Connection& connection) {
  TelemetryBytes bytes(2000);
  std::size_t size = 0;
  connection.listen(10, [&] { return (size = component.read(Bytes(bytes.data(), bytes.size()))) > 0; });
  component.peer_spoke();  // it is a command, as a component finds out
  bytes.resize(size);
  return bytes;
}

void send_pose(posix::PosixLink& component, std::uint16_t count) {
  const TelemetryBytes packet = pose_packet(count);
  EXPECT_EQ(component.write({packet.data(), packet.size()}), packet.size());
}

class ConnectionTest : public ::testing::Test {
 protected:
  Station::Listener listener() {
    return [this](const DecodedPacket& packet) { counts_.push_back(packet.header.at(5)); };
  }
  void listen_until(Connection& connection, std::size_t packets, double seconds = 5) {
    connection.listen(seconds, [&] { return counts_.size() >= packets; });
  }
  std::vector<std::uint64_t> counts_;
};

TEST_F(ConnectionTest, AComponentByDatagramsIsCalledUntilItAnswers) {
  VERIFIES("LASSO-GND-161~2");
  const auto component = posix::open_link("udp://:0");
  Connection connection({component->address(), false, std::nullopt}, listener());
  const TelemetryBytes first = heard_by(*component, connection);
  ASSERT_GT(first.size(), 8U);
  EXPECT_EQ(first[7], 17) << "a ping, which changes nothing";
  EXPECT_EQ(first[8], 1);
  EXPECT_LT(connection.health().age_s(std::chrono::steady_clock::now()), 0);
  EXPECT_EQ(heard_by(*component, connection).size(), first.size()) << "it may have missed the first one";
  for (const std::uint16_t count : std::initializer_list<std::uint16_t>{0, 1, 4}) send_pose(*component, count);
  listen_until(connection, 3);
  EXPECT_EQ(counts_, (std::vector<std::uint64_t>{0, 1, 4}));
  EXPECT_EQ(connection.health().missing(), 2U);
}

TEST_F(ConnectionTest, AComponentOfAnotherApplicationProcessIsCalledAndHeardAlone) {
  VERIFIES("LASSO-LNK-044~1");
  constexpr std::uint16_t kOther = 0x2A5;
  const auto component = posix::open_link("udp://:0");
  Connection connection({component->address(), false, std::nullopt, kOther}, listener());
  const TelemetryBytes first = heard_by(*component, connection);
  EXPECT_EQ(apid_of({first.data(), first.size()}), kOther);
  send_pose(*component, 2);
  const TelemetryBytes own = lasso::test::for_apid(pose_packet(3), kOther);
  EXPECT_EQ(component->write({own.data(), own.size()}), own.size());
  listen_until(connection, 1);
  EXPECT_EQ(counts_, std::vector<std::uint64_t>{3});
}

TEST_F(ConnectionTest, ALinkThatEndsIsOpenedAgainAndWhatWasMissedMeanwhileIsMissing) {
  VERIFIES("LASSO-GND-161~2");
  auto component = posix::open_link("tcp://:0");
  const std::string url = component->address();
  Connection connection({url, false, std::nullopt}, listener());
  const auto send = [&](std::uint16_t count) {
    const std::size_t before = counts_.size();
    for (int i = 0; i < 50 && counts_.size() == before; ++i) {  // until the component has let the ground in
      send_pose(*component, count);
      listen_until(connection, before + 1, 0.1);
    }
  };
  send(7);
  component.reset();
  connection.listen(3, [&] { return !connection.trouble().empty(); });
  EXPECT_NE(connection.trouble().find(url + ": "), std::string::npos) << connection.trouble();
  EXPECT_EQ(connection.station(), nullptr);
  component = posix::open_link(url);
  send(10);
  EXPECT_EQ(connection.trouble(), "");
  EXPECT_EQ(counts_, (std::vector<std::uint64_t>{7, 10}));
  EXPECT_EQ(connection.health().missing(), 2U);
}

TEST_F(ConnectionTest, AComponentThatSendsByItselfIsListenedTo) {
  VERIFIES("LASSO-GND-161~2");
  Connection connection({"udp://:0", true, std::nullopt}, listener());
  const auto component = posix::connect_link(connection.address());
  send_pose(*component, 3);
  listen_until(connection, 1);
  EXPECT_EQ(counts_, (std::vector<std::uint64_t>{3}));
}

TEST_F(ConnectionTest, WhatCannotBeOpenedIsNamed) {
  VERIFIES("LASSO-GND-161~2");
  const std::string nobody = [] { return posix::open_link("tcp://:0")->address(); }();
  const auto taken = posix::open_link("udp://:0");
  const auto why = [&](const std::string& url, bool listens) -> std::string {
    try {
      Connection({url, listens, std::nullopt}, listener());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(why(nobody, false).find(nobody + ": nobody answers"), std::string::npos) << why(nobody, false);
  EXPECT_NE(why(taken->address(), true).find("cannot be bound"), std::string::npos) << why(taken->address(), true);
  EXPECT_NE(why("serial:/dev/none", false).find("/dev/none: not there"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
