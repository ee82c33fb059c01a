#include "fsw/link/memory_report.hpp"

#include "fsw/link/housekeeping.hpp"
#include "fsw/link/memory_rows.hpp"

namespace lasso {
namespace {

constexpr auto kCodec = codec_of(memory_rows::kImage);

}  // namespace

std::size_t encode_image(const ImageTelemetry& image, PacketHeader header, Bytes out) {
  header.service = kServiceHousekeeping;
  header.subservice = kSubserviceHousekeepingReport;
  ByteWriter writer(out);
  begin_packet(header, writer);
  writer.u16(kImageStructureId);
  kCodec.write(image, writer);
  return finish_packet(writer, out);
}

}  // namespace lasso
