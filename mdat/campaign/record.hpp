// The text of a chunk file: a heading that names the plan, then a line a finished case, with a checksum each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lasso::mdat {

struct CaseRecord {
  std::uint32_t number = 0;  // of the case
  std::string_view fields;   // "ok,1,2,3" or "failed:REASON"
  std::size_t line = 0;      // of the file, from 1
};

// "CRC,NUMBER,FIELDS\n": the CRC-32C, as eight hexadecimal digits, is that of all after its comma. Control characters become spaces.
std::string record_line(std::uint32_t number, std::string_view fields);

// Of a line without its end; nothing if it is not what record_line() writes, to the letter.
std::optional<CaseRecord> parse_record(std::string_view line);

// "failed:REASON", in one cell of one line.
std::string failed_fields(std::string_view reason);
bool is_failed(std::string_view fields);

// The first line, with its end.
std::string chunk_heading(const std::string& plan_digest);

struct ChunkText {
  std::vector<CaseRecord> records;  // they look into the text
  struct Line {
    std::size_t number;
    std::string_view text;
  };
  std::vector<Line> damaged;
  std::string_view torn;  // what follows the last whole line: its writer was killed. In a .done file it is damaged
};

// Throws InputError, which names the file, where the heading is that of another plan, or none.
ChunkText parse_chunk(const std::string& file, std::string_view text, const std::string& plan_digest);

}  // namespace lasso::mdat
