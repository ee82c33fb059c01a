#include "fsw/link/filter_report.hpp"

#include "fsw/link/filter_rows.hpp"

namespace lasso {
namespace {

constexpr auto kFilter = codec_of(filter_rows::kRows);

}  // namespace

std::size_t encode_filter(const FilterTelemetry& filter, const PacketHeader& header, Bytes out) {
  ByteWriter writer(out);
  begin_packet(header, writer);
  writer.u16(kFilterStructureId);
  kFilter.write(filter, writer);
  return finish_packet(writer, out);
}

}  // namespace lasso
