#include "mdat/missiondb/camera_faults.hpp"

#include <cmath>
#include <iterator>

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {
namespace {

constexpr double kLongest_s = 1e6;

// In the order of LcsFaultKind. A kind without a value has an empty key.
struct KindRow {
  const char* name;
  const char* value_key;
  double minimum, maximum;
  bool lasts;  // it ends at to_s
};
constexpr KindRow kKinds[] = {
    {"drop", "probability", 0, 1, true},
    {"repeat", "probability", 0, 1, true},
    {"corrupt", "probability", 0, 1, true},
    {"late", "delay_s", 0, 10, true},
    {"silent", "", 0, 0, true},
    {"stuck_mirror", "", 0, 0, true},
    {"saturated", "", 0, 0, true},
    {"clock_jump", "jump_s", -1000, 1000, false},
    {"clock_rate", "rate", -0.1, 0.1, true},
    {"reset", "", 0, 0, false},
    {"bit_errors", "rate", 0, 0.5, true},
};

ValueRow fault_row(const std::string& key, double minimum, double maximum, const std::string& unit) {
  return required(number_row(key.c_str(), unit.c_str(), ValueKind::kReal, 1, minimum, maximum, 0, ""));
}

ValueRow kind_row() {
  ValueRow row;
  row.key = "kind";
  row.kind = ValueKind::kChoice;
  for (const KindRow& kind : kKinds) row.choices.emplace_back(kind.name);
  row.required = true;
  return row;
}

std::string unit_of(const std::string& key) { return key.ends_with("_s") ? "s" : "1"; }

std::vector<ValueRow> rows_of(const KindRow& kind) {
  std::vector<ValueRow> rows{kind_row(), fault_row("from_s", 0, kLongest_s, "s")};
  if (kind.lasts) rows.push_back(fault_row("to_s", 0, kLongest_s, "s"));
  if (*kind.value_key != 0) rows.push_back(fault_row(kind.value_key, kind.minimum, kind.maximum, unit_of(kind.value_key)));
  return rows;
}

TimeUs to_us(double time_s) { return static_cast<TimeUs>(std::llround(1e6 * time_s)); }

void read_fault(const toml::table& table, const std::string& prefix, sim::LcsFaults& faults, ProblemList& problems) {
  const toml::node* kind_node = table.get("kind");
  if (kind_node == nullptr) return problems.add(origin_of(table.source()), prefix + "kind", "", expectation(kind_row()));
  const std::optional<FoundValue> kind = read_value(*kind_node, kind_row(), prefix + "kind", problems);
  if (!kind) return;
  const auto number = static_cast<std::size_t>(kind->numbers.at(0));
  const KindRow& row = kKinds[number];
  const FoundValues found = read_table(table, prefix, rows_of(row), {}, problems);
  const auto value = [&](const char* key, double otherwise) {
    const auto place = found.find(key);
    return place == found.end() ? otherwise : place->second.numbers.at(0);
  };
  sim::LcsFault fault;
  fault.kind = static_cast<sim::LcsFaultKind>(number);
  fault.from_us = to_us(value("from_s", 0));
  fault.until_us = to_us(value("to_s", kLongest_s));
  fault.value = value(row.value_key, 0);
  if (found.count("to_s") != 0 && fault.until_us <= fault.from_us)
    problems.add(*table.get("to_s"), prefix + "to_s", "expected more than from_s");
  faults.push_back(fault);
}

}  // namespace

sim::LcsFaults load_camera_faults(const std::filesystem::path& file) {
  const toml::table root = parse_toml(file);
  ProblemList problems(file);
  sim::LcsFaults faults;
  for (const auto& [name, node] : root) {
    const toml::array* list = node.as_array();
    if (name.str() != "fault" || list == nullptr || !list->is_homogeneous(toml::node_type::table)) {
      problems.add(node, std::string(name.str()), "expected tables [[fault]] and nothing else");
      continue;
    }
    for (std::size_t i = 0; i < list->size(); ++i) {
      read_fault(*list->get(i)->as_table(), "fault[" + std::to_string(i) + "].", faults, problems);
    }
  }
  problems.throw_if_any();
  return faults;
}

}  // namespace lasso::mdat
