#include "bsp/posix/links.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "bsp/posix/runner.hpp"
#include "bsp/posix/serial_line.hpp"
#include "ut/exec/component_scene.hpp"
#include "ut/link/command_packets.hpp"

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
    EXPECT_EQ(component->datagrams(), scheme == "udp");
    EXPECT_EQ(component->write(test::view(Stream{1, 2, 3})), 3u) << "nobody is there: it is lost";
    const auto ground = connect_link(component->address());
    Stream up{5, 6, 7, 8}, down{9, 8, 7};
    EXPECT_EQ(ground->write(test::view(up)), 4u);
    EXPECT_EQ(read_all(*component, 4), up);
    EXPECT_EQ(component->write(test::view(down)), 3u);
    EXPECT_EQ(read_all(*ground, 3), down);
    EXPECT_EQ(component->read(Bytes(up.data(), up.size())), 0u) << "no call waits";
  }
}

TEST(Links, ASecondGroundStationTakesOverWhenTheFirstHasGone) {
  VERIFIES("LASSO-LNK-026~2");
  for (const std::string scheme : {"udp", "tcp"}) {
    const auto component = open_link(scheme + "://:0");
    for (std::uint8_t station = 1; station <= 3; ++station) {
      const auto ground = connect_link(component->address());
      ground->write(test::view(Stream{station}));
      EXPECT_EQ(read_all(*component, 1), Stream{station});
      for (int i = 0; i < 3 && read_all(*ground, 1) != Stream{7}; ++i) component->write(test::view(Stream{7}));
    }
  }
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
  VERIFIES("LASSO-GND-161~1");
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
  VERIFIES("LASSO-GND-161~1");
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

}  // namespace
}  // namespace lasso::posix
