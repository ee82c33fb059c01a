#include "mdat/campaign/record.hpp"

#include <algorithm>
#include <charconv>

#include "fsw/core/crc.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr std::string_view kHeading = "# 3dlasso campaign chunk, plan ";
constexpr std::string_view kFailed = "failed:";
constexpr std::size_t kSumDigits = 8, kDigestShown = 12;

bool is_control(char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7F; }

std::string on_one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(line.begin(), line.end(), is_control, ' ');
  return line;
}

std::uint32_t sum_of(std::string_view text) { return crc32c({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}); }

void check_heading(const std::string& file, std::string_view line, const std::string& plan_digest) {
  if (line.substr(0, kHeading.size()) != kHeading)
    throw InputError(file + ":1: is not the first line of a campaign's chunk; move the file away: its cases are flown again");
  line.remove_prefix(kHeading.size());
  if (line == plan_digest) return;
  throw InputError(file + ": is of another plan (" + std::string(line.substr(0, kDigestShown)) + "..., this folder's is " +
                   plan_digest.substr(0, kDigestShown) + "...); move it into a folder with its plan.json, or away");
}

}  // namespace

std::string record_line(std::uint32_t number, std::string_view fields) {
  const std::string text = std::to_string(number) + "," + on_one_line(fields);
  return format("%08x,", sum_of(text)) + text + "\n";
}

std::optional<CaseRecord> parse_record(std::string_view line) {
  CaseRecord record;
  if (line.size() <= kSumDigits) return std::nullopt;
  const char* const end = line.data() + line.size();
  const auto [stop, error] = std::from_chars(line.data() + kSumDigits + 1, end, record.number);
  if (error != std::errc{} || stop == end) return std::nullopt;
  record.fields = line.substr(static_cast<std::size_t>(stop + 1 - line.data()));
  const std::string written = record_line(record.number, record.fields);
  if (line != std::string_view(written).substr(0, written.size() - 1)) return std::nullopt;
  return record;
}

std::string failed_fields(std::string_view reason) {
  std::string fields(kFailed);
  fields += on_one_line(reason);
  std::replace(fields.begin(), fields.end(), ',', ';');
  std::replace(fields.begin(), fields.end(), '"', '\'');
  return fields;
}

bool is_failed(std::string_view fields) { return fields.substr(0, kFailed.size()) == kFailed; }

std::string chunk_heading(const std::string& plan_digest) { return std::string(kHeading) + plan_digest + "\n"; }

ChunkText parse_chunk(const std::string& file, std::string_view text, const std::string& plan_digest) {
  ChunkText chunk;
  std::size_t number = 1;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n'), ++number) {
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (number == 1) {
      check_heading(file, line, plan_digest);
    } else if (std::optional<CaseRecord> record = parse_record(line)) {
      record->line = number;
      chunk.records.push_back(*record);
    } else {
      chunk.damaged.push_back({number, line});
    }
  }
  if (number == 1 && chunk_heading(plan_digest).compare(0, text.size(), text) != 0) check_heading(file, text, plan_digest);
  if (number > 1 && !text.empty() && file.ends_with(".done")) {
    chunk.damaged.push_back({number, text});
  } else {
    chunk.torn = text;
  }
  return chunk;
}

}  // namespace lasso::mdat
