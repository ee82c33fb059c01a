#include "mdat/recording/bag_scans.hpp"

#include <sqlite3.h>

#include <functional>

#include "mdat/common/errors.hpp"
#include "mdat/mcap/cdr.hpp"
#include "ut/mdat/recording/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using BagScans = SmallRecording;

void put_big(float value, std::string& bytes) {
  std::string little;
  mcap::put(value, little);
  bytes.append(little.rbegin(), little.rend());
}

// Two rows of two points, big-endian, with three bytes behind each point and five behind each row, as a driver may have them. Each point's
// time [ns] after the stamp goes down.
std::string foreign_message(const char* time_field, std::int32_t seconds = 1'700'000'000) {
  mcap::CdrWriter out;
  out.put(seconds).put(std::uint32_t{500'000'000}).text("lidar");
  out.put(std::uint32_t{2}).put(std::uint32_t{2}).put(std::uint32_t{4});
  std::uint32_t offset = 0;
  for (const char* name : {"x", "y", "z"}) {
    out.text(name).put(offset).put(std::uint8_t{7}).put(std::uint32_t{1});
    offset += 4;
  }
  out.text(time_field).put(offset).put(std::uint8_t{6}).put(std::uint32_t{1});
  out.put(std::uint8_t{1}).put(std::uint32_t{19}).put(std::uint32_t{43});
  std::string data;
  for (int i = 0; i < 4; ++i) {
    for (const float value : {1.0F * static_cast<float>(i), 2.0F, 5.0F}) put_big(value, data);
    data += std::string("\0", 1) + static_cast<char>(4 - i) + std::string(2, '\0');  // (4 - i) << 16 ns
    data += std::string(i % 2 == 0 ? 3 : 8, 'p');
  }
  out.blob(data).put(std::uint8_t{0});
  return out.bytes();
}

std::filesystem::path write_bag(const std::filesystem::path& place, const std::string& message, const std::string& encoding = "cdr") {
  mcap::Writer writer(place, "ros2", "another program");
  const RosSchema cloud = ros::point_cloud(), log = ros::log();
  const auto points = writer.add_channel("/points", writer.add_schema(cloud.name, "ros2msg", cloud.text), encoding);
  writer.write(writer.add_channel("/rosout", writer.add_schema(log.name, "ros2msg", log.text), "cdr"), 1, "");
  writer.write(points, 2, message);
  writer.write(points, 3, message);
  writer.close();
  return place;
}

void write_database(const std::filesystem::path& place, const std::string& message) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(place.c_str(), &database), SQLITE_OK);
  const char* const tables =
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT, offered_qos_profiles TEXT);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);"
      "INSERT INTO topics VALUES(4, '/points', 'sensor_msgs/msg/PointCloud2', 'cdr', ''), (5, '/rosout', 'rcl_interfaces/msg/Log', 'cdr', "
      "'');";
  EXPECT_EQ(sqlite3_exec(database, tables, nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_stmt* insert = nullptr;
  sqlite3_prepare_v2(database, "INSERT INTO messages VALUES(1, 4, 7, ?)", -1, &insert, nullptr);
  sqlite3_bind_blob(insert, 1, message.data(), static_cast<int>(message.size()), SQLITE_STATIC);
  EXPECT_EQ(sqlite3_step(insert), SQLITE_DONE);
  sqlite3_finalize(insert);
  sqlite3_close(database);
}

void expect_foreign_scan(const sim::RawScan& scan) {
  ASSERT_EQ(scan.rays.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {  // by their times: from the last point on
    EXPECT_EQ(scan.rays[i].place, Vec3(3 - static_cast<double>(i), 2, 5));
    EXPECT_NEAR(scan.rays[i].time - 1.7e9, 0.5 + 65536e-9 * static_cast<double>(i + 1), 1e-6);
  }
  EXPECT_TRUE(scan.has_times);
  EXPECT_FALSE(scan.misses_known);
}

TEST_F(BagScans, CloudsOfOtherProgramsAreScansInOrderOfTheirTimes) {
  VERIFIES("LASSO-REC-017~1");
  const auto scans = open_bag(write_bag(file("bag.mcap"), foreign_message("t")), "");
  ASSERT_EQ(scans->size(), 2U);
  expect_foreign_scan(scans->read(1));
  expect_foreign_scan(scans->read(0));
}

TEST_F(BagScans, DatabasesAreReadAsMcapFilesAre) {
  VERIFIES("LASSO-REC-017~1");
  write_database(file("bag.db3"), foreign_message("offset_time"));
  const auto scans = open_bag(file("bag.db3"), "/points");
  ASSERT_EQ(scans->size(), 1U);
  expect_foreign_scan(scans->read(0));
}

TEST_F(BagScans, AFieldThatIsNoTimeLeavesTheStamp) {
  VERIFIES("LASSO-REC-017~1");
  const sim::RawScan scan = open_bag(write_bag(file("bag.mcap"), foreign_message("intensity")), "")->read(0);
  for (const sim::RawRay& ray : scan.rays) EXPECT_NEAR(ray.time - 1.7e9, 0.5, 1e-6);
  const sim::RawScan early = open_bag(write_bag(file("early.mcap"), foreign_message("intensity", -6)), "")->read(0);
  for (const sim::RawRay& ray : early.rays) EXPECT_NEAR(ray.time, -5.5, 1e-9);
}

// What has no place and is said to be a miss of mdat's own recordings is one; the third point of each.
TEST_F(BagScans, RecordingsOfRunsAreScansToo) {
  VERIFIES("LASSO-REC-017~1");
  const auto scans = open_bag(write("run.mcap"), "");
  ASSERT_EQ(scans->size(), 6U);
  EXPECT_EQ(scans->place(3).stem(), "scan00003");
  EXPECT_EQ(scans->read(3).rays.size(), 3U);
  EXPECT_EQ(scans->read(3).unmeasured, 1U);
}

TEST_F(BagScans, WhatCannotBeReadIsRefusedByName) {
  VERIFIES("LASSO-REC-018~1");
  const auto error_of = [&](const std::string& name, const std::string& topic) {
    try {
      (void)open_bag(file(name), topic)->read(0);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const auto expect = [](const std::string& error, const char* part) { EXPECT_NE(error.find(part), std::string::npos) << error; };
  (void)write_bag(file("good.mcap"), foreign_message("t"));
  expect(error_of("good.mcap", "/lidar"), "good.mcap: no topic /lidar: there are /points (sensor_msgs/msg/PointCloud2), /rosout");
  expect(error_of("good.mcap", "/rosout"), "/rosout is no topic of scans");
  (void)write_bag(file("other.mcap"), foreign_message("t"), "ros1");
  expect(error_of("other.mcap", ""), "other.mcap: /points: its messages are 'ros1/ros2msg': expected those of ROS 2");
  (void)write_bag(file("short.mcap"), foreign_message("t").substr(0, 200));
  expect(error_of("short.mcap", ""), "short.mcap: /points, message 0: is not as its schema says: field data ends beyond the message");
  put(file("text.db3"), "no database at all, whatever its name says");
  expect(error_of("text.db3", ""), "text.db3: ");
  expect(error_of("text.db3", ""), "expected a bag of ROS 2 (.db3)");
  expect(error_of("none.mcap.zstd", ""), "none.mcap.zstd: is compressed as a whole: zstd -d unpacks it");
  std::filesystem::create_directories(file("bag"));
  put(file("bag/metadata.yaml"), "");
  EXPECT_TRUE(is_bag(file("bag")));
  expect(error_of("bag", ""), "bag: a bag with 0 files of messages");
}

}  // namespace
}  // namespace lasso::mdat
