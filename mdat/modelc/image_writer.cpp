#include "mdat/modelc/image_writer.hpp"

#include <bit>
#include <cstddef>

#include "cfg/capacities.hpp"
#include "fsw/core/crc.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kTableAlignment = 8;
constexpr std::size_t kTrailerBytes = 4;

std::size_t aligned(std::size_t offset) { return (offset + kTableAlignment - 1) / kTableAlignment * kTableAlignment; }

void put(std::vector<std::uint8_t>& bytes, std::size_t offset, std::uint32_t word) {
  for (std::size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<std::uint8_t>(word >> (24 - 8 * i));
}

std::vector<std::uint32_t> parameter_words(const MissionParameters& parameters) {
  std::vector<std::uint32_t> words;
  for (const ParameterRow& row : parameter_rows()) {
    const auto bits = std::bit_cast<std::uint64_t>(parameters.*row.member);
    words.push_back(static_cast<std::uint32_t>(bits >> 32));
    words.push_back(static_cast<std::uint32_t>(bits));
  }
  return words;
}

std::uint32_t put_table(std::vector<std::uint8_t>& bytes, std::size_t offset, const std::vector<std::uint32_t>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) put(bytes, offset + 4 * i, words[i]);
  return crc32c({bytes.data() + offset, 4 * words.size()});
}

void put_header(std::vector<std::uint8_t>& bytes, std::uint32_t table_count, std::uint32_t mission_id, std::uint32_t mission_version) {
  const std::uint32_t header[] = {kImageMagic, kImageVersion,   static_cast<std::uint32_t>(bytes.size()),           table_count,
                                  mission_id,  mission_version, static_cast<std::uint32_t>(parameter_rows().size())};
  std::size_t offset = 0;
  for (const std::uint32_t word : header) {
    put(bytes, offset, word);
    offset += 4;
  }
}

}  // namespace

std::vector<std::uint8_t> write_image(std::uint32_t mission_id, std::uint32_t mission_version, const MissionParameters& parameters,
                                      const ModelTables& tables) {
  ModelTables all = tables;
  all[TableId::kParameters] = parameter_words(parameters);
  const std::uint32_t table_count = all[TableId::kNamedFrames].empty() ? kLeastTables : kTableCount;
  std::size_t offsets[kTableCount + 1];
  std::size_t end = 4 * (kImageHeaderWords + kDirectoryEntryWords * table_count);
  for (std::uint32_t id = 1; id <= table_count; ++id) {
    offsets[id] = aligned(end);
    end = offsets[id] + 4 * all.words[id].size();
  }
  if (end + kTrailerBytes > kMaxImageBytes) {
    fail("the flight image needs ", end + kTrailerBytes, " bytes; the limit is ", kMaxImageBytes);
  }
  std::vector<std::uint8_t> bytes(end + kTrailerBytes, 0);
  put_header(bytes, table_count, mission_id, mission_version);
  for (std::uint32_t id = 1; id <= table_count; ++id) {
    const std::uint32_t record = words_per_record(static_cast<TableId>(id));
    const std::uint32_t crc = put_table(bytes, offsets[id], all.words[id]);
    const std::uint32_t entry[] = {id, record, static_cast<std::uint32_t>(all.words[id].size()) / record,
                                   static_cast<std::uint32_t>(offsets[id]), crc};
    std::size_t offset = 4 * (kImageHeaderWords + kDirectoryEntryWords * (id - 1));
    for (const std::uint32_t word : entry) {
      put(bytes, offset, word);
      offset += 4;
    }
  }
  put(bytes, end, crc32c({bytes.data(), end}));
  return bytes;
}

}  // namespace lasso::mdat
