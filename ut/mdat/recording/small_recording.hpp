// A recording as FrameRecorder writes it, but small: a target that turns, some points on it, packets of a few bytes.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "fsw/geometry/so3.hpp"
#include "mdat/mcap/bytes.hpp"
#include "mdat/mcap/writer.hpp"
#include "mdat/recording/recording_head.hpp"
#include "mdat/recording/ros_messages.hpp"
#include "mdat/recording/ros_schemas.hpp"

namespace lasso::mdat {

// In closed form, at any time: T_sensor_target.
inline Pose small_pose(double t_s) {
  return {exp_so3(Vec3(0.3 + 0.1 * t_s, -0.2, 0.05 * t_s)), Vec3(0.1 - 0.02 * t_s, 0.3 + 0.001 * t_s * t_s, 4 + 0.05 * t_s)};
}
inline Vec3 small_velocity(double t_s) { return {-0.02, 0.002 * t_s, 0.05}; }

class SmallRecording : public ::testing::Test {
 protected:
  SmallRecording() {
    const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / (std::string("ut-") + test->name() + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~SmallRecording() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  static std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  // Where nothing is: replacing a file may wait for the disk.
  static void put(const std::filesystem::path& file, std::string_view bytes) {
    std::filesystem::remove(file);
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

  // `frames` half a second apart, from 1 s on; a chunk each; `size_m` is that of the target.
  std::filesystem::path write(const std::string& name, int frames = 6, double size_m = 1) const {
    const std::filesystem::path place = file(name);
    mcap::Writer writer(place, "ros2", "test");
    const auto channel = [&](const char* topic, const RosSchema& schema) {
      return writer.add_channel(topic, writer.add_schema(schema.name, "ros2msg", schema.text), "cdr");
    };
    writer.attach("mission/m.toml", "text/plain", "a mission", 0);
    writer.add_metadata(kRecordingMetadata,
                        {{"mission", "mission/m.toml"}, {"scenario", "spin"}, {"seed", "7"}, {"frames", std::to_string(frames)}});
    const auto tf = channel("/tf", ros::tf_message()), scan = channel("/scan", ros::point_cloud()),
               pose = channel("/pose", ros::pose_stamped()), odom = channel("/odom", ros::odometry()),
               scene = channel("/scene", ros::scene_update()), packets = channel("/packets", ros::packet()),
               scans = channel("/sensor_scans", ros::packet());
    const std::vector<Vec3> points{Vec3(0, 0, 0), Vec3(size_m, 0, 0), Vec3(0, size_m, 0)};
    const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}};
    for (int i = 0; i < frames; ++i) {
      const TimeUs t_us = 1'000'000 + 500'000 * i;
      const auto t_ns = static_cast<std::uint64_t>(t_us) * 1000;
      const Pose truth = small_pose(to_seconds(t_us));
      writer.write(scans, t_ns, ros::packet_bytes({t_us, ""}, "scan " + std::to_string(i)));
      writer.write(packets, t_ns, ros::packet_bytes({t_us, ""}, "packet " + std::to_string(i)));
      if (i == 0)
        writer.write(scene, t_ns, ros::scene_bytes(t_us, {{"target, estimated", "target", &points, &triangles, Vec3(1, 0.5, 0), 1}}));
      writer.write(tf, t_ns, ros::tf_bytes(t_us, {{"world", "sensor", Pose{}}, {"sensor", "target", truth}}));
      writer.write(pose, t_ns, ros::pose_bytes({t_us, "sensor"}, truth));
      writer.write(odom, t_ns,
                   ros::odometry_bytes({t_us, "sensor"},
                                       {"target", truth, {Vec3::Zero(), small_velocity(to_seconds(t_us))}, Vec6::Ones(), Vec6::Ones()}));
      writer.write(scan, t_ns, ros::point_cloud_bytes({t_us, "sensor"}, small_cloud(i)));
      writer.add_metadata("frame", {{"number", std::to_string(i)}});  // ends the chunk
    }
    writer.close();
    return place;
  }

  // Four points, of which the third has no place; residual 0.5, 1.5, NaN, 3.5 mm more in each frame.
  static ros::PointCloud small_cloud(int frame) {
    ros::PointCloud cloud{{{"x", 0, ros::FieldType::kFloat32},
                           {"y", 4, ros::FieldType::kFloat32},
                           {"z", 8, ros::FieldType::kFloat32},
                           {"residual", 12, ros::FieldType::kFloat32},
                           {"state", 16, ros::FieldType::kUint8}},
                          20,
                          {}};
    for (int k = 0; k < 4; ++k) {
      const float nothing = std::numeric_limits<float>::quiet_NaN();
      const auto number = static_cast<float>(k);
      for (const float value : {number, 2 * number, 4 + number, 0.0005F + 0.001F * static_cast<float>(frame + k)})
        mcap::put(k == 2 ? nothing : value, cloud.data);
      mcap::put(static_cast<std::uint8_t>(k == 2 ? 1 : 0), cloud.data);
      cloud.data.append(3, '\0');
    }
    return cloud;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace lasso::mdat
