#include "mdat/recording/scan_cloud.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "fsw/geometry/so3.hpp"
#include "hal_sim/random.hpp"
#include "mdat/recording/topic_reader.hpp"
#include "ut/mdat/recording/small_recording.hpp"
#include "ut/mdat/recording/wall.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

std::vector<RangeSample> random_scan(std::uint64_t seed, TimeUs t_us = 5'000'000) {
  sim::Random random(seed);
  std::vector<RangeSample> samples;
  for (int i = 0; i < 50; ++i) {
    const double x = random.uniform(-0.2, 0.2), y = random.uniform(-0.2, 0.2);
    const Vec3 direction = Vec3(x, y, 1).normalized();
    RangeSample sample;
    for (int k = 0; k < 3; ++k) sample.direction[k] = static_cast<float>(direction[k]);
    sample.state = static_cast<RayState>(random.bits() % 4);
    sample.range_m = sample.state == RayState::kHit ? static_cast<float>(random.uniform(1, 9)) : 0;
    sample.sigma_factor = static_cast<float>(random.uniform(1, 3));
    sample.t_us = t_us + 100 * i;
    samples.push_back(sample);
  }
  return samples;
}

bool same_bits(const RangeSample& a, const RangeSample& b) {
  return std::memcmp(a.direction, b.direction, sizeof a.direction) == 0 && std::memcmp(&a.range_m, &b.range_m, sizeof a.range_m) == 0 &&
         std::memcmp(&a.sigma_factor, &b.sigma_factor, sizeof a.sigma_factor) == 0 && a.t_us == b.t_us && a.state == b.state;
}

TEST(ScanCloud, HoldsEachSampleBitByBit) {
  VERIFIES("LASSO-REC-005~1");
  const std::vector<RangeSample> samples = random_scan(8);
  const ScanView view{samples, 5'002'500, {Quat::Identity(), Vec3(0, 0, 4)}, Twist{}};
  std::vector<RangeSample> back;
  ASSERT_TRUE(samples_of(scan_cloud(view, test::Wall()), view.t_us, back));
  ASSERT_EQ(back.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_TRUE(same_bits(samples[i], back[i])) << i;
}

// A scan as a program finds it that knows the message's definition alone: numbers by the names, places and types of its fields.
struct ReadCloud {
  explicit ReadCloud(const mcap::MessageValue& message)
      : value(message), step(message.at("point_step").get<std::size_t>()), data(message.at("data").get_binary()) {}
  std::uint32_t word(std::size_t point, const std::string& name, ros::FieldType type) const {
    for (const mcap::MessageValue& field : value.at("fields")) {
      if (field.at("name") != name) continue;
      EXPECT_EQ(field.at("datatype"), static_cast<int>(type)) << name;
      std::uint32_t word = 0;
      std::memcpy(&word, data.data() + point * step + field.at("offset").get<std::size_t>(), type == ros::FieldType::kUint8 ? 1 : 4);
      return word;
    }
    ADD_FAILURE() << "no field " << name;
    return 0;
  }
  const mcap::MessageValue& value;
  std::size_t step;
  const std::vector<std::uint8_t>& data;
};

using ScanCloudFile = SmallRecording;

TEST_F(ScanCloudFile, OtherProgramsReadEachSampleBitByBit) {
  VERIFIES("LASSO-REC-005~1");
  const TimeUs t_us = 1'764'000'000'000'000;  // in 2025
  const std::vector<RangeSample> samples = random_scan(12, t_us);
  const ScanView view{samples, t_us + 2'500, {Quat::Identity(), Vec3(0, 0, 4)}, Twist{}};
  mcap::Writer writer(file("scan.mcap"), "ros2", "test");
  const std::uint16_t schema = writer.add_schema(ros::point_cloud().name, "ros2msg", ros::point_cloud().text);
  writer.write(writer.add_channel("/scan", schema, "cdr"), 0,
               ros::point_cloud_bytes({view.t_us, "sensor"}, scan_cloud(view, test::Wall())));
  writer.close();
  mcap::MessageValue message;
  (void)read_topics(
      file("scan.mcap"), {}, [](const TopicName&) { return true; }, [&](const TopicMessage& read) { message = read.value; });
  const ReadCloud cloud(message);
  ASSERT_EQ(cloud.data.size(), samples.size() * cloud.step);
  const mcap::MessageValue& stamp = message.at("header").at("stamp");
  const TimeUs stamp_us = 1'000'000 * stamp.at("sec").get<TimeUs>() + stamp.at("nanosec").get<TimeUs>() / 1000;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const RangeSample& sample = samples[i];
    const std::pair<const char*, float> numbers[] = {{"ux", sample.direction[0]},
                                                     {"uy", sample.direction[1]},
                                                     {"uz", sample.direction[2]},
                                                     {"range", sample.range_m},
                                                     {"sigma_factor", sample.sigma_factor}};
    for (const auto& [name, number] : numbers)
      EXPECT_EQ(cloud.word(i, name, ros::FieldType::kFloat32), std::bit_cast<std::uint32_t>(number)) << i << " " << name;
    EXPECT_EQ(cloud.word(i, "state", ros::FieldType::kUint8), static_cast<std::uint32_t>(sample.state)) << i;
    const auto offset_us = static_cast<std::int32_t>(cloud.word(i, "offset_us", ros::FieldType::kInt32));
    EXPECT_EQ(stamp_us + offset_us, sample.t_us) << i;
  }
}

// A wall that turns and comes nearer, in closed form: n(t) . (range u - p(t)) = 0.
TEST(ScanCloud, ResidualsAreOfTheTargetAtEachRaysOwnTime) {
  VERIFIES("LASSO-REC-001~1");
  const std::vector<RangeSample> samples = random_scan(9);
  const Twist rates{Vec3(0.1, -0.2, 0.05), Vec3(0.02, 0.01, -0.3)};
  const ScanView view{samples, 5'000'000, {exp_so3(Vec3(0.2, 0.1, -0.4)), Vec3(0.1, -0.1, 4)}, rates};
  const ros::PointCloud cloud = scan_cloud(view, test::Wall());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    float residual_m = 0;
    std::memcpy(&residual_m, cloud.data.data() + i * cloud.step + 32, sizeof residual_m);
    EXPECT_EQ(std::isnan(residual_m), samples[i].state != RayState::kHit);
    if (samples[i].state != RayState::kHit) continue;
    const double t_s = 1e-4 * static_cast<double>(i);
    const Vec3 n = exp_so3(t_s * rates.omega_radps) * (view.T_sensor_target.q * Vec3::UnitZ());
    const Vec3 u = Eigen::Vector3f(samples[i].direction).cast<double>().normalized();
    const double range_m = n.dot(view.T_sensor_target.p + t_s * rates.v_mps) / n.dot(u);
    EXPECT_NEAR(residual_m, static_cast<double>(samples[i].range_m) - range_m, 1e-5) << i;
  }
}

TEST(ScanCloud, TellsEachRangesNoiseAndThePart) {
  VERIFIES("LASSO-REC-026~1");
  const std::vector<RangeSample> samples = random_scan(11);
  ScanView view{samples, 5'000'000, {Quat::Identity(), Vec3(0, 0, 4)}, Twist{}};
  view.part = 3;
  view.sigma0_m = 0.003;
  view.sigma_k_per_m = 0.001;
  const ros::PointCloud cloud = scan_cloud(view, test::Wall());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    float sigma_m = 0;
    std::memcpy(&sigma_m, cloud.data.data() + i * cloud.step + 44, sizeof sigma_m);
    const double range_m = static_cast<double>(samples[i].range_m), far_m = 0.001 * range_m * range_m;
    const double expected_m = static_cast<double>(samples[i].sigma_factor) * std::sqrt(9e-6 + far_m * far_m);
    EXPECT_EQ(std::isnan(sigma_m), samples[i].state != RayState::kHit);
    EXPECT_TRUE(samples[i].state != RayState::kHit || std::abs(static_cast<double>(sigma_m) - expected_m) < 1e-6) << i;
    EXPECT_EQ(cloud.data[i * cloud.step + 41], 3);
  }
}

TEST(ScanCloud, MissedRaysPassAtTheTargetsRange) {
  VERIFIES("LASSO-REC-001~1");
  const std::vector<RangeSample> samples = random_scan(10);
  const ScanView view{samples, 5'000'000, {Quat::Identity(), Vec3(0, 3, 4)}, Twist{}};
  const ros::PointCloud cloud = missed_cloud(view);
  std::size_t misses = 0;
  for (const RangeSample& sample : samples) misses += sample.state == RayState::kMiss ? 1 : 0;
  ASSERT_EQ(cloud.data.size(), misses * cloud.step);
  for (std::size_t i = 0; i < misses; ++i) {
    float point[3];
    std::memcpy(point, cloud.data.data() + i * cloud.step, sizeof point);
    EXPECT_NEAR(Eigen::Vector3f(point).cast<double>().norm(), 5, 1e-5);
  }
}

TEST(ScanCloud, AnotherCloudIsNotTakenForOne) {
  VERIFIES("LASSO-REC-008~2");
  std::vector<RangeSample> samples;
  EXPECT_FALSE(samples_of({{}, 16, std::string(32, '\0')}, 0, samples));
  EXPECT_FALSE(samples_of({{}, 44, std::string(50, '\0')}, 0, samples));
  EXPECT_FALSE(samples_of({{}, 44, std::string(44, '\x09')}, 0, samples));  // no such state
}

}  // namespace
}  // namespace lasso::mdat
