#include "fsw/link/sensor_telemetry.hpp"

#include "fsw/link/sensor_rows.hpp"

namespace lasso {
namespace {

constexpr auto kCodec = codec_of(sensor_report_rows::kRows);

}  // namespace

std::size_t encode_sensor(const SensorTelemetry& sensor, PacketHeader header, Bytes out) {
  header.service = kServiceHousekeeping;
  header.subservice = kSubserviceHousekeepingReport;
  ByteWriter writer(out);
  begin_packet(header, writer);
  writer.u16(kSensorStructureId);
  kCodec.write(sensor, writer);
  return finish_packet(writer, out);
}

}  // namespace lasso
