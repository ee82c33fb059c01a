// The preview of a mission's scan, against a box whose faces have closed forms.
#include "mdat/serve/scan_preview.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fsw/geometry/so3.hpp"
#include "mdat/missiondb/new_mission.hpp"
#include "mdat/serve/preview_answer.hpp"
#include "mdat/source/mission_error.hpp"
#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/places.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

using PreviewTestJson = nlohmann::json;

const Vec3 kHalf_m(0.7, 0.4, 0.25);  // of the box about the target's origin

// How far a place is outside the box (above 0), inside of it, or on it (0).
double outside_m(const Vec3& place_target) { return (place_target.cwiseAbs() - kHalf_m).maxCoeff(); }

// Whether a line from `from` along `direction` passes through the box, made smaller by a nanometre: the slabs of Kay and Kajiya.
bool passes_box(const Vec3& from, const Vec3& direction) {
  double enter = -1e9, leave = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double half = kHalf_m[i] - 1e-9, a = (-half - from[i]) / direction[i], b = (half - from[i]) / direction[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

Pose pose_in(const PreviewTestJson& json) {
  const std::vector<double> p = json["position_m"], q = json["quaternion_xyzw"];
  return {Quat(q[3], q[0], q[1], q[2]), Vec3(p[0], p[1], p[2])};
}

class ScanPreviewTest : public ::testing::Test {
 protected:
  ScanPreviewTest() {
    std::ofstream mesh(place_.path() / "box.obj");
    for (int i = 0; i < 8; ++i)
      mesh << "v " << ((i & 1) != 0 ? 0.7 : -0.7) << ' ' << ((i & 2) != 0 ? 0.4 : -0.4) << ' ' << ((i & 4) != 0 ? 0.25 : -0.25) << '\n';
    mesh << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    mesh.close();
    NewMissionRequest request;
    request.model = place_.path() / "box.obj";
    request.out = place_.path() / "box.toml";
    write_new_mission(request);
    std::ostringstream text;
    text << std::ifstream(request.out).rdbuf();
    text_ = text.str();
  }
  std::string file() const { return place_.path() / "box.toml"; }
  // With a line of the text in place of the one that begins with `key`.
  std::string changed(const std::string& key, const std::string& line) const {
    const std::size_t from = text_.find("\n" + key + " = ") + 1;
    return std::string(text_).replace(from, text_.find('\n', from) - from, line);
  }
  PreviewTestJson answered(const std::string& text, const std::string& scenario = "spin") const {
    return PreviewTestJson::parse(preview_json({"box.toml", file(), false}, text, scenario, 0));
  }

  TestFolder place_;
  std::string text_;
};

TEST_F(ScanPreviewTest, RaysEndOnTheTargetWhereTheScenarioBegins) {
  VERIFIES("LASSO-WEB-033~2");
  const MissionSource source = load_mission(file());
  const ScanPreview preview = preview_scan(source, load_target(source), "spin", 0);
  EXPECT_NEAR(preview.T_sensor_target.p.norm(), preview.ranges_m.front(), 1e-6) << "its middle is the target's origin";
  EXPECT_NEAR(preview.size_m, 2 * kHalf_m.norm(), 1e-6);
  ASSERT_EQ(preview.rays.size(), 1024U);
  const Pose T_target_sensor = inverse(preview.T_sensor_target);
  std::size_t hits = 0;
  for (const PreviewRay& ray : preview.rays) {
    const Vec3 direction = rotate(T_target_sensor.q, ray.place_m.normalized());
    EXPECT_EQ(ray.hit, passes_box(T_target_sensor.p, direction));
    if (ray.hit) {
      EXPECT_NEAR(outside_m(T_target_sensor * ray.place_m), 0, 1e-6);
    }
    if (!ray.hit) {
      EXPECT_NEAR(ray.place_m.norm(), preview.T_sensor_target.p.norm(), 1e-9);
    }
    hits += ray.hit ? 1 : 0;
  }
  EXPECT_GT(hits, 300U);
  EXPECT_NEAR(preview.rays.back().time_s, preview.parameters.duration_s, 1e-5);
  EXPECT_THROW(preview_scan(source, load_target(source), "none", 0), MissionError);
}

TEST_F(ScanPreviewTest, FollowsTheTextThatIsEdited) {
  VERIFIES("LASSO-WEB-033~2");
  const PreviewTestJson before = answered(text_);
  ASSERT_TRUE(before.contains("rays")) << before;
  EXPECT_EQ(before["rays"]["x"].size(), 1024U);
  EXPECT_EQ(answered(changed("points", "points = 512"))["rays"]["x"].size(), 512U);
  const PreviewTestJson narrow = answered(changed("fov_half_x_deg", "fov_half_x_deg = 4"));
  EXPECT_NEAR(narrow["camera"]["frustum_deg"][0].get<double>(), 8, 1e-9);
  EXPECT_EQ(narrow["surface"], before["surface"]);
  EXPECT_NE(answered(changed("pattern", "pattern = \"lissajous\""))["rays"]["x"], before["rays"]["x"]);
  EXPECT_NE(answered(changed("scale", "scale = 1.1"))["surface"], before["surface"]);
  EXPECT_EQ(answered(text_, "none")["scenario"], load_mission(file()).scenarios.begin()->first);
  EXPECT_NE(answered(changed("points", "points = 5"))["problem"].get<std::string>().find("scan.points"), std::string::npos);
  const Response surface = mission_surface({"box.toml", file(), false}, text_);
  EXPECT_EQ(surface.body.substr(0, 4), "glTF");
}

// A camera 0.5 m beside the head, turned towards the target by atan(0.5 / 4): its own axis passes the box's middle 4 m ahead.
TEST_F(ScanPreviewTest, AFurtherSensorScansFromItsOwnPlace) {
  VERIFIES("LASSO-WEB-033~2");
  const double half_rad = -std::atan(0.5 / 4) / 2;
  std::ostringstream more;
  more << std::setprecision(17)
       << "\n[further_sensor.mast]\nuse_to_m = 6\nnode = \"mast\"\n[node.body]\ntarget = true\n[node.head]\nsensor = true\n"
       << "[node.mast]\nparent = \"head\"\nposition_m = [0.5, 0, 0]\nquaternion = [0, " << std::sin(half_rad) << ", 0, "
       << std::cos(half_rad) << "]\n[scenario.near]\nranges_m = [4.0]\noffset_m = [0, 0]\nframes = 1\n";
  const std::string text = changed("use_from_m", "use_from_m = 5") + more.str();
  const PreviewTestJson seen = answered(text, "near");
  ASSERT_TRUE(seen.contains("rays")) << seen;
  EXPECT_EQ(seen["sensor"], "mast");
  const Pose T_target_own = inverse(pose_in(seen["pose"])) * pose_in(seen["own"]);
  const Vec3 middle = inverse(T_target_own).p;
  EXPECT_LT((middle - Vec3(0, 0, std::sqrt(0.25 + 16))).norm(), 1e-9) << middle.transpose();
  int hits = 0;
  for (std::size_t i = 0; i < seen["rays"]["x"].size(); ++i) {
    const Vec3 place(seen["rays"]["x"][i], seen["rays"]["y"][i], seen["rays"]["z"][i]);
    const bool hit = seen["rays"]["hit"][i] == 1;
    EXPECT_NEAR(hit ? outside_m(T_target_own * place) : 0, 0, 2e-6) << i;
    hits += hit ? 1 : 0;
  }
  EXPECT_GT(hits, 300);
}

// Each shipped mission, scenes with other bodies and stereo heads among them.
TEST_F(ScanPreviewTest, AllShippedMissionsHaveOne) {
  VERIFIES("LASSO-WEB-033~2");
  std::size_t missions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_folder() / "cfg/missions")) {
    const std::string shipped = entry.path().string(), text = bytes_of_file(shipped);
    const PreviewTestJson preview = PreviewTestJson::parse(preview_json({entry.path().stem(), shipped, true}, text, "", 0));
    ASSERT_TRUE(preview.contains("rays")) << shipped << preview;
    const std::vector<int> hits = preview["rays"]["hit"];
    EXPECT_GT(std::count(hits.begin(), hits.end(), 1), 100) << shipped;
    ++missions;
  }
  EXPECT_GE(missions, 7U);
}

}  // namespace
}  // namespace lasso::mdat::serve
