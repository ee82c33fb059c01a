#include "fsw/link/health_report.hpp"

#include "ut/link/command_packets.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::Stream;

TEST(HealthReport, LiesOnTheWireAsItsRowsSay) {
  VERIFIES("LASSO-HLT-001~1 LASSO-LNK-002~1");
  HealthTelemetry health;
  health.active_faults = 0x01020304;
  health.past_faults = 0x11223344;
  health.confirmations = 7;
  health.reset_cause = 2;
  health.failed_tests = 0x15;
  health.unfed_frames = 0x0A0B;
  health.mode_repairs = 3;
  health.clock_jumps = 4;
  health.worst_lateness_us = -2;
  Stream packet(kMaxHealthBytes);
  packet.resize(encode_health(health, PacketHeader{}, Bytes(packet.data(), packet.size())));
  const Stream data(packet.begin() + kPacketHeaderBytes, packet.end() - kPacketTrailerBytes);
  EXPECT_EQ(data, (Stream{0,    4,    1, 2, 3, 4, 0x11, 0x22, 0x33, 0x44, 0,   0,   0,   7,   2,   0x15, 0,   0,
                          0x0A, 0x0B, 0, 0, 0, 3, 0,    0,    0,    4,    255, 255, 255, 255, 255, 255,  255, 254}));
  EXPECT_EQ(encode_health(health, PacketHeader{}, Bytes(packet.data(), 57)), 0u);
}

}  // namespace
}  // namespace lasso
