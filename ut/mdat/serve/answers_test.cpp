// Summary, frames, one frame, scan, events and surface of a recording whose values are known by construction.
#include "mdat/serve/answers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "mdat/serve/frame_facts.hpp"
#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

using Json = nlohmann::json;

class Answers : public ::testing::Test {
 protected:
  Answers() : shown_(shown_of(SmallRecording{}.write(folder_.path() / "a.mcap"))) {}
  TestFolder folder_;
  Shown shown_;
};

TEST_F(Answers, TheSummarySaysWhatIsInTheRecording) {
  VERIFIES("LASSO-WEB-008~1 LASSO-WEB-009~1");
  const Json json = Json::parse(summary_answer(shown_).body);
  EXPECT_EQ(json["frames"], 6);
  EXPECT_EQ(json["command"], "mdat replay a.mcap");
  EXPECT_EQ(json["scenario"], "boxes");
  EXPECT_EQ(json["seed"], 7);
  EXPECT_EQ(json["settings"], (Json{{"a.b", "1"}, {"c.d", "2"}}));
  EXPECT_NEAR(json["start_s"], 1.1, 1e-9);
  EXPECT_NEAR(json["end_s"], 2.1, 1e-9);
  EXPECT_EQ(json["modes"][2], "tracking");
  std::size_t numbers = fact_values(0).size();
  for (const ItemRow& item : kTelemetry[0].items) numbers += item.count;
  EXPECT_EQ(json["values"].size(), numbers);
  const MissionParameters preset = preset_parameters();
  EXPECT_NEAR(json["camera"]["frustum_deg"][0], 2 * preset.fov_half_x_rad / kRadPerDeg, 1e-6);
  for (const Json& topic : json["topics"]) {
    EXPECT_TRUE(topic["name"] != "/scan" || topic["messages"] == 5);
  }
  EXPECT_NEAR(json["size_m"], 2 * shown_.recording->image()->mission().radius_m, 1e-9);
}

TEST_F(Answers, ColumnsComeInTheirOrder) {
  VERIFIES("LASSO-WEB-008~1");
  const std::string bytes = frames_answer(shown_, target_of("/?columns=time_s,wrong,valid,pose.inliers,mode")).body;
  ASSERT_EQ(bytes.size(), 6 * (8 + 4 * 4));
  for (std::size_t n = 0; n < 6; ++n) {
    EXPECT_NEAR(number_at_byte<double>(bytes, 8 * n), 1.1 + 0.2 * static_cast<double>(n), 1e-9);
    EXPECT_EQ(number_at_byte<float>(bytes, 48 + 4 * n), n == 3 ? 1 : 0);
    EXPECT_EQ(number_at_byte<float>(bytes, 72 + 4 * n), n == 2 || n == 4 ? 0 : 1);
    EXPECT_EQ(number_at_byte<float>(bytes, 96 + 4 * n), n == 2 ? 7 : 290 + static_cast<float>(n));
    EXPECT_EQ(number_at_byte<float>(bytes, 120 + 4 * n), 2);
  }
  EXPECT_THROW((void)frames_answer(shown_, target_of("/?columns=nothing")), Refusal);
}

// As the run counts: the period is the image's, and frame 0 begins at 1 s. Without an image those that were told are counted.
TEST_F(Answers, FramesHaveTheNumbersOfTheirTimes) {
  VERIFIES("LASSO-WEB-122~1");
  const std::string bytes = frames_answer(shown_, target_of("/?columns=number&from=1")).body;
  const TimeUs period_us = to_us(preset_parameters().period_s);
  ASSERT_EQ(bytes.size(), 4 * 5U);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(number_at_byte<float>(bytes, 4 * i), static_cast<float>((SmallRecording::time_us(1 + i) - 1'000'000) / period_us)) << i;
  const TestFolder folder;
  SmallRecording small;
  small.with_image = false;
  const Shown without = shown_of(small.write(folder.path() / "b.mcap"));
  const std::string told = frames_answer(without, target_of("/?columns=number&from=3")).body;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(number_at_byte<float>(told, 4 * i), static_cast<float>(3 + i));
}

TEST_F(Answers, AFrameHasItsPosesErrorsAndReason) {
  VERIFIES("LASSO-WEB-008~1 LASSO-WEB-010~1");
  const Json json = Json::parse(frame_answer(shown_, 1).body);
  EXPECT_EQ(json["mode"], "tracking");
  EXPECT_EQ(json["valid"], true);
  EXPECT_EQ(json["wrong"], false);
  EXPECT_EQ(json["hits"], 300);
  EXPECT_EQ(json["missed"], 141);
  EXPECT_NEAR(json["error"]["position_mm"], 5, 1e-6);
  EXPECT_NEAR(json["error"]["angle_deg"], 0.2, 1e-6);
  const Pose estimate = SmallRecording::estimate(1), truth = SmallRecording::truth(1);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(json["poses"]["estimate"]["position_m"][static_cast<std::size_t>(i)], estimate.p[i], 1e-12);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(json["poses"]["truth"]["quaternion_xyzw"][static_cast<std::size_t>(i)], truth.q.coeffs()[i], 1e-12);
  EXPECT_EQ(json["T_world_sensor"]["position_m"], (Json{1.0, 2.0, 3.0}));
  EXPECT_NEAR(json["covariance"][0], 16e-6, 1e-12);  // translation first
  EXPECT_NEAR(json["covariance"][21], 1e-6, 1e-12);  // then rotation
  EXPECT_NEAR(json["covariance"][22], 0.5e-6, 1e-12);
  const Json refused = Json::parse(frame_answer(shown_, 2).body);
  EXPECT_EQ(refused["reason"], "too_few_inliers");
  EXPECT_NE(refused["why"].get<std::string>().find("inliers 7"), std::string::npos);
  const Json lost = Json::parse(frame_answer(shown_, 4).body);
  EXPECT_TRUE(lost["error"].is_null() && lost["covariance"].is_null() && lost["rms_mm"].is_null() && lost["iterations"].is_null());
  EXPECT_TRUE(lost["gates"].empty());
}

TEST_F(Answers, AScanHasEveryRayInOrder) {
  VERIFIES("LASSO-WEB-008~1");
  const std::string bytes = scan_answer(shown_, 1, target_of("/")).body;
  const std::vector<RangeSample> scan = SmallRecording::scan(1);
  const std::size_t n = scan.size();
  ASSERT_EQ(bytes.size(), 8 + 9 * 4 * n);
  EXPECT_EQ(number_at_byte<std::uint32_t>(bytes, 0), n);
  EXPECT_EQ(number_at_byte<std::uint32_t>(bytes, 4), 9U);
  const double miss_m = SmallRecording::estimate(1).p.norm();
  const auto cell = [&](std::size_t column, std::size_t row) { return number_at_byte<float>(bytes, 8 + 4 * (column * n + row)); };
  std::size_t hits = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool hit = scan[i].state == RayState::kHit;
    hits += hit ? 1 : 0;
    const double range_m = hit ? static_cast<double>(scan[i].range_m) : miss_m;
    EXPECT_NEAR(cell(2, i), range_m * static_cast<double>(scan[i].direction[2]), 1e-5);
    EXPECT_EQ(std::isnan(cell(3, i)), !hit);
    EXPECT_EQ(std::isnan(cell(4, i)), !hit);
    EXPECT_EQ(std::isnan(cell(5, i)), !hit);
    EXPECT_TRUE(!hit || std::abs(static_cast<double>(cell(3, i)) - 0.001 * static_cast<double>(i)) < 1e-6) << i;
    EXPECT_TRUE(!hit || cell(4, i) == 0.002F) << i;
    EXPECT_NEAR(cell(6, i), to_seconds(scan[i].t_us - SmallRecording::time_us(1)), 1e-6);
    EXPECT_EQ(cell(7, i), static_cast<float>(scan[i].state));
    EXPECT_EQ(cell(8, i), 0);
  }
  EXPECT_GT(hits, 50U);
  EXPECT_LT(hits, n);
  EXPECT_EQ(scan_answer(shown_, 4, target_of("/")).body, std::string("\0\0\0\0\x9\0\0\0", 8));  // lost
}

TEST_F(Answers, EventsAreFiltered) {
  VERIFIES("LASSO-WEB-008~1");
  const auto total = [&](const std::string& query) {
    return Json::parse(events_answer(shown_, target_of("/?" + query)).body)["total"].get<int>();
  };
  EXPECT_EQ(total(""), 1);
  EXPECT_EQ(total("level=warning"), 1);
  EXPECT_EQ(total("level=error"), 0);
  EXPECT_EQ(total("filter=LOSS+thin"), 1);
  EXPECT_EQ(total("filter=other"), 0);
  EXPECT_TRUE(Json::parse(events_answer(shown_, target_of("/?from=1")).body)["events"].empty());
  EXPECT_THROW((void)total("level=loud"), Refusal);
}

// The header's lengths, and every triangle of the three boxes with its outward normal.
TEST_F(Answers, TheSurfaceIsBinaryGltf) {
  VERIFIES("LASSO-WEB-008~1");
  const std::string glb = model_answer(shown_).body;
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(number_at_byte<std::uint32_t>(glb, 4), 2U);
  EXPECT_EQ(number_at_byte<std::uint32_t>(glb, 8), glb.size());
  const auto json_size = number_at_byte<std::uint32_t>(glb, 12);
  EXPECT_EQ(json_size % 4, 0U);
  const Json json = Json::parse(glb.substr(20, json_size));
  const std::size_t corners = json["accessors"][0]["count"];
  EXPECT_EQ(corners, 3U * 12 * 3);
  EXPECT_EQ(json["buffers"][0]["byteLength"], 2 * 12 * corners);
  EXPECT_EQ(number_at_byte<std::uint32_t>(glb, 20 + json_size), 2 * 12 * corners);
  const std::size_t binary = 28 + json_size;
  for (std::size_t i = 0; i < corners; ++i) {
    Vec3 point, normal;
    for (std::size_t k = 0; k < 3; ++k) {
      point[static_cast<int>(k)] = static_cast<double>(number_at_byte<float>(glb, binary + 12 * i + 4 * k));
      normal[static_cast<int>(k)] = static_cast<double>(number_at_byte<float>(glb, binary + 12 * (corners + i) + 4 * k));
    }
    const test::BoxModel box = test::uneven_boxes()[i / 36];
    EXPECT_NEAR(normal.norm(), 1, 1e-6);
    EXPECT_NEAR((point - box.center).dot(normal), box.half.dot(normal.cwiseAbs()), 1e-6) << i;
  }
}

TEST_F(Answers, AnotherProgramsRecordingSaysWhatIsNotKnown) {
  VERIFIES("LASSO-WEB-008~1");
  SmallRecording small;
  small.own = small.with_image = small.with_truth = false;
  const Shown shown = shown_of(small.write(folder_.path() / "other.mcap"));
  const Json frame = Json::parse(frame_answer(shown, 2).body);
  EXPECT_TRUE(frame["valid"].is_null() && frame["poses"]["estimate"].is_null());
  EXPECT_EQ(number_at_byte<std::uint32_t>(scan_answer(shown, 2, target_of("/")).body, 0), SmallRecording::kRays * SmallRecording::kRays);
  const std::string flags = frames_answer(shown, target_of("/?columns=valid")).body;
  EXPECT_TRUE(std::isnan(number_at_byte<float>(flags, 0)));
  EXPECT_TRUE(Json::parse(summary_answer(shown).body)["camera"].is_null());
}

}  // namespace
}  // namespace lasso::mdat::serve
