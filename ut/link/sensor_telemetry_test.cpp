#include "fsw/link/sensor_telemetry.hpp"

#include "fsw/link/dictionary.hpp"
#include "ut/link/command_packets.hpp"

namespace lasso {
namespace {

using test::Stream;

SensorTelemetry numbered() {
  SensorTelemetry report;
  Stream bytes(codec_of(sensor_report_rows::kRows).bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i + 1);
  ByteReader in(test::view(bytes));
  codec_of(sensor_report_rows::kRows).read(in, report);
  return report;
}

TEST(SensorTelemetry, IsAStructureOfItsOwn) {
  VERIFIES("LASSO-LCS-012~1");
  const SensorTelemetry report = numbered();
  EXPECT_EQ(report.sensor, 1);
  EXPECT_EQ(report.scans, 0x02030405u);
  EXPECT_EQ(report.last_loss, 10);
  EXPECT_EQ(report.samples_outside, 0x6F707172u);
  EXPECT_EQ(report.calibration, 0x73) << "the last of 31 items";
  Stream packet(kMaxSensorPacketBytes);
  packet.resize(encode_sensor(report, PacketHeader{}, Bytes(packet.data(), packet.size())));
  EXPECT_EQ(packet[7], kServiceHousekeeping);
  EXPECT_EQ(packet[8], kSubserviceHousekeepingReport);
  PacketHeader header;
  ConstBytes data;
  ASSERT_EQ(parse_packet(test::view(packet), header, data), PacketFault::kNone);
  ASSERT_EQ(data.size(), 2u + 3 * 1 + 29 * 4);
  EXPECT_EQ(data[0], 0);
  EXPECT_EQ(data[1], 3);
  for (std::size_t i = 2; i < data.size(); ++i) ASSERT_EQ(data[i], i - 1) << i;
}

TEST(SensorTelemetry, DoesNotFitIntoLess) {
  Stream packet(100);
  EXPECT_EQ(encode_sensor(numbered(), PacketHeader{}, Bytes(packet.data(), packet.size())), 0u);
}

}  // namespace
}  // namespace lasso
