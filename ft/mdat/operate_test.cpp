// A component in a real-time run, commanded from outside by mdat command, over UDP and TCP, and by a file.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "ft/mdat/live_run.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

// Until the run listens.
Answer first_answer(const WorkFolder& work, const std::string& command) {
  Answer answer;
  for (int i = 0; i < 100; ++i) {
    answer = work.mdat(command);
    if (answer.exit_code == 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return answer;
}

constexpr double kFrame_s = 0.2001;  // and a rounded fraction of a second

double time_of(const Json& packet) {
  const Json& header = packet.at("header");
  return header.at("time_seconds").get<double>() + header.at("time_fraction").get<double>() / (1 << 24);
}

TEST(Operate, AnOperatorCommandsARunningComponent) {
  VERIFIES("LASSO-NEED-009~1 LASSO-LNK-026~2 LASSO-GND-021~2 LASSO-LNK-017~2 LASSO-LNK-022~2 LASSO-MOD-136~4 LASSO-MOD-173~2");
  const WorkFolder work;
  for (const std::string scheme : {"udp", "tcp"}) {
    const std::string url = scheme + "://127.0.0.1:" + free_port();
    Program run(work, "run missions/test.toml --scenario spin --no-report --out run --force --frames 100000 --link " + url);
    const Answer ping = first_answer(work, "command ping --to " + url);
    ASSERT_EQ(ping.exit_code, 0) << ping.err;
    EXPECT_NE(ping.out.find("pong"), std::string::npos);
    const Answer unarmed = work.mdat("command enable_laser --wait 30 --to " + url);
    EXPECT_EQ(unarmed.exit_code, 1);
    EXPECT_NE(unarmed.out.find("not_armed"), std::string::npos) << unarmed.out;
    const Answer armed = work.mdat("command enable_laser --arm --wait 30 --to " + url);
    EXPECT_EQ(armed.exit_code, 0) << armed.out << armed.err;
    const Answer coasting = work.mdat("command set_mode mode=coasting --wait 30 --to " + url);
    EXPECT_EQ(coasting.exit_code, 1);
    EXPECT_NE(coasting.out.find("not_by_command"), std::string::npos) << coasting.out;
    Answer near;
    for (int i = 0; i < 20 && near.exit_code != 0; ++i) near = work.mdat("command set_mode mode=short_range --wait 30 --to " + url);
    EXPECT_EQ(near.exit_code, 0) << near.out << near.err;
    EXPECT_EQ(work.mdat("command ping --wait 30 --to " + url).exit_code, 0);
    const Answer far = work.mdat("command set_mode mode=tracking --wait 30 --to " + url);
    EXPECT_EQ(far.exit_code, 0) << far.out << far.err;
    EXPECT_EQ(work.mdat("command ping --wait 30 --to " + url).exit_code, 0);
    const Answer standby = work.mdat("command set_mode mode=standby --wait 30 --to " + url);
    EXPECT_EQ(standby.exit_code, 0) << standby.err;
    for (int i = 0; i < 3; ++i) work.mdat("command ping --wait 30 --to " + url);  // a frame each: the last events are reported
    const Answer over = run.interrupt();
    EXPECT_EQ(over.exit_code, 0) << over.err;
    const Json packets = Json::parse(work.mdat("decode run/telemetry.ccsds --format json").out).at("packets");
    std::string story;
    std::map<std::string, double> told_s;
    std::vector<double> pongs_s;
    for (const Json& packet : packets) {
      const std::string name = packet.at("packet");
      if (name == "mode_changed") {
        const std::string mode = packet.at("items").at("to");
        story += mode + " ";
        told_s[mode] = time_of(packet);
      }
      if (name == "pong") pongs_s.push_back(time_of(packet));
      if (name == "command_failed" || name == "laser_enabled") story += name + " ";
    }
    const std::size_t failed = story.find("command_failed"), enabled = story.find("laser_enabled");
    EXPECT_TRUE(failed < enabled && enabled != std::string::npos) << story;
    EXPECT_NE(story.find("short_range tracking standby", enabled), std::string::npos) << story;
    // A mode is taken at the boundary that follows its command: the pong of a ping behind that may come a frame before, and no more.
    ASSERT_GE(pongs_s.size(), 6U);
    EXPECT_LE(told_s["short_range"], pongs_s[pongs_s.size() - 5] + kFrame_s) << story;
    EXPECT_LE(told_s["tracking"], pongs_s[pongs_s.size() - 4] + kFrame_s) << story;
    EXPECT_LE(told_s["standby"], pongs_s[pongs_s.size() - 3] + kFrame_s) << story;
  }
}

TEST(Operate, AComponentWithAKeyTakesSignedCommandsAlone) {
  VERIFIES("LASSO-LNK-021~2 LASSO-GND-164~1");
  const WorkFolder work;
  work.write("key", std::string(64, 'a') + "\n");
  work.write("other", std::string(64, 'b') + "\n");
  const std::string url = "udp://127.0.0.1:" + free_port();
  Program run(work, "run missions/test.toml --scenario spin --no-report --out run --force --frames 100000 --key key --link " + url);
  const Answer signed_one = work.mdat("command set_mode mode=standby --wait 60 --key key --to " + url);  // the run begins meanwhile
  EXPECT_EQ(signed_one.exit_code, 0) << signed_one.err;
  for (const char* key : {"", "--key other "}) {
    const Answer refused = work.mdat(std::string("command ping --wait 30 ") + key + "--to " + url);
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_NE(refused.err.find("not_authentic"), std::string::npos) << refused.err;
  }
  EXPECT_EQ(work.mdat("command enable_laser --arm --wait 30 --key key --to " + url).exit_code, 0) << "two, each with a number of its own";
  EXPECT_EQ(run.interrupt().exit_code, 0);
}

TEST(Operate, OtherMachinesReachARunWithAKeyOrWhereTheUserSaysSo) {
  VERIFIES("LASSO-LNK-042~1");
  const WorkFolder work;
  for (const std::string url : {"udp://0.0.0.0:0", "tcp://0.0.0.0:0"}) {
    const Answer answer = work.mdat("run missions/test.toml --scenario spin --no-report --link " + url);
    EXPECT_EQ(answer.exit_code, 2);
    EXPECT_NE(answer.err.find("--link " + url + ": whoever reaches this machine could command the run"), std::string::npos) << answer.err;
  }
  work.write("key", std::string(64, 'a') + "\n");
  for (const std::string allowed : {"--key key", "--remote"}) {
    const Answer answer =
        work.mdat("run missions/test.toml --scenario spin --no-report --frames 1 --out run --force --link udp://0.0.0.0:0 " + allowed);
    EXPECT_EQ(answer.exit_code, 0) << allowed << answer.err;
  }
}

TEST(Operate, CommandsGoToAFileAndARunReadsThem) {
  VERIFIES("LASSO-LNK-026~2 LASSO-GND-021~2");
  const WorkFolder work;
  EXPECT_EQ(work.mdat("command set_mode mode=standby --count 3 --out tm.commands").exit_code, 0);
  const std::string decoded = work.mdat("decode --commands tm.commands").out;
  EXPECT_NE(decoded.find("set_mode   #3"), std::string::npos) << decoded;
  work.write("key", std::string(64, 'a'));
  EXPECT_EQ(work.mdat("command set_mode mode=standby --key key --out signed").exit_code, 0);
  EXPECT_EQ(work.read("signed").size(), work.read("tm.commands").size() + 24);
  EXPECT_NE(work.mdat("decode --commands signed").out.find("set_mode   #0"), std::string::npos);
  const Answer run =
      work.mdat("run missions/test.toml --scenario spin --no-report --out run --frames 3 --link file://" + (work / "tm").string());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(work.read("tm"), work.read("run/telemetry.ccsds"));
  EXPECT_NE(work.mdat("decode tm").out.find("completed"), std::string::npos);
}

TEST(Operate, WhatIsWrongIsNamed) {
  VERIFIES("LASSO-GND-021~2");
  const WorkFolder work;
  for (const auto& [arguments, said] : std::vector<std::pair<std::string, std::string>>{
           {"command set_mod --to udp://:1", "set_mod: no command of the dictionary; there is set_mode"},
           {"command set_mode mode=standby --to udp://x:1", "x is no numeric IPv4 address"},
           {"command set_mode --out x", "set_mode: mode is missing"},
           {"command set_mode mode --out x", "'mode': an item and its value are written NAME=VALUE"},
           {"command ping --arm --out x", "ping: is not hazardous"},
           {"command ping --out x --to udp://:1", "--to or --out, not both"},
           {"command", "which one? mdat command --list shows all"},
           {"command ping --out x --key none", "none: no such file"},
           {"run missions/test.toml --link udp://:x", "--link udp://:x: 'x' is no port"},
           {"run missions/test.toml --link tcp://:0 --telemetry-to 127.0.0.1:1", "only of udp:// is said whom it tells"}}) {
    const Answer answer = work.mdat(arguments);
    EXPECT_EQ(answer.exit_code, 2) << arguments;
    EXPECT_NE(answer.err.find(said), std::string::npos) << answer.err;
  }
  const Answer silent = work.mdat("command ping --wait 0.2 --to udp://127.0.0.1:9");
  EXPECT_EQ(silent.exit_code, 1);
  EXPECT_NE(silent.err.find("no answer: nobody listens at this port"), std::string::npos) << silent.err;
  EXPECT_NE(work.mdat("command --list").out.find("offer_start"), std::string::npos);
  EXPECT_NE(work.mdat("command set_hold").out.find("held"), std::string::npos);
}

}  // namespace
}  // namespace lasso::ft
