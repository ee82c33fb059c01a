#include "mdat/benchmark/benchmark_set.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "hal_sim/scan_file.hpp"
#include "mdat/bodies/body.hpp"
#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/replay/initial_poses.hpp"
#include "mdat/run/true_target.hpp"
#include "mdat/source/sha256.hpp"
#include "ut/mdat/benchmark/folder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using test::PassingFolder;
using test::small_plan;
using test::small_set;

fs::path copied(const PassingFolder& folder) {
  fs::copy(small_set().path(), folder / "set", fs::copy_options::recursive);
  return folder / "set";
}

void append(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::app) << text; }

TEST(BenchmarkSet, TheSamePlanGivesTheSameBytes) {
  VERIFIES("LASSO-GND-120~1");
  const PassingFolder folder;
  const BenchmarkSet again = make_set(small_plan(), folder / "set", true);
  EXPECT_EQ(again.protocol.files, small_set().set.protocol.files);
  EXPECT_EQ(file_content(folder / "set/protocol.json"), file_content(small_set().path() / "protocol.json"));
  SetPlan other = small_plan();
  other.start_deg = 5;
  const BenchmarkSet closer = make_set(other, folder / "closer", true);
  EXPECT_EQ(closer.truth[0].scans[1].T_sensor_target.p, again.truth[0].scans[1].T_sensor_target.p) << "starts alone differ";
  EXPECT_NE(closer.protocol.files.at("body_52/starts.csv"), again.protocol.files.at("body_52/starts.csv"));
}

// The scans, cast again at the truth that the tool keeps, on the mesh that other programs read: what is left is the sensor's noise.
TEST(BenchmarkSet, ScansAreThoseOfTheMeshAtTheTruth) {
  VERIFIES("LASSO-GND-120~1");
  const TrueBody& truth = small_set().set.truth.at(0);
  const fs::path body = small_set().path() / truth.name;
  const auto surface = make_target(import_mesh(body / kMeshFile, 1));
  const sim::RecordedScans scans(body / kScansFolder);
  ASSERT_EQ(scans.size(), truth.scans.size());
  const double sigma_m = small_set().set.protocol.bodies[0].noise.sigma0_m;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_EQ(scans.stem(i), truth.scans[i].scan);
    const Pose T_target_sensor = inverse(truth.scans[i].T_sensor_target);
    std::size_t hits = 0, near = 0;
    for (const RangeSample& sample : scans.read(i).samples) {
      if (sample.state != RayState::kHit) continue;
      const sim::RayHit hit = surface->cast(T_target_sensor.p, rotate(T_target_sensor.q, to_vec3(sample.direction)));
      ++hits;
      near +=
          hit.hit && std::fabs(hit.range_m - static_cast<double>(sample.range_m)) < std::max(4 * sigma_m, 0.01 * truth.size_m) ? 1U : 0U;
    }
    EXPECT_GT(hits, 100u);
    EXPECT_GT(near, 0.9 * static_cast<double>(hits));
  }
}

TEST(BenchmarkSet, StartsAreAsFarOffAsThePlanSays) {
  VERIFIES("LASSO-GND-120~1");
  const TrueBody& truth = small_set().set.truth.at(0);
  const BodyTruth made = truth_of(make_body(52));
  const Vec3 middle_m = 0.5 * (made.low_m + made.high_m);
  const std::vector<InitialPose> starts = read_initial_poses(small_set().path() / truth.name / kStartsFile);
  ASSERT_EQ(starts.size(), 2u);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Pose &start = starts[i].T_sensor_target, &true_pose = truth.scans[i].T_sensor_target;
    EXPECT_NEAR(pose_difference(start, true_pose).head<3>().norm(), 10 * kRadPerDeg, 1e-6);
    EXPECT_NEAR((start * middle_m - true_pose * middle_m).norm(), 0.1 * truth.size_m, 1e-6);
  }
}

TEST(BenchmarkSet, TheTruthIsMadeAgainAndIsNotInTheFolder) {
  VERIFIES("LASSO-GND-121~1");
  const BenchmarkSet opened = open_set(small_set().path(), true);
  for (std::size_t i = 0; i < 2; ++i) {
    const Pose &a = opened.truth[0].scans[i].T_sensor_target, &b = small_set().set.truth[0].scans[i].T_sensor_target;
    EXPECT_EQ(a.p, b.p);
    EXPECT_EQ(a.q.coeffs(), b.q.coeffs());
    EXPECT_EQ(opened.truth[0].scans[i].determined, small_set().set.truth[0].scans[i].determined);
  }
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(small_set().path())) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().lexically_relative(small_set().path()).generic_string();
    EXPECT_TRUE(name == kProtocolFile || opened.protocol.files.count(name) == 1) << name;
    ++files;
  }
  EXPECT_EQ(files, 1 + opened.protocol.files.size());
}

TEST(BenchmarkSet, AChangedScanIsNamed) {
  VERIFIES("LASSO-GND-121~1");
  const PassingFolder folder;
  const fs::path set = copied(folder), scan = set / "body_52/scans/s02.csv";
  append(scan, "9,1,1,5,1\n");
  EXPECT_EQ(error_of([&] { open_set(set, true); }).rfind(scan.string() + ": was changed after the set was made", 0), 0u);
}

// Whoever changes the protocol, too, is not believed: the seed says what the files have to be.
TEST(BenchmarkSet, AChangedScanWithItsDigestIsNamed) {
  VERIFIES("LASSO-GND-121~1");
  const PassingFolder folder;
  const fs::path set = copied(folder), scan = set / "body_52/starts.csv";
  append(scan, "\n");
  std::string protocol = file_content(set / kProtocolFile);
  const std::string digest = small_set().set.protocol.files.at("body_52/starts.csv");
  protocol.replace(protocol.find(digest), digest.size(), sha256_of_file(scan));
  write_file(set / kProtocolFile, protocol);
  EXPECT_NE(error_of([&] { open_set(set, true); }).find("protocol.json: seed 52 gives another body_52/starts.csv"), std::string::npos);
}

TEST(BenchmarkSet, ASetIsWrittenIntoANewFolderWholeOrNotAtAll) {
  VERIFIES("LASSO-GND-120~1");
  const PassingFolder folder;
  fs::create_directories(folder / "mine");
  write_file(folder / "mine/file", "mine");
  EXPECT_NE(error_of([&] { make_set(small_plan(), folder / "mine", true); }).find("mine: is there already"), std::string::npos);
  EXPECT_EQ(file_content(folder / "mine/file"), "mine");
  write_file(folder / "taken", "");
  EXPECT_NE(error_of([&] { make_set(small_plan(), folder / "taken/set", true); }), "");
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder / "")) ++entries;
  EXPECT_EQ(entries, 2u);
}

}  // namespace
}  // namespace lasso::mdat
