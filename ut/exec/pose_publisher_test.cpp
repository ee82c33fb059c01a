// Poses as the ground gets them, by the link alone.
#include <algorithm>
#include <cmath>

#include "ut/exec/component_operator.hpp"
#include "ut/support/box_frames.hpp"

namespace lasso {
namespace {

using test::events_of;
using test::Link;
using test::Packet;
using test::Stream;
using test::told;

std::size_t poses(const std::vector<Packet>& packets) {
  return static_cast<std::size_t>(std::count_if(
      packets.begin(), packets.end(), [](const Packet& packet) { return packet.is(3, 25) && packet.data[1] == kPoseStructureId; }));
}

// Of each pair in the image, and of the same scan as the packet pose; none without.
TEST(PosePublisher, PosesBetweenNamedFramesAreSentWhereTheImageNamesThem) {
  VERIFIES("LASSO-LNK-050~1 LASSO-LNK-051~1 LASSO-SYS-024~1");
  const test::BoxScene truth = test::default_scene();
  const NamedFrame docking = test::grapple_in_port();
  const test::BoxTables tables = test::make_box_tables(truth.boxes());
  const auto image = [&](const std::vector<NamedFrame>& frames) {
    return test::make_image(test::box_parameters(truth), test::with_frames(tables, frames));
  };
  test::ComponentScene without(truth, image({}));
  without.begin();
  test::ComponentScene scene(truth, image({NamedFrame{}, docking}));
  scene.begin();
  const auto named = [](test::ComponentScene& of) {
    std::vector<NamedPoseTelemetry> poses;
    for (const Packet& packet : test::packets_of(test::run_frame(*of.component))) {
      if (!packet.is(3, 25) || packet.data[1] != kNamedPoseStructureId) continue;
      ByteReader in(test::view(packet.data));
      in.u16();
      codec_of(named_pose_rows::kRows).read(in, poses.emplace_back());
    }
    return poses;
  };
  std::size_t told = 0;
  for (int frame = 0; frame < 8; ++frame) {
    EXPECT_TRUE(named(without).empty());
    const auto poses = named(scene);
    if (poses.empty()) continue;
    ASSERT_EQ(poses.size(), 2U);
    EXPECT_EQ(poses[0].pair, 1);
    EXPECT_EQ(poses[1].pair, 2);
    EXPECT_EQ(poses[1].pairs, 2);
    EXPECT_EQ(poses[1].valid, 1);
    EXPECT_EQ(poses[1].started, 1);
    const Pose T_in_of = docking.T_in_sensor * truth.pose_at(poses[1].t_measurement_us) * docking.T_target_of;
    EXPECT_LT((Vec3(poses[1].p_in_of_m) - T_in_of.p).norm(), 3e-3);
    EXPECT_LT((Vec3(poses[1].filter_p_in_of_m) - T_in_of.p).norm(), 3e-3);
    EXPECT_LT((Vec3(poses[0].p_in_of_m) - truth.pose_at(poses[0].t_measurement_us).p).norm(), 3e-3);
    ++told;
  }
  EXPECT_GE(told, 5U);
  const auto send = [&](CommandKind kind, std::uint16_t count) {
    const Stream bytes = test::of_structure(kind, kNamedPoseStructureId, count);
    scene.component->receive(test::view(bytes), scene.component->next_slot_us());
  };
  auto* const image_bytes = const_cast<std::uint8_t*>(scene.component->images().active().sealed_image().data());
  test::TestImage as_sent = image({NamedFrame{}, docking});
  std::uint8_t* const decayed = image_bytes + test::table_offset(as_sent, static_cast<std::uint32_t>(TableId::kNamedFrames));
  std::uint8_t before[8];  // of the first quaternion's x
  std::copy_n(decayed, 8, before);
  std::fill_n(decayed, 8, std::uint8_t{0x7F});
  ASSERT_EQ(named(scene).size(), 1U) << "what has decayed is not reported";
  std::copy_n(before, 8, decayed);
  send(CommandKind::kDisableStructure, 0);
  EXPECT_TRUE(named(scene).empty());
  send(CommandKind::kReportStructure, 1);
  EXPECT_EQ(named(scene).size(), 2U);
}

// The estimate was done when the clock jumped: its pose, of the old clock's time, is none of the frame's.
TEST(PosePublisher, AnEstimateOfBeforeAJumpIsNotReported) {
  VERIFIES("LASSO-LNK-050~1 LASSO-HLT-006~2");
  const test::BoxScene truth = test::default_scene();
  test::ComponentScene scene(
      truth, test::make_image(test::box_parameters(truth), test::with_frames(test::make_box_tables(truth.boxes()), {NamedFrame{}})));
  scene.begin();
  Component& component = *scene.component;
  for (int frame = 0; frame < 8; ++frame) test::run_frame(component);
  component.run_slot(component.next_slot_us());
  component.run_estimation();
  const Stream ask = test::of_structure(CommandKind::kReportStructure, kNamedPoseStructureId, 0);
  component.receive(test::view(ask), component.next_slot_us());
  component.run_slot(component.next_slot_us() + 60'000'000);
  test::run_frame(component);
  component.run_slot(component.next_slot_us());
  std::vector<NamedPoseTelemetry> poses;
  for (const Packet& packet : test::packets_of(test::telemetry_of(component))) {
    if (!packet.is(3, 25) || packet.data[1] != kNamedPoseStructureId) continue;
    ByteReader in(test::view(packet.data));
    in.u16();
    codec_of(named_pose_rows::kRows).read(in, poses.emplace_back());
  }
  ASSERT_EQ(poses.size(), 1U) << "it was asked for";
  EXPECT_EQ(poses[0].valid, 0);
  EXPECT_EQ(poses[0].t_measurement_us, 0) << "no scan's";
}

// What is reported of its diagonal is what the packet pose of the same frame states as sigmas.
TEST(PosePublisher, TheFiltersCovarianceIsSentOnRequest) {
  VERIFIES("LASSO-LNK-039~1");
  Link link;
  std::vector<Packet> frame;
  const auto filters = [&] {
    frame = link.run_frame();
    std::vector<FilterTelemetry> reports;
    for (const Packet& packet : frame) {
      if (!packet.is(3, 25) || packet.data[1] != kFilterStructureId) continue;
      ByteReader in(test::view(packet.data));
      in.u16();
      codec_of(filter_rows::kRows).read(in, reports.emplace_back());
    }
    return reports;
  };
  link.send(test::of_structure(CommandKind::kReportStructure, kFilterStructureId, 0));
  const auto early = filters();
  ASSERT_EQ(early.size(), 1u) << "before any scan, too";
  EXPECT_EQ(early[0].accepted, 0u);
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(filters().empty());
  link.send(test::of_structure(CommandKind::kEnableStructure, kFilterStructureId, 1));
  for (int i = 0; i < 3; ++i) {
    const auto reports = filters();
    ASSERT_EQ(reports.size(), 1u);
    const PoseTelemetry pose = link.pose_of(frame);
    EXPECT_EQ(reports[0].scan_id, pose.scan_id);
    EXPECT_EQ(reports[0].t_us, pose.t_measurement_us);
    EXPECT_EQ(reports[0].started, 1);
    std::size_t term = 0;
    for (std::size_t row = 0; row < 12; term += 12 - row, ++row) {
      const float sigma = row < 6 ? pose.filter_sigma_pose[row] : pose.filter_sigma_rates[row - 6];
      EXPECT_NEAR(std::sqrt(reports[0].covariance[term]), sigma, 1e-6F * sigma) << row;
    }
  }
}

TEST(PosePublisher, APoseIsReportedInStandbyWhenAskedFor) {
  VERIFIES("LASSO-LNK-014~1");
  Link link;
  link.send(test::set_mode(static_cast<std::uint8_t>(TrackingMode::kStandby), 0));
  link.send(test::of_structure(CommandKind::kReportStructure, kPoseStructureId, 1));
  EXPECT_EQ(poses(link.run_frame()), 1u) << "before any scan";
  for (int frame = 0; frame < 3; ++frame) link.run_frame();
  EXPECT_EQ(poses(link.run_frame()), 0u);
  link.send(test::of_structure(CommandKind::kReportStructure, kPoseStructureId, 2));
  const std::vector<Packet> frame = link.run_frame();
  ASSERT_EQ(poses(frame), 1u);
  EXPECT_EQ(link.pose_of(frame).scan_id, 3u) << "the number of the scan that would be due";
}

TEST(PosePublisher, PosesThatAreNotSentCountAndTheirChangesAreEvents) {
  VERIFIES("LASSO-LNK-014~1 LASSO-MOD-172~2");
  Link link;
  link.send(test::of_structure(CommandKind::kDisableStructure, kPoseStructureId, 0));
  std::size_t changes = 0;
  std::uint16_t count = 1;
  for (int frame = 0; frame < 40; ++frame) {  // more changes than a packet could hold
    const TrackingMode mode = frame % 2 == 0 ? TrackingMode::kBearing : TrackingMode::kStandby;
    link.send(test::set_mode(static_cast<std::uint8_t>(mode), count++));
    const std::vector<Packet> packets = link.run_frame();
    EXPECT_EQ(poses(packets), 0u);
    for (const Stream& event : events_of(packets)) changes += event[1] == 2 ? 1U : 0U;
  }
  EXPECT_GE(changes, 39u);
}

}  // namespace
}  // namespace lasso
