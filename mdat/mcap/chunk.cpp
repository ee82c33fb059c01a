#include "mdat/mcap/chunk.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include "mdat/mcap/format.hpp"

namespace lasso::mdat::mcap {
namespace {

constexpr std::uint64_t kLargestChunk = std::uint64_t{1} << 30;  // unpacked: a length that is damaged asks for no memory beyond

bool unpack_lz4(std::string_view body, std::string& records) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0U) return false;
  std::size_t size = records.size(), taken = body.size();
  const std::size_t left = LZ4F_decompress(context, records.data(), &size, body.data(), &taken, nullptr);
  LZ4F_freeDecompressionContext(context);
  return left == 0 && size == records.size() && taken == body.size();
}

bool unpack_zstd(std::string_view body, std::string& records) {
  const std::size_t size = ZSTD_decompress(records.data(), records.size(), body.data(), body.size());
  return ZSTD_isError(size) == 0U && size == records.size();
}

}  // namespace

bool parts_of(std::string_view content, ChunkParts& parts) {
  ByteReader reader(content);
  parts.first_ns = reader.get<std::uint64_t>();
  parts.last_ns = reader.get<std::uint64_t>();
  parts.size = reader.get<std::uint64_t>();
  parts.crc = reader.get<std::uint32_t>();
  parts.compression = reader.text();
  parts.body = reader.take(reader.get<std::uint64_t>());
  return reader.ok() && reader.rest().empty();
}

std::string unpacked(const ChunkParts& parts, std::string& why) {
  std::string records;
  if (parts.size > kLargestChunk) {
    why = "a chunk says that it holds " + std::to_string(parts.size) + " bytes: more than any has";
  } else if (parts.compression.empty()) {
    records = parts.body;
  } else if (parts.compression != "zstd" && parts.compression != "lz4") {
    why = "a chunk is compressed by '" + std::string(parts.compression.substr(0, 20)) + "': zstd, lz4 or none are read here";
  } else {
    records.resize(parts.size);
    if (!(parts.compression == "zstd" ? unpack_zstd : unpack_lz4)(parts.body, records)) why = "a chunk cannot be unpacked";
  }
  if (why.empty() && (records.size() != parts.size || (parts.crc != 0 && crc32_of(records) != parts.crc)))
    why = "a chunk has another checksum than it says";
  return why.empty() ? records : std::string();
}

}  // namespace lasso::mdat::mcap
