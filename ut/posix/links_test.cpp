#include "bsp/posix/links.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "bsp/posix/runner.hpp"
#include "bsp/posix/serial_line.hpp"
#include "ut/exec/component_scene.hpp"
#include "ut/link/keyed_sum.hpp"

namespace lasso::posix {
namespace {

using test::Stream;

// What comes within a second.
Stream read_all(PosixLink& link, std::size_t expected) {
  Stream all;
  for (int i = 0; i < 200 && all.size() < expected; ++i) {
    Stream piece(2000);
    piece.resize(link.read(Bytes(piece.data(), piece.size())));
    if (piece.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    test::append(all, piece);
  }
  return all;
}

TEST(Links, BytesPassBothWaysByUdpAndTcp) {
  VERIFIES("LASSO-LNK-026~2");
  for (const std::string scheme : {"udp", "tcp"}) {
    const auto component = open_link(scheme + "://:0");
    EXPECT_TRUE(component->datagrams());
    EXPECT_EQ(component->write(test::view(Stream{1, 2, 3})), 3u) << "nobody is there: it is lost";
    const auto ground = connect_link(component->address());
    Stream up = test::ping(7), down{9, 8, 7};
    EXPECT_EQ(ground->write(test::view(up)), up.size());
    EXPECT_EQ(read_all(*component, up.size()), up);
    component->peer_spoke();
    EXPECT_EQ(component->write(test::view(down)), 3u);
    EXPECT_EQ(read_all(*ground, 3), down);
    EXPECT_EQ(component->read(Bytes(up.data(), up.size())), 0u) << "no call waits";
  }
}

TEST(Links, ASecondGroundStationTakesOverWhenTheFirstHasGone) {
  VERIFIES("LASSO-LNK-026~2");
  for (const std::string scheme : {"udp", "tcp"}) {
    const auto component = open_link(scheme + "://:0");
    for (std::uint16_t station = 1; station <= 3; ++station) {
      const auto ground = connect_link(component->address());
      const Stream ping = test::ping(station);
      ground->write(test::view(ping));
      EXPECT_EQ(read_all(*component, ping.size()), ping);
      component->peer_spoke();
      bool told = false;
      for (int i = 0; i < 3 && !told; ++i) {
        component->write(test::view(Stream{7}));
        told = read_all(*ground, 1) == Stream{7};
      }
      EXPECT_TRUE(told) << scheme;
    }
  }
}

TEST(Links, ByDatagramsWhoIsNotVouchedForIsToldNothingAndTakesNothing) {
  VERIFIES("LASSO-LNK-041~2");
  const auto component = open_link("udp://:0");
  const auto ground = connect_link(component->address()), stranger = connect_link(component->address());
  stranger->write(test::view(Stream{1}));
  EXPECT_EQ(read_all(*component, 1), Stream{1});
  component->write(test::view(Stream{7}));
  ground->write(test::view(Stream{2}));
  EXPECT_EQ(read_all(*component, 1), Stream{2});
  component->peer_spoke();
  for (int i = 0; i < 3; ++i) stranger->write(test::view(Stream{}));
  stranger->write(test::view(Stream{3}));
  EXPECT_EQ(read_all(*component, 1), Stream{3}) << "behind empty datagrams";
  component->write(test::view(Stream{8}));
  EXPECT_EQ(read_all(*ground, 1), Stream{8});
  Stream nothing(10);
  EXPECT_EQ(stranger->read(Bytes(nothing.data(), nothing.size())), 0u);
}

TEST(Links, TheGroundHearsItsComponentAlone) {
  VERIFIES("LASSO-GND-165~1");
  const auto component = open_link("udp://:0"), other = open_link("udp://:0");
  const auto ground = connect_link(component->address());
  const auto stranger = connect_link(ground->address());
  ground->write(test::view(Stream{1}));
  EXPECT_EQ(read_all(*component, 1), Stream{1});
  component->peer_spoke();
  stranger->write(test::view(Stream{9}));
  component->write(test::view(Stream{5}));
  EXPECT_EQ(read_all(*ground, 1), Stream{5}) << "what the stranger sent before is not there";
  EXPECT_FALSE(ground->unreached());
  const std::string nobody = [] { return open_link("udp://:0")->address(); }();
  EXPECT_TRUE(connect_link(nobody)->unreached());
}

TEST(Links, WhoIsConfiguredIsToldFromTheBeginning) {
  VERIFIES("LASSO-LNK-041~2");
  const auto ground = open_link("udp://:0");
  const auto component = open_link("udp://:0", ground->address().substr(6));
  component->write(test::view(Stream{4}));
  EXPECT_EQ(read_all(*ground, 1), Stream{4});
  EXPECT_THROW(open_link("tcp://:0", "127.0.0.1:1"), LinkError);
}

TEST(Links, AReceiverThatWouldBeToldNothingIsRefused) {
  VERIFIES("LASSO-LNK-041~2");
  const auto why = [](const std::string& told) -> std::string {
    try {
      open_link("udp://:0", told);
    } catch (const LinkError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why("127.0.0.1"), "127.0.0.1: a port is missing: HOST:PORT");
  EXPECT_EQ(why("127.0.0.1:0"), "127.0.0.1:0: '0' is no port to send to: 1 to 65535");
  EXPECT_NE(why("127.0.0.1:70000").find("127.0.0.1:70000: '70000' is no port"), std::string::npos);
  EXPECT_NE(why("192.0.2.77:9").find("192.0.2.77:9: is not reached from the link's address: "), std::string::npos) << why("192.0.2.77:9");
}

TEST(Links, SayWhetherOtherMachinesReachThem) {
  VERIFIES("LASSO-LNK-042~1");
  for (const char* url : {"udp://:0", "tcp://127.0.0.1:0", "udp://127.9.9.9:0", "file:///nowhere"})
    EXPECT_FALSE(is_reached_from_elsewhere(url)) << url;
  for (const char* url : {"udp://0.0.0.0:0", "tcp://0.0.0.0:0", "udp://192.0.2.1:5"}) EXPECT_TRUE(is_reached_from_elsewhere(url)) << url;
}

TEST(Links, AreBoundToTheLoopbackAddressUnlessToldOtherwise) {
  VERIFIES("LASSO-LNK-027~1");
  for (const std::string scheme : {"udp", "tcp"}) {
    EXPECT_EQ(open_link(scheme + "://:0")->address().substr(0, 16), scheme + "://127.0.0.1:");
    EXPECT_EQ(open_link(scheme + "://0.0.0.0:0")->address().substr(0, 14), scheme + "://0.0.0.0:");
  }
}

TEST(Links, WhatCannotBeOpenedIsNamed) {
  VERIFIES("LASSO-LNK-026~2");
  const auto why = [](const std::string& url) -> std::string {
    try {
      open_link(url);
    } catch (const LinkError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(why("here").find("here: no link; one of udp://"), std::string::npos);
  EXPECT_NE(why("serial://x").find("no link of kind serial"), std::string::npos);
  EXPECT_NE(why("udp://1").find("a port is missing"), std::string::npos);
  EXPECT_NE(why("udp://host:1").find("host is no numeric IPv4 address"), std::string::npos);
  EXPECT_NE(why("udp://:70000").find("'70000' is no port"), std::string::npos);
  EXPECT_NE(why("tcp://:x").find("'x' is no port"), std::string::npos);
  EXPECT_NE(why("file:///nowhere/at/all").find("cannot be written"), std::string::npos);
  for (const std::string scheme : {"udp", "tcp"}) {
    const auto taken = open_link(scheme + "://:0");
    EXPECT_NE(why(taken->address()).find("cannot be bound"), std::string::npos) << scheme;
  }
  EXPECT_THROW(connect_link("file://x"), LinkError);
  const std::string closed = [] { return open_link("tcp://:0")->address(); }();
  EXPECT_THROW(connect_link(closed), LinkError);
}

TEST(Links, TheGroundReachesAComponentByASerialLine) {
  VERIFIES("LASSO-GND-161~2");
  for (const std::string kind : {"pty", "unix"}) {
    const std::string socket = "unix:" + (std::filesystem::temp_directory_path() / ("lasso_line_" + std::to_string(::getpid()))).string();
    LineServer board;
    ASSERT_EQ(board.listen(kind == "pty" ? kind : socket, false), "");
    const std::string url = kind == "pty" ? "serial:" + board.address() : socket;
    const auto ground = connect_link(url);
    EXPECT_EQ(ground->address(), url);
    EXPECT_FALSE(ground->datagrams());
    EXPECT_EQ(ground->write(test::view(Stream{5, 6})), 2u);
    SerialLine line;
    for (int i = 0; i < 200 && !board.accept(line); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_TRUE(line.is_open());
    Stream up(8);
    for (int i = 0; i < 200 && up.size() == 8; ++i) {
      const std::size_t came = line.read(Bytes(up.data(), up.size()));
      if (came > 0) up.resize(came);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_EQ(up, (Stream{5, 6}));
    EXPECT_EQ(line.write(test::view(Stream{1, 2, 3})), 3u);
    EXPECT_EQ(read_all(*ground, 3), (Stream{1, 2, 3}));
    EXPECT_FALSE(ground->ended());
    line.close();
    board.close();
    for (int i = 0; i < 200 && !ground->ended(); ++i) (void)ground->read(Bytes(up.data(), up.size()));
    EXPECT_TRUE(ground->ended()) << kind;
    EXPECT_EQ(ground->read(Bytes(up.data(), up.size())), 0u);
    EXPECT_EQ(ground->write(test::view(Stream{1})), 1u) << "it is lost";
  }
}

TEST(Links, TheGroundSeesThatATcpLinkHasEnded) {
  VERIFIES("LASSO-GND-161~2");
  auto component = open_link("tcp://:0");
  const auto ground = connect_link(component->address());
  EXPECT_EQ(component->write(test::view(Stream{1})), 1u);
  (void)read_all(*ground, 1);
  EXPECT_FALSE(ground->ended());
  EXPECT_FALSE(component->ended());
  component.reset();
  (void)read_all(*ground, 1);
  EXPECT_TRUE(ground->ended());
}

TEST(Links, AComponentIsCommandedByAFile) {
  VERIFIES("LASSO-LNK-026~2");
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("lasso_link_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
                                                std::to_string(reinterpret_cast<std::uintptr_t>(&path)));
  Stream commands;
  for (std::uint16_t i = 0; i < 20; ++i) test::append(commands, test::ping(i));
  std::ofstream(path.string() + ".commands", std::ios::binary)
      .write(reinterpret_cast<const char*>(commands.data()), static_cast<std::streamsize>(commands.size()));
  std::size_t pongs = 0, recorded = 0;
  {
    test::ComponentScene scene(test::box_parameters(test::default_scene()));
    scene.begin();
    const auto link = open_link("file://" + path.string());
    EXPECT_EQ(link->address(), "file://" + path.string());
    Runner runner(*scene.component);
    runner.connect(*link);
    for (int frame = 0; frame < 6; ++frame) recorded += runner.run_frame().telemetry.size();
  }
  std::ifstream file(path, std::ios::binary);
  const Stream telemetry((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_EQ(telemetry.size(), recorded);
  for (std::size_t at = 0; at < telemetry.size(); at += packet_size({telemetry.data() + at, telemetry.size() - at}))
    pongs += telemetry[at + 7] == 17 ? 1U : 0U;
  EXPECT_EQ(pongs, 20u);
  std::filesystem::remove(path);
  std::filesystem::remove(path.string() + ".commands");
}

// Five who may not command, each at a port of its own: junk, truncated, damaged, unsigned, and recorded from the operator.
class Attackers {
 public:
  explicit Attackers(const std::string& url) {
    for (int i = 0; i < 5; ++i) links_.push_back(connect_link(url));
  }
  void send(const Stream& recorded) {
    Stream damaged = test::with_sum(test::ping(7)), truncated = recorded;
    damaged.back() ^= 1;
    truncated.resize(truncated.size() / 2);
    const Stream packets[] = {Stream{0}, truncated, damaged, test::set_mode(0, 9), recorded};
    for (std::size_t i = 0; i < links_.size(); ++i) links_[i]->write(test::view(packets[i]));
  }
  // What they are told; false: there is more than refusals of what they sent.
  bool hear_refusals_alone(std::size_t& refusals) {
    for (const auto& link : links_) {
      for (Stream packet = next(*link); !packet.empty(); packet = next(*link)) {
        if (packet[7] != 1 || packet[8] != 2) return false;
        ++refusals;
      }
    }
    return true;
  }
  static Stream next(PosixLink& link) {
    Stream packet(2000);
    packet.resize(link.read(Bytes(packet.data(), packet.size())));
    return packet;
  }

 private:
  std::vector<std::unique_ptr<PosixLink>> links_;
};

TEST(Links, AttackersAtOtherPortsNeitherTakeTelemetryNorHoldTheOperatorBack) {
  VERIFIES("LASSO-LNK-040~2 LASSO-LNK-041~2");
  constexpr std::uint16_t kAttackedFrames = 50;
  test::ComponentScene scene(test::box_parameters(test::default_scene()));
  test::OnceSum authenticator;
  scene.component->use_authenticator(authenticator);
  scene.component->accept_unsigned_images();
  scene.begin();
  const auto link = open_link("udp://:0");
  Runner runner(*scene.component);
  runner.connect(*link);
  const auto ground = connect_link(link->address());
  Attackers attackers(link->address());
  std::size_t refusals = 0, completed = 0;
  int expected = -1;
  for (std::uint16_t frame = 0; frame < kAttackedFrames; ++frame) {
    const Stream command = test::with_sum(test::plain_packet(CommandKind::kInhibitLaser, frame));
    if (frame > 0) {
      for (int i = 0; i < 12; ++i) attackers.send(test::with_sum(test::plain_packet(CommandKind::kInhibitLaser, 0)));
    }
    ground->write(test::view(command));
    (void)runner.run_frame();
    for (Stream packet = Attackers::next(*ground); !packet.empty(); packet = Attackers::next(*ground)) {
      const int count = (packet[2] << 8 | packet[3]) & kSequenceCountMask;
      if (expected >= 0) {
        ASSERT_EQ(count, expected) << "nothing is missing";
      }
      expected = (count + 1) & kSequenceCountMask;
      completed += packet[7] == 1 && packet[8] == 7 ? 1U : 0U;
    }
    ASSERT_TRUE(attackers.hear_refusals_alone(refusals));
  }
  EXPECT_EQ(completed, kAttackedFrames) << "each command is answered in its frame";
  EXPECT_GT(refusals, 0u);
  EXPECT_LE(refusals, kAttackedFrames * 2 * kMaxRefusalsPerFrame);
}

}  // namespace
}  // namespace lasso::posix
