// Telemetry of a run: decoded, listed, and decoded again by tshark, which knows nothing of this project but the generated dissector.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <thread>

#include "ft/mdat/live_run.hpp"
#include "ut/support/places.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

constexpr const char* kRun = "run missions/test.toml --scenario spin --frames 12 --no-report --out run";

bool have_tshark() { return std::system("tshark --version >/dev/null 2>&1") == 0; }

// As tshark prints it: floats with the digits that they surely have.
std::string printed(const Json& value, const Json& item, const Json& enumerations) {
  if (item.contains("enumeration")) {
    for (const Json& choice : enumerations.at(item.at("enumeration").get<std::string>())) {
      if (choice.at("name") == value) return choice.at("value").dump();
    }
  }
  const std::string type = item.at("type");
  if (type[0] != 'f') return value.dump();
  char text[40];
  const double number = type == "f32" ? static_cast<double>(value.get<float>()) : value.get<double>();
  (void)std::snprintf(text, sizeof text, type == "f32" ? "%.6g" : "%.15g", number);
  return text;
}

std::string printed_all(const Json& value, const Json& item, const Json& enumerations) {
  if (!value.is_array()) return printed(value, item, enumerations);
  std::string text;
  for (const Json& each : value) text += (text.empty() ? "" : ",") + printed(each, item, enumerations);
  return text;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == '\t') fields.emplace_back();
    if (c != '\t') fields.back() += c;
  }
  return fields;
}

// Has tshark and mdat decode a file of packets of this type, and compares them field by field. How many there are of each packet.
std::map<std::string, int> compare_with_tshark(const WorkFolder& work, const std::string& type, const std::string& file) {
  const std::string decode = "decode " + file + (type == "command" ? " --commands" : "") + " --format ";
  work.write("lasso.lua", work.mdat("dictionary --format lua").out);
  work.write("run.pcap", work.mdat(decode + "pcap").out);
  const Json dictionary = Json::parse(work.mdat("dictionary --format json").out);
  const Json decoded = Json::parse(work.mdat(decode + "json").out);

  std::vector<std::string> header;
  for (const std::string& part : {std::string("primary"), type}) {
    for (const Json& field : dictionary.at("headers").at(part)) header.push_back(field.at("name"));
  }
  std::string fields = " -e lasso.crc_right -e lasso.number";
  for (const std::string& name : header) fields += " -e lasso." + name;
  std::map<std::string, Json> rows;
  std::map<std::string, std::size_t> first_column;
  std::size_t columns = 2 + header.size();
  for (const Json& packet : dictionary.at("packets")) {
    if (packet.at("type") != type) continue;
    const std::string name = packet.at("name");
    rows[name] = packet;
    first_column[name] = columns;
    columns += packet.at("items").size();
    for (const Json& item : packet.at("items")) fields += " -e lasso." + name + "." + item.at("name").get<std::string>();
  }
  const std::string command = "cd '" + (work / "").string() +
                              "' && HOME=. tshark -X lua_script:lasso.lua -r run.pcap -T fields -E occurrence=a -E aggregator=," + fields +
                              " >tshark.txt 2>tshark.err";
  std::map<std::string, int> kinds;
  EXPECT_EQ(std::system(command.c_str()), 0) << work.read("tshark.err");
  const std::vector<std::string> lines = lines_of(work.read("tshark.txt"));
  EXPECT_EQ(lines.size(), decoded.at("packets").size());
  for (std::size_t i = 0; i < std::min(lines.size(), decoded.at("packets").size()); ++i) {
    const Json& packet = decoded.at("packets").at(i);
    const std::string kind = packet.at("packet");
    ++kinds[kind];
    std::vector<std::string> found = split(lines[i]);
    EXPECT_EQ(found.size(), columns);
    found.resize(columns);
    EXPECT_EQ(found[0], "1") << "the checksum, by the dissector's own arithmetic";
    EXPECT_EQ(found[1], rows.at(kind).at("number").is_null() ? "" : rows.at(kind).at("number").dump());
    for (std::size_t k = 0; k < header.size(); ++k) EXPECT_EQ(found[2 + k], packet.at("header").at(header[k]).dump()) << header[k];
    const Json& items = rows.at(kind).at("items");
    for (std::size_t k = 2 + header.size(); k < columns; ++k) {
      const std::size_t item = k - first_column.at(kind);
      const bool own = k >= first_column.at(kind) && item < items.size();
      if (!own) {
        EXPECT_EQ(found[k], "") << kind << " has an item of another packet";
        continue;
      }
      const Json& value = packet.at("items").at(items[item].at("name").get<std::string>());
      EXPECT_EQ(found[k], printed_all(value, items[item], dictionary.at("enumerations"))) << items[item].at("name");
    }
  }
  return kinds;
}

TEST(Link, TsharkDecodesARunAsMdatDoes) {
  VERIFIES("LASSO-LNK-024~1 LASSO-GND-022~1 LASSO-SYS-020~2");
  if (!have_tshark()) GTEST_SKIP() << "tshark is missing: install cfg/packages/test.txt";
  const WorkFolder work;
  ASSERT_EQ(work.mdat(kRun).exit_code, 0);
  std::map<std::string, int> kinds = compare_with_tshark(work, "telemetry", "run/telemetry.ccsds");
  EXPECT_EQ(kinds["pose"], 12);
  EXPECT_EQ(kinds["begun"], 1);
  EXPECT_GE(kinds["mode_changed"], 2);
}

// A value within the range of each element, none like the one before where that is possible.
std::string some_values(const Json& item) {
  const bool named = item.contains("enumeration"), bounded = !item.at("minimum").is_null();
  std::string text;
  for (int i = 0; i < item.at("count").get<int>(); ++i) {
    const long long value = named ? 1 : bounded ? static_cast<long long>(std::ceil(item.at("minimum").get<double>())) : i + 1;
    text += (i > 0 ? "," : "") + std::to_string(value);
  }
  return text;
}

TEST(Link, TsharkDecodesEveryCommandAsMdatDoes) {
  VERIFIES("LASSO-GND-022~1");
  if (!have_tshark()) GTEST_SKIP() << "tshark is missing: install cfg/packages/test.txt";
  const WorkFolder work;
  const Json dictionary = Json::parse(work.mdat("dictionary --format json").out);
  std::string stream;
  std::size_t commands = 0;
  for (const Json& packet : dictionary.at("packets")) {
    if (packet.at("type") != "command") continue;
    std::string arguments = packet.at("name").get<std::string>();
    for (const Json& item : packet.at("items")) arguments += " " + item.at("name").get<std::string>() + "=" + some_values(item);
    const Answer made = work.mdat("command " + arguments + " --out one --count " + std::to_string(commands++));
    ASSERT_EQ(made.exit_code, 0) << made.err;
    stream += work.read("one");
  }
  work.write("all.commands", stream);
  const std::map<std::string, int> kinds = compare_with_tshark(work, "command", "all.commands");
  EXPECT_EQ(kinds.size(), commands);
  EXPECT_GT(commands, 25U);
}

TEST(Link, DecodePrintsARunInEachFormat) {
  VERIFIES("LASSO-GND-021~2");
  const WorkFolder work;
  ASSERT_EQ(work.mdat(kRun).exit_code, 0);
  const Answer table = work.mdat("decode run/telemetry.ccsds");
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_NE(table.out.find("  mode                       tracking\n"), std::string::npos);
  EXPECT_NE(table.err.find("16 packets, 0 bytes"), std::string::npos) << table.err;
  EXPECT_NE(table.out.find("begun "), std::string::npos);
  EXPECT_EQ(lines_of(work.mdat("decode run/telemetry.ccsds --format csv").out).size(), 13U);
  EXPECT_EQ(Json::parse(work.mdat("decode run/telemetry.ccsds --format json --items scan_id").out).at("packets").size(), 12U);
  const Answer headers = work.mdat("decode --headers run/telemetry.ccsds --format csv");
  EXPECT_EQ(lines_of(headers.out).size(), 17U);
  EXPECT_NE(headers.err.find("16 packets: CRC right in 16, wrong in 0; 0 gaps"), std::string::npos) << headers.err;
}

// A run that goes on while somebody watches: each packet is printed once, when its last byte has come.
TEST(Link, AFileThatGrowsIsFollowed) {
  VERIFIES("LASSO-GND-021~2");
  const WorkFolder work;
  ASSERT_EQ(work.mdat(kRun).exit_code, 0);
  const std::string recorded = work.read("run/telemetry.ccsds");
  work.write("growing", "");
  LiveRun watch(work, "watch", {"decode", "growing", "--follow", "--items", "scan_id"});
  std::size_t written = 0;
  for (const std::size_t end : {std::size_t{10}, recorded.size() / 2, recorded.size() - 1, recorded.size()}) {
    std::ofstream(work / "growing", std::ios::binary | std::ios::app) << recorded.substr(written, end - written);
    written = end;
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
  }
  EXPECT_TRUE(watch.says("  11\n")) << watch.out();
  const std::string whole = work.mdat("decode growing --items scan_id").out;
  EXPECT_EQ(lines_of(watch.out()).size(), lines_of(whole).size());
  EXPECT_EQ(work.mdat("decode growing --follow --format json").exit_code, 2);
  EXPECT_EQ(work.mdat("decode nothing --follow").exit_code, 2);
}

TEST(Link, AnotherComponentsPacketsAreWrittenAndReadByItsApid) {
  VERIFIES("LASSO-LNK-044~1");
  const WorkFolder work;
  ASSERT_EQ(work.mdat("command ping --apid 0x2A5 --out ping").exit_code, 0);
  EXPECT_EQ(work.read("ping").substr(0, 2), "\x1A\xA5") << "a command, with secondary header, for 0x2A5";
  EXPECT_NE(work.mdat("decode ping --commands --apid 677").out.find("ping"), std::string::npos);
  const Answer preset = work.mdat("decode ping --commands");
  EXPECT_EQ(preset.exit_code, 2);
  EXPECT_NE(preset.err.find("no command of APID 977"), std::string::npos) << preset.err;
  EXPECT_NE(preset.err.find("--headers lists the APIDs"), std::string::npos) << preset.err;
  EXPECT_EQ(Json::parse(work.mdat("dictionary --format json --apid 677").out).at("apid"), 677);
  const Answer idle = work.mdat("command ping --apid 2047 --out ping");
  EXPECT_EQ(idle.exit_code, 2);
  EXPECT_NE(idle.err.find("'2047' is no number from 1 to 2046"), std::string::npos) << idle.err;
}

// Of somebody else: another APID, and a secondary header of another form.
TEST(Link, HeadersOfAnyStreamAreListed) {
  VERIFIES("LASSO-GND-021~2");
  const WorkFolder work;
  // Three packets of APID 1216, put together by hand; the second one is missing, the third is damaged.
  const std::string first(
      "\x0C\xC0\xE7\x35\x00\x05"
      "abcd\xFA\x46",
      12),
      third(
          "\x0C\xC0\xE7\x37\x00\x05"
          "abcd\x00\x00",
          12);
  work.write("other.tlm", first + third + "\x0C");
  const Answer answer = work.mdat("decode --headers other.tlm");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  const std::vector<std::string> lines = lines_of(answer.out);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1], "       0  1216 telemetry     3 10037      12 right  ");
  EXPECT_EQ(lines[2], "      12  1216 telemetry     3 10039      12 WRONG  1 packet missing before");
  EXPECT_NE(answer.err.find("1 gap in the sequence, 1 packet missing; 0 restarts, 0 late, 0 repeated; 0 bytes skipped, 1 left over"),
            std::string::npos)
      << answer.err;
}

TEST(Link, RefusedInputIsNamed) {
  VERIFIES("LASSO-GND-021~2");
  const WorkFolder work;
  const Answer missing = work.mdat("decode nothing.ccsds");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_NE(missing.err.find("nothing.ccsds: no such file"), std::string::npos) << missing.err;
  work.write("empty", "");
  const Answer item = work.mdat("decode empty --items colour");
  EXPECT_EQ(item.exit_code, 2);
  EXPECT_NE(item.err.find("--items colour: no packet has it"), std::string::npos) << item.err;
  EXPECT_EQ(work.mdat("decode empty --headers --items mode").exit_code, 2);
  EXPECT_EQ(work.mdat("decode empty").exit_code, 0);
  work.write("other", "no stream of packets");
  for (const char* options : {"", "--commands", "--headers", "--format json"}) {
    const Answer answer = work.mdat(std::string("decode other ") + options);
    EXPECT_EQ(answer.exit_code, 2) << options;
    EXPECT_EQ(answer.out, "") << options;
    EXPECT_NE(answer.err.find("other: no "), std::string::npos) << answer.err;
    EXPECT_NE(answer.err.find(" in its 20 bytes: give a recorded stream"), std::string::npos) << answer.err;
  }
  EXPECT_EQ(work.mdat("dictionary --format pdf").exit_code, 2);
}

TEST(Link, InterfaceDocumentIsUpToDate) {
  VERIFIES("LASSO-GND-022~1 LASSO-SYS-020~2");
  const WorkFolder work;
  const Answer answer = work.mdat("dictionary");
  ASSERT_EQ(answer.exit_code, 0);
  EXPECT_TRUE(answer.out == read_text(source_path("docs/icd/link.md")))
      << "docs/icd/link.md is not what mdat dictionary says: make write WHAT=icd writes it";
}

// The texts of the dictionary are for the ground.
TEST(Link, FlightCodeHasNoTextOfTheDictionary) {
  VERIFIES("LASSO-LNK-035~2");
  const WorkFolder work;
  const Json dictionary = Json::parse(work.mdat("dictionary --format json").out);
  const std::string archive = read_text(test::build_folder() / "lib3dlasso_link.a");
  ASSERT_NE(archive.find("encode_pose"), std::string::npos) << "the right archive";
  for (const Json& packet : dictionary.at("packets")) {
    for (const Json& item : packet.at("items")) {
      const std::string meaning = item.at("meaning");
      if (meaning.size() > 8) {
        EXPECT_EQ(archive.find(meaning), std::string::npos) << meaning;
      }
    }
  }
  for (const Json& choices : dictionary.at("enumerations")) {
    for (const Json& choice : choices) {
      const std::string meaning = choice.at("meaning");
      if (meaning.size() > 8) {
        EXPECT_EQ(archive.find(meaning + '\0'), std::string::npos) << meaning;
      }
    }
  }
}

}  // namespace
}  // namespace lasso::ft
