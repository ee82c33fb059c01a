// mdat/recording/export_clouds.cpp, export_scene.cpp, export_tables.cpp, export_h5.cpp.
#include <hdf5.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "hal_sim/scan_file.hpp"
#include "mdat/recording/recording_export.hpp"
#include "ut/mdat/recording/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using ExportClouds = SmallRecording;

// The readers of other people's scans know these forms.
TEST_F(ExportClouds, PlyAndPcdAreReadAgain) {
  VERIFIES("LASSO-REC-014~1");
  const auto run = write("run.mcap");
  const ExportedFiles ply = export_ply(run, {}), pcd = export_pcd(run, {});
  ASSERT_EQ(ply.files.size(), 6U);
  ASSERT_EQ(pcd.files.size(), 6U);
  put(file("a.ply"), ply.files.at("scan00003.ply"));
  put(file("a.pcd"), pcd.files.at("scan00003.pcd"));
  for (const char* name : {"a.ply", "a.pcd"}) {
    const sim::RawScan scan = sim::read_raw_scan(file(name));
    ASSERT_EQ(scan.rays.size(), 3U) << "the point without a place is left out";
    for (std::size_t i = 0; i < 3; ++i) {
      const double k = i == 2 ? 3 : static_cast<double>(i);
      EXPECT_LT((scan.rays[i].place - Vec3(k, 2 * k, 4 + k)).norm(), 1e-6) << name;
    }
  }
  EXPECT_NE(ply.files.at("scan00003.ply").find("property float residual\nproperty uchar state\n"), std::string::npos);
}

// glTF's own rules: lengths, extents of positions, and a y axis that is up.
TEST_F(ExportClouds, TheSceneIsAGlbOfTheScanAndTheTarget) {
  VERIFIES("LASSO-REC-014~1");
  ExportOptions options;
  options.span = span_of(2.0, std::nullopt);
  const std::string bytes = export_glb(write("run.mcap"), options);
  std::uint32_t words[5] = {};
  std::memcpy(words, bytes.data(), sizeof words);
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(words[2], bytes.size());
  const auto json = nlohmann::json::parse(bytes.substr(20, words[3]));
  EXPECT_EQ(json.at("nodes")[0].at("rotation"), nlohmann::json({1, 0, 0, 0}));
  EXPECT_EQ(json.at("nodes")[0].at("children").size(), 2U);
  const auto& target = json.at("nodes")[2];
  EXPECT_EQ(target.at("name"), "target, estimated");
  const Pose pose = small_pose(2);
  EXPECT_EQ(target.at("translation"), nlohmann::json({pose.p.x(), pose.p.y(), pose.p.z()}));
  EXPECT_EQ(target.at("rotation"), nlohmann::json({pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()}));
  EXPECT_EQ(json.at("accessors")[0].at("count"), 3);
  EXPECT_EQ(json.at("accessors")[0].at("max"), nlohmann::json({3.0, 6.0, 7.0}));
  std::uint64_t last = 0;
  for (const auto& view : json.at("bufferViews")) {
    EXPECT_EQ(view.at("byteOffset").get<std::uint64_t>() % 4, 0U);
    last = view.at("byteOffset").get<std::uint64_t>() + view.at("byteLength").get<std::uint64_t>();
  }
  EXPECT_LE(last, json.at("buffers")[0].at("byteLength").get<std::uint64_t>());
  EXPECT_EQ(20 + words[3] + 8 + json.at("buffers")[0].at("byteLength").get<std::uint64_t>(), bytes.size());
}

TEST_F(ExportClouds, TablesHaveARowAMessage) {
  VERIFIES("LASSO-REC-014~1");
  const ExportedFiles csv = export_csv(write("run.mcap"), {});
  ASSERT_EQ(csv.files.size(), 2U);
  const std::string& pose = csv.files.at("pose.csv");
  EXPECT_EQ(pose.substr(0, pose.find('\n')),
            "t_s,header.stamp.sec,header.stamp.nanosec,header.frame_id,pose.position.x,pose.position.y,pose.position.z,pose.orientation.x,"
            "pose.orientation.y,pose.orientation.z,pose.orientation.w");
  EXPECT_EQ(std::count(pose.begin(), pose.end(), '\n'), 7);
  EXPECT_EQ(csv.notes.size(), 5U) << "what is no table is told";
  EXPECT_EQ(export_packets(file("run.mcap"), {}), "packet 0packet 1packet 2packet 3packet 4packet 5");
}

// By the library's own reading.
TEST_F(ExportClouds, Hdf5HoldsTablesAndClouds) {
  VERIFIES("LASSO-REC-014~1");
  put(file("run.h5"), export_h5(write("run.mcap"), {}));
  const hid_t in = H5Fopen(file("run.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(in, 0);
  const auto read = [&](const char* name) {
    const hid_t set = H5Dopen2(in, name, H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(set);
    return values;
  };
  EXPECT_EQ(read("pose/t_s"), (std::vector<double>{1, 1.5, 2, 2.5, 3, 3.5}));
  EXPECT_EQ(read("pose/pose.position.z")[2], small_pose(2).p.z());
  EXPECT_EQ(read("scan/first"), (std::vector<double>{0, 4, 8, 12, 16, 20}));
  EXPECT_EQ(read("scan/y")[13], 2);
  EXPECT_EQ(read("scan/state")[14], 1);
  H5Fclose(in);
}

}  // namespace
}  // namespace lasso::mdat
