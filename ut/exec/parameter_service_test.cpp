// Service 20 by the link alone.
#include <cstring>
#include <string>

#include "ut/exec/component_operator.hpp"
#include "ut/support/parameter_row.hpp"

namespace lasso {
namespace {

using test::id_of;
using test::Link;
using test::Packet;
using test::refusal_of;
using test::told;

ParameterTelemetry parameter_of(const std::vector<Packet>& packets) {
  ParameterTelemetry parameter;
  for (const Packet& packet : packets) {
    if (!packet.is(20, 2)) continue;
    ByteReader in(test::view(packet.data));
    codec_of(link_report_rows::kParameter).read(in, parameter);
  }
  return parameter;
}

std::string modes(Link& link, int frames) {
  std::string modes;
  for (int i = 0; i < frames; ++i) modes += std::to_string(link.pose_of(link.run_frame()).mode);
  return modes;
}

TEST(ParameterService, AreReportedSetAndReverted) {
  VERIFIES("LASSO-IMG-018~1 LASSO-LNK-022~2");
  Link link;
  const std::uint16_t id = id_of("tracking.inlier_share_min");
  link.send(test::report_parameter(id, 0));
  ParameterTelemetry parameter = parameter_of(link.answers());
  EXPECT_EQ(parameter.parameter, id);
  EXPECT_EQ(parameter.value, link.component().mission().parameters.inlier_share_min);
  EXPECT_EQ(parameter.value, parameter.image_value);
  EXPECT_EQ(parameter.changed, 0);
  const double before = parameter.value;
  link.send(test::set_parameter(id, 0.75, 1));
  EXPECT_EQ(refusal_of(link.answers()), 0);
  EXPECT_EQ(link.component().mission().parameters.inlier_share_min, before) << "from the next boundary on";
  link.send(test::report_parameter(id, 2));
  parameter = parameter_of(link.answers());
  EXPECT_EQ(parameter.value, 0.75);
  EXPECT_EQ(parameter.image_value, before);
  EXPECT_EQ(parameter.changed, 1);
  EXPECT_TRUE(told(link.run_frame(), EventId::kParameterChanged));
  EXPECT_EQ(link.component().mission().parameters.inlier_share_min, 0.75);
  link.send(test::plain_packet(CommandKind::kRevertParameters, 3));
  EXPECT_EQ(link.component().mission().parameters.inlier_share_min, 0.75);
  EXPECT_TRUE(told(link.run_frame(), EventId::kParametersReverted));
  EXPECT_EQ(link.component().mission().parameters.inlier_share_min, before);
}

// By what it does: with fewer frames to coast a track that sees nothing is lost earlier.
TEST(ParameterService, AChangeActsAtTheNextBoundary) {
  VERIFIES("LASSO-LNK-022~2 LASSO-IMG-018~1");
  Link as_loaded, changed;
  changed.send(test::set_parameter(id_of("tracking.coast_frames"), 2, 0));
  for (Link* link : {&as_loaded, &changed}) {
    for (int frame = 0; frame < 8; ++frame) link->run_frame();
    link->scene.sensor.hidden = true;
  }
  const std::string long_story = modes(as_loaded, 8), short_story = modes(changed, 8);
  EXPECT_EQ(long_story.find('4'), std::string::npos) << long_story;
  EXPECT_NE(short_story.find("334"), std::string::npos) << short_story;
}

TEST(ParameterService, WhatIsRefusedSaysWhyAndChangesNothing) {
  VERIFIES("LASSO-IMG-018~1 LASSO-LNK-013~2 LASSO-SYS-011~2");
  Link link;
  const MissionParameters before = link.component().mission().parameters;
  const struct {
    std::uint16_t id;
    double value;
    ServiceRefusal refusal;
  } cases[] = {{kNextParameterId, 1, ServiceRefusal::kNoSuchParameter},
               {id_of("filter.period_s"), 0.2, ServiceRefusal::kFixedParameter},
               {id_of("tracking.coast_frames"), -1, ServiceRefusal::kOutOfLimits},
               {id_of("short_range.enter_m"), 5, ServiceRefusal::kInconsistent}};
  std::uint16_t count = 0;
  for (const auto& each : cases) {
    link.send(test::set_parameter(each.id, each.value, count++));
    EXPECT_EQ(refusal_of(link.answers()), static_cast<std::uint8_t>(each.refusal)) << each.id;
  }
  link.send(test::report_parameter(kNextParameterId, count++));
  EXPECT_EQ(refusal_of(link.answers()), static_cast<std::uint8_t>(ServiceRefusal::kNoSuchParameter));
  link.run_frame();
  const MissionParameters& after = link.component().mission().parameters;
  for (const ParameterRow& row : parameter_rows()) EXPECT_EQ(after.*row.member, before.*row.member) << row.key;
}

// Where a value stands in the component's memory: before it acts, in the two copies alone.
std::vector<std::uint8_t*> places_of(Component& component, double value) {
  std::vector<std::uint8_t*> places;
  auto* bytes = reinterpret_cast<std::uint8_t*>(&component);
  for (std::size_t at = 0; at + sizeof value <= sizeof component; at += 4) {
    if (std::memcmp(bytes + at, &value, sizeof value) == 0) places.push_back(bytes + at);
  }
  return places;
}

TEST(ParameterService, AFlippedCopyIsRepairedAndTwoAreTold) {
  VERIFIES("LASSO-IMG-018~1");
  Link link;
  const std::uint16_t id = id_of("tracking.inlier_share_min");
  const double before = link.component().mission().parameters.inlier_share_min;
  link.send(test::set_parameter(id, 0.73125, 0));
  const std::vector<std::uint8_t*> places = places_of(link.component(), 0.73125);
  ASSERT_EQ(places.size(), 2u);
  *places[0] ^= 4U;
  EXPECT_TRUE(told(link.run_frame(), EventId::kParametersRepaired));
  EXPECT_EQ(link.component().mission().parameters.inlier_share_min, 0.73125);
  EXPECT_TRUE(link.component().faults().active().has(Fault::kParametersCorrupt));
  *places[0] ^= 4U;
  link.send(test::set_parameter(id_of("tracking.coast_frames"), 7, 1));
  link.run_frame();
  EXPECT_EQ(link.component().mission().parameters.inlier_share_min, 0.73125) << "a wrong copy is not made right by what is set next";
  *places[0] ^= 4U;
  *places[1] ^= 8U;
  EXPECT_TRUE(told(link.run_frame(), EventId::kParametersLost));
  link.run_frame();
  EXPECT_EQ(link.component().mission().parameters.inlier_share_min, before) << "the image's";
  EXPECT_TRUE(link.component().faults().ever().has(Fault::kParametersLost));
}

TEST(ParameterService, AChangeWaitsForALateEstimate) {
  VERIFIES("LASSO-EXE-003~1 LASSO-LNK-022~2");
  Link link;
  Component& component = link.component();
  for (int frame = 0; frame < 3; ++frame) link.run_frame();
  const double before = component.mission().parameters.coast_frames;
  link.send(test::set_parameter(id_of("tracking.coast_frames"), 77, 0));
  component.run_slot(component.next_slot_us());  // the boundary: applied, as nothing runs
  EXPECT_EQ(component.mission().parameters.coast_frames, 77);
  link.send(test::set_parameter(id_of("tracking.coast_frames"), 78, 1));
  do {
    component.run_slot(component.next_slot_us());  // nobody estimates
  } while (!component.next_slot_is_boundary());
  component.run_slot(component.next_slot_us());
  EXPECT_EQ(component.mission().parameters.coast_frames, 77) << "the estimate that was handed over is not done";
  link.run_frame();
  link.run_frame();
  EXPECT_EQ(component.mission().parameters.coast_frames, 78);
  EXPECT_NE(before, 77);
}

}  // namespace
}  // namespace lasso
