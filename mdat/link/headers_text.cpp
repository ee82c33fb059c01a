#include "mdat/link/headers_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

const char* header_type_name(PacketType type) { return type == PacketType::kCommand ? "command" : "telemetry"; }

const char* name_of(Checksum checksum) { return checksum == Checksum::kRight ? "right" : checksum == Checksum::kWrong ? "wrong" : "none"; }

const char* name_of(SequenceStep step) {
  constexpr const char* kNames[] = {"next", "restart", "late", "repeated", "idle"};
  return kNames[static_cast<std::size_t>(step)];
}

// Where every packet has as many bytes before it, they are the recorder's own header; 0: it is not so.
std::size_t common_prefix(const HeaderList& list) {
  if (list.lines.size() < 2) return 0;
  const std::size_t first = list.lines[0].skipped;
  const auto alike = [&](const HeaderLine& line) { return line.skipped == first; };
  return std::all_of(list.lines.begin(), list.lines.end(), alike) ? first : 0;
}

std::string note_of(const HeaderLine& line, bool prefix) {
  std::string text = line.step == SequenceStep::kNext ? "" : name_of(line.step);
  if (line.missing > 0) text = amount(line.missing, "packet") + " missing before";
  if (line.may_be_restart()) text += format(", or a restart with %u missing", unsigned{line.header.sequence_count});
  if (line.skipped > 0 && !prefix) text += (text.empty() ? "" : ", ") + amount(line.skipped, "byte") + " skipped before";
  return text;
}

struct Totals {
  std::size_t right = 0, wrong = 0, none = 0, gaps = 0, missing = 0, skipped = 0, doubtful = 0;
  std::size_t steps[5] = {};
  std::size_t of(SequenceStep step) const { return steps[static_cast<std::size_t>(step)]; }
};

Totals totals_of(const HeaderList& list) {
  Totals totals;
  for (const HeaderLine& line : list.lines) {
    ++(line.checksum == Checksum::kRight ? totals.right : line.checksum == Checksum::kWrong ? totals.wrong : totals.none);
    ++totals.steps[static_cast<std::size_t>(line.step)];
    totals.gaps += line.missing > 0 ? 1 : 0;
    totals.missing += line.missing;
    totals.doubtful += line.may_be_restart() ? 1U : 0U;
    totals.skipped += line.skipped;
  }
  return totals;
}

}  // namespace

std::string headers_table(const HeaderList& list) {
  std::string text = "  offset  APID type      flags count   bytes CRC    note\n";
  const bool prefix = common_prefix(list) > 0;
  for (const HeaderLine& line : list.lines) {
    text += format("%8zu  %4u %-9s %5u %5u %7zu %-6s %s\n", line.offset, line.header.apid, header_type_name(line.header.type),
                   line.header.sequence_flags, line.header.sequence_count, line.size,
                   line.checksum == Checksum::kWrong ? "WRONG" : name_of(line.checksum), note_of(line, prefix).c_str());
  }
  return text;
}

std::string headers_csv(const HeaderList& list) {
  std::string text = "offset,apid,type,secondary_header,sequence_flags,sequence_count,size,crc,step,missing,skipped\n";
  for (const HeaderLine& line : list.lines) {
    text += format("%zu,%u,%s,%d,%u,%u,%zu,%s,%s,%u,%zu\n", line.offset, line.header.apid, header_type_name(line.header.type),
                   line.header.secondary_header ? 1 : 0, line.header.sequence_flags, line.header.sequence_count, line.size,
                   name_of(line.checksum), name_of(line.step), line.missing, line.skipped);
  }
  return text;
}

std::string headers_json(const HeaderList& list) {
  nlohmann::ordered_json json = {{"left_over_bytes", list.left_over}, {"packets", nlohmann::ordered_json::array()}};
  for (const HeaderLine& line : list.lines) {
    json["packets"].push_back({{"offset", line.offset},
                               {"apid", line.header.apid},
                               {"type", header_type_name(line.header.type)},
                               {"secondary_header", line.header.secondary_header},
                               {"sequence_flags", line.header.sequence_flags},
                               {"sequence_count", line.header.sequence_count},
                               {"size", line.size},
                               {"crc", name_of(line.checksum)},
                               {"step", name_of(line.step)},
                               {"missing", line.missing},
                               {"skipped", line.skipped}});
  }
  return json.dump(1) + "\n";
}

std::string headers_summary(const HeaderList& list) {
  const Totals totals = totals_of(list);
  const std::size_t prefix = common_prefix(list);
  std::string text = amount(list.lines.size(), "packet");
  if (totals.of(SequenceStep::kIdle) > 0) text += format(", %zu of them idle", totals.of(SequenceStep::kIdle));
  text += format(": CRC right in %zu, wrong in %zu", totals.right, totals.wrong);
  if (totals.none > 0) text += format(", none in %zu", totals.none);
  text += "; " + amount(totals.gaps, "gap") + " in the sequence, " + amount(totals.missing, "packet") + " missing; " +
          amount(totals.of(SequenceStep::kRestart), "restart") +
          format(", %zu late, %zu repeated; ", totals.of(SequenceStep::kLate), totals.of(SequenceStep::kRepeated)) +
          amount(totals.skipped, "byte") + " skipped";
  if (prefix > 0) text += format(" (%zu before each packet)", prefix);
  text += format(", %zu left over\n", list.left_over);
  if (totals.doubtful == 0) return text;
  return text + amount(totals.doubtful, "gap") + " may be a restart: the count of 0 is among the packets that are missing\n";
}

}  // namespace lasso::mdat
