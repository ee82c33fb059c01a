#include "mdat/campaign/case_table.hpp"

#include <charconv>
#include <cmath>
#include <ostream>
#include <sstream>
#include <string_view>

#include "mdat/campaign/figures.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

constexpr char kRemedy[] = "; restore the file, or expand the campaign into a new folder";
constexpr std::size_t kPlainColumns = 2;  // case, seed

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = line.find(',', begin);
    cells.push_back(line.substr(begin, comma - begin));
    if (comma == std::string_view::npos) return cells;
    begin = comma + 1;
  }
}

template <class Number>
bool reads(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

std::string quoted(std::string_view text) { return '"' + std::string(text) + '"'; }

}  // namespace

std::string case_line(std::uint32_t case_number, const CaseValues& values) {
  std::string line = std::to_string(case_number) + "," + std::to_string(values.seed);
  for (const double number : values.numbers) line += "," + cell_text(number);
  return line;
}

void write_cases(const CaseDraws& draws, std::uint32_t cases, std::ostream& out) {
  out << "case,seed";
  for (const std::string& column : draws.columns()) out << ',' << column;
  out << '\n';
  for (std::uint32_t k = 0; k < cases; ++k) out << case_line(k, draws.values(k)) << '\n';
}

CaseTable::CaseTable(std::filesystem::path file) : file_(std::move(file)), in_(file_, std::ios::binary) {
  if (!in_) throw InputError(file_.string() + ": cannot be read; expand the campaign first");
  const bool has_header = read_line();
  const std::vector<std::string_view> cells = cells_of(line_);
  if (!has_header || cells.size() < kPlainColumns || cells[0] != "case" || cells[1] != "seed")
    throw InputError(file_.string() + ":1: expected the header \"case,seed,...\"" + kRemedy);
  for (std::size_t i = kPlainColumns; i < cells.size(); ++i) columns_.emplace_back(cells[i]);
}

// False at the end.
bool CaseTable::read_line() {
  if (!std::getline(in_, line_)) return false;
  if (in_.eof()) refuse("ends in the middle of a line");
  return true;
}

void CaseTable::refuse(const std::string& why) const {
  throw InputError(file_.string() + ":" + std::to_string(case_ + 2) + ": case " + std::to_string(case_) + " " + why + kRemedy);
}

std::optional<CaseValues> CaseTable::next() {
  if (!read_line()) return std::nullopt;
  CaseValues values = parsed();
  ++case_;
  return values;
}

CaseValues CaseTable::at(std::uint32_t case_number) {
  while (case_ < case_number && read_line()) ++case_;
  if (case_ == case_number) {
    if (auto values = next()) return std::move(*values);
  }
  throw InputError(file_.string() + ": has no case " + std::to_string(case_number) + ", and " + std::to_string(case_) + " in all" +
                   kRemedy);
}

CaseValues CaseTable::parsed() const {
  const std::vector<std::string_view> cells = cells_of(line_);
  if (cells.size() != columns_.size() + kPlainColumns)
    refuse("has " + std::to_string(cells.size()) + " cells, expected " + std::to_string(columns_.size() + kPlainColumns));
  std::uint32_t number = 0;
  if (!reads(cells[0], number) || number != case_) refuse("is expected here, not " + quoted(cells[0]));
  CaseValues values{0, std::vector<double>(columns_.size())};
  if (!reads(cells[1], values.seed)) refuse("has the seed " + quoted(cells[1]) + ", expected a whole number");
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (!reads(cells[i + kPlainColumns], values.numbers[i]) || !std::isfinite(values.numbers[i]))
      refuse("has " + quoted(cells[i + kPlainColumns]) + " as its " + columns_[i] + ", expected a number");
  }
  return values;
}

void check_cases(const std::filesystem::path& file, const CaseDraws& draws, std::uint32_t cases) {
  CaseTable table(file);
  const auto refuse = [&](std::uint32_t k, const std::string& why) {
    throw InputError(file.string() + ":" + std::to_string(k + 2) + ": case " + std::to_string(k) + " " + why + kRemedy);
  };
  if (table.columns() != draws.columns()) throw InputError(file.string() + ":1: the columns are not those of the campaign" + kRemedy);
  for (std::uint32_t k = 0; k < cases; ++k) {
    const auto read = table.next();
    if (!read) return refuse(k, "is missing");
    const CaseValues drawn = draws.values(k);
    if (read->seed != drawn.seed) refuse(k, "has the seed " + std::to_string(read->seed) + ", not " + std::to_string(drawn.seed));
    for (std::size_t i = 0; i < drawn.numbers.size(); ++i) {
      if (read->numbers[i] != drawn.numbers[i])
        refuse(k, "has " + cell_text(read->numbers[i]) + " as its " + table.columns()[i] + ", not " + cell_text(drawn.numbers[i]));
    }
  }
  if (table.next()) refuse(cases, "is more than the campaign has");
}

}  // namespace lasso::mdat
