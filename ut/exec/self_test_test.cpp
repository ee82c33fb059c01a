#include "fsw/exec/self_test.hpp"

#include <cfenv>

#include "fsw/link/dictionary.hpp"
#include "ut/exec/mode_story.hpp"

namespace lasso {
namespace {

using M = TrackingMode;
using E = ModeEvent;

TEST(SelfTests, PassOnTheProcessorThatTheComponentIsVerifiedOn) {
  VERIFIES("LASSO-HLT-009~2");
  EXPECT_EQ(failed_self_tests(), 0u);
}

TEST(SelfTests, NameWhatFailed) {
  VERIFIES("LASSO-HLT-009~2");
  const KnownAnswer answers[] = {{SelfTest::kRounding, 1, 1}, {SelfTest::kCrc16, 1, 2}, {SelfTest::kCodec, 5, 4}, {SelfTest::kCodec, 4, 4}};
  EXPECT_EQ(failed_among(Span<const KnownAnswer>(answers)), (1u << 3) | (1u << 5));
}

// The first packet `health` of the stream.
HealthTelemetry health_of(const std::vector<std::uint8_t>& stream) {
  HealthTelemetry health;
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t size = packet_size({stream.data() + at, stream.size() - at});
    PacketHeader header;
    ConstBytes data;
    EXPECT_EQ(parse_packet({stream.data() + at, size}, header, data), PacketFault::kNone);
    at += size;
    if (header.service != kServiceHousekeeping || data[1] != kHealthStructureId) continue;
    ByteReader in(data);
    in.u16();
    codec_of(health_rows::kRows).read(in, health);
    return health;
  }
  ADD_FAILURE() << "no packet health";
  return health;
}

class StartedComponent : public ::testing::Test {
 protected:
  test::ComponentScene scene{test::box_parameters(test::default_scene())};
  test::Story story;
};

// A processor that rounds otherwise than the component was verified with.
TEST_F(StartedComponent, AProcessorThatComputesOtherwiseBeginsInSafe) {
  VERIFIES("LASSO-HLT-009~2 LASSO-HLT-002~1 LASSO-SYS-025~2");
  ASSERT_EQ(scene.load().status, Status::kOk);
  ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
  const Status begun = scene.component->begin(0);
  ASSERT_EQ(std::fesetround(FE_TONEAREST), 0);
  ASSERT_EQ(begun, Status::kOk);
  EXPECT_FALSE(scene.sensor.laser_permitted);
  story.run(scene, 3);
  story.expect({{M::kStandby, E::kMakeSafe, M::kSafe}});
  EXPECT_TRUE(scene.component->faults().active().has(Fault::kSelfTestFailed));
  const HealthTelemetry health = health_of(scene.stream);
  EXPECT_NE(health.failed_tests & 1U, 0U) << "rounding";
  EXPECT_EQ(health.active_faults, 1U << static_cast<unsigned>(Fault::kSelfTestFailed));
}

TEST_F(StartedComponent, AStartWhoseTestsPassSaysSoWithTheLaserInhibited) {
  VERIFIES("LASSO-HLT-009~2");
  scene.begin();
  EXPECT_FALSE(scene.sensor.laser_permitted);
  story.run(scene, 3);
  const HealthTelemetry health = health_of(scene.stream);
  EXPECT_EQ(health.failed_tests, 0U);
  EXPECT_EQ(health.active_faults, 0U);
}

}  // namespace
}  // namespace lasso
