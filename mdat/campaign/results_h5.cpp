#include "mdat/campaign/results_h5.hpp"

#include <algorithm>
#include <map>

#include "mdat/common/hdf5_file.hpp"

namespace lasso::mdat {
namespace {

void put_column(hid_t group, const std::string& name, hid_t stored, hid_t given, std::size_t count, const void* values) {
  const H5Object column = h5_column(group, name, stored, given, count, values);
  const std::string unit = unit_of(name);
  if (!unit.empty()) put_attribute(column, "unit", unit);
}

void put_numbers(hid_t file, const char* name, const std::vector<std::string>& columns, const ResultTable& table,
                 std::vector<double> CaseRow::*values) {
  const H5Object group = h5_group(file, name);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    std::vector<double> column;
    for (const CaseRow& row : table.rows) column.push_back((row.*values)[i]);
    put_column(group, columns[i], H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, column.size(), column.data());
  }
}

void put_cases(hid_t file, const ResultTable& table) {
  std::vector<std::uint32_t> numbers;
  std::size_t longest = 1;
  for (const CaseRow& row : table.rows) longest = std::max(longest, row.status.size());
  std::string texts;
  for (const CaseRow& row : table.rows) {
    numbers.push_back(row.number);
    texts += row.status + std::string(longest - row.status.size(), '\0');
  }
  const H5Object type = text_type(longest);
  put_column(file, "case", H5T_STD_U32LE, H5T_NATIVE_UINT32, numbers.size(), numbers.data());
  put_column(file, "status", type, type, numbers.size(), texts.data());
}

}  // namespace

std::string unit_of(const std::string& column) {
  static const std::map<std::string, std::string> units = {
      {"m", "m"},       {"mm", "mm"},   {"s", "s"},         {"us", "us"},      {"deg", "deg"},        {"degps", "deg/s"}, {"mps", "m/s"},
      {"mmps", "mm/s"}, {"rad", "rad"}, {"radps", "rad/s"}, {"mps2", "m/s^2"}, {"degps2", "deg/s^2"}, {"K", "K"},         {"hz", "Hz"}};
  const std::size_t begin = column.rfind('_');
  if (begin == std::string::npos) return "";
  const std::size_t end = column.find('.', begin);  // a number of a list: .x, .1
  const auto unit = units.find(column.substr(begin + 1, end == std::string::npos ? end : end - begin - 1));
  return unit == units.end() ? "" : unit->second;
}

std::string results_h5(const ResultTable& table, const std::string& campaign, const std::string& plan) {
  const H5Object file = h5_in_memory();
  put_attribute(file, "campaign", campaign);
  put_attribute(file, "plan", plan);
  put_cases(file, table);
  put_numbers(file, "figures", table.figures, table, &CaseRow::figures);
  put_numbers(file, "drawn", table.columns, table, &CaseRow::drawn);
  return image_of(file);
}

}  // namespace lasso::mdat
