#include "mdat/benchmark/protocol.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mdat/common/output.hpp"
#include "mdat/source/sha256.hpp"
#include "ut/mdat/benchmark/folder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using Json = nlohmann::ordered_json;
using test::error_of;
using test::PassingFolder;

Protocol some_protocol() {
  Protocol protocol;
  protocol.plan = {7, 2, 3, SensorKind::kTimeOfFlight, 4.5};
  protocol.made_by = "mdat 9";
  protocol.bodies = {{"body_7", SensorKind::kTimeOfFlight, {0.02, 5e-7, 1e-4, 3e-5}, 4.25},
                     {"body_8", SensorKind::kLaserCamera, {0, 1e-4, 1e-4, 1e-5}, 0.5}};
  protocol.files = {{"body_7/mesh.stl", sha256_of("mesh")}, {"body_7/starts.csv", sha256_of("starts")}};
  return protocol;
}

void write_protocol(const PassingFolder& folder, const Json& json) { write_file(folder / kProtocolFile, json.dump()); }

TEST(BenchmarkProtocol, ReadsBackAsItWasWritten) {
  VERIFIES("LASSO-GND-120~1");
  const PassingFolder folder;
  for (const std::optional<SensorKind> sensor : {std::optional<SensorKind>(), std::optional(SensorKind::kTimeOfFlight)}) {
    Protocol written = some_protocol();
    written.plan.sensor = sensor;
    write_file(folder / kProtocolFile, protocol_json(written));
    const Protocol read = read_protocol(folder / "");
    EXPECT_EQ(protocol_json(read), protocol_json(written));
    EXPECT_EQ(read.plan.sensor, sensor);
    EXPECT_EQ(read.plan.seed, 7u);
    EXPECT_DOUBLE_EQ(read.plan.start_share(), 0.045);
    EXPECT_DOUBLE_EQ(read.bodies.at(0).noise.sigma_k_per_m, 5e-7);
    EXPECT_EQ(read.bodies.at(1).sensor, SensorKind::kLaserCamera);
    EXPECT_EQ(read.files, written.files);
  }
}

TEST(BenchmarkProtocol, SaysTheScoreAsItIsJudged) {
  VERIFIES("LASSO-GND-120~1");
  const Json score = Json::parse(protocol_json(some_protocol())).at("score");
  EXPECT_EQ(score.at("near_translation_over_size"), 0.015);
  EXPECT_EQ(score.at("near_rotation_deg"), 1.0);
  EXPECT_EQ(score.at("wrong_squared_error_over"), 25.0);
}

TEST(BenchmarkProtocol, ScansAreNamedAsWideAsTheirCount) {
  VERIFIES("LASSO-GND-120~1");
  const SetPlan few{1, 1, 12, std::nullopt, 10}, many{1, 1, 120, std::nullopt, 10};
  EXPECT_EQ(scan_name(few, 3), "s03");
  EXPECT_EQ(scan_name(many, 3), "s003");
  for (const char* name : {"s01", "s12"}) EXPECT_TRUE(has_scan(few, name)) << name;
  for (const char* name : {"", "s", "s1", "s00", "s13", "s001", "x01", "s01x", "01"}) EXPECT_FALSE(has_scan(few, name)) << name;
}

TEST(BenchmarkProtocol, WhatIsNoneIsRefusedWithFileAndRemedy) {
  VERIFIES("LASSO-GND-121~1");
  const PassingFolder folder;
  const std::string file = (folder / kProtocolFile).string();
  EXPECT_EQ(error_of([&] { read_protocol(folder / ""); }).rfind(file + ": there is none; mdat benchmark make", 0), 0u);
  const auto refused = [&](const std::function<void(Json&)>& change, const std::string& why) {
    Json json = Json::parse(protocol_json(some_protocol()));
    change(json);
    write_protocol(folder, json);
    const std::string said = error_of([&] { read_protocol(folder / ""); });
    EXPECT_EQ(said.rfind(file + ": ", 0), 0u) << said;
    EXPECT_NE(said.find(why), std::string::npos) << said;
    EXPECT_NE(said.find("make the set again"), std::string::npos) << said;
  };
  refused([](Json& json) { json = 3; }, "is not the protocol of a benchmark set");
  refused([](Json& json) { json["format"] = "other"; }, "is not the protocol of a benchmark set");
  refused([](Json& json) { json["version"] = 99; }, "is of version 99, expected 1");
  refused([](Json& json) { json.erase("sha256"); }, "is not whole");
  refused([](Json& json) { json["seed"] = -1; }, "seed is -1, expected 0 to 4294967295");
  refused([](Json& json) { json["bodies"] = 0; }, "bodies is 0, expected 1 to 10000");
  refused([](Json& json) { json["scans"] = 2.5; }, "scans is 2.5, expected 1 to 10000");
  refused([](Json& json) { json["sensor"] = "sonar"; }, "sensor is 'sonar', expected laser_camera or lidar");
  refused([](Json& json) { json["start"]["turn_deg"] = 90; }, "turn_deg is 90, expected 0.1 to 20");
  refused([](Json& json) { json["targets"][0].erase("sigma"); }, "is not whole");
  write_file(folder / kProtocolFile, "{");
  EXPECT_NE(error_of([&] { read_protocol(folder / ""); }).find("is not the protocol"), std::string::npos);
}

TEST(BenchmarkProtocol, AFileThatIsChangedOrGoneIsNamed) {
  VERIFIES("LASSO-GND-121~1");
  const PassingFolder folder;
  std::filesystem::create_directories(folder / "body_7");
  write_file(folder / "body_7/mesh.stl", "mesh");
  write_file(folder / "body_7/starts.csv", "starts");
  EXPECT_EQ(error_of([&] { check_files(folder / "", some_protocol()); }), "");
  write_file(folder / "body_7/starts.csv", "start");
  const std::string changed = error_of([&] { check_files(folder / "", some_protocol()); });
  EXPECT_EQ(changed.rfind((folder / "body_7/starts.csv").string() + ": was changed after the set was made", 0), 0u) << changed;
  std::filesystem::remove(folder / "body_7/mesh.stl");
  const std::string gone = error_of([&] { check_files(folder / "", some_protocol()); });
  EXPECT_EQ(gone.rfind((folder / "body_7/mesh.stl").string() + ": ", 0), 0u) << gone;
}

TEST(BenchmarkProtocol, ASetThatItsSeedDoesNotGiveIsRefused) {
  VERIFIES("LASSO-GND-121~1");
  const Protocol made = some_protocol();
  EXPECT_EQ(error_of([&] { check_made_again("set", made, made); }), "");
  Protocol elsewhere = made;
  elsewhere.made_by = "mdat 8";
  EXPECT_EQ(error_of([&] { check_made_again("set", elsewhere, made); }), "") << "who made it does not matter";
  Protocol changed = made;
  changed.files["body_7/starts.csv"] = sha256_of("other");
  EXPECT_NE(error_of([&] { check_made_again("set", changed, made); }).find("seed 7 gives another body_7/starts.csv"), std::string::npos);
  changed = made;
  changed.files.erase("body_7/mesh.stl");
  EXPECT_NE(error_of([&] { check_made_again("set", changed, made); }).find("body_7/mesh.stl"), std::string::npos);
  changed = made;
  changed.files["body_7/more"] = sha256_of("more");
  EXPECT_NE(error_of([&] { check_made_again("set", changed, made); }), "");
  changed = made;
  changed.bodies[0].noise.sigma0_m *= 2;
  EXPECT_NE(error_of([&] { check_made_again("set", changed, made); }).find("set/protocol.json: was changed"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
