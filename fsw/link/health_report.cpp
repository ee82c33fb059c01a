#include "fsw/link/health_report.hpp"

#include "fsw/link/health_rows.hpp"

namespace lasso {
namespace {

constexpr auto kHealth = codec_of(health_rows::kRows);

}  // namespace

std::size_t encode_health(const HealthTelemetry& health, const PacketHeader& header, Bytes out) {
  ByteWriter writer(out);
  begin_packet(header, writer);
  writer.u16(kHealthStructureId);
  kHealth.write(health, writer);
  return finish_packet(writer, out);
}

}  // namespace lasso
