#include "mdat/missiondb/part_reader.hpp"

#include <cmath>
#include <numeric>

#include "cfg/capacities.hpp"
#include "mdat/missiondb/beside.hpp"
#include "mdat/missiondb/mission_checks.hpp"
#include "mdat/missiondb/sections.hpp"

namespace lasso::mdat {
namespace {

double length_of(const std::vector<double>& v) { return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0)); }

void scale_to_unit(std::vector<double>& v) {
  const double length = length_of(v);
  for (double& x : v) x /= length;
}

std::string list_text(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + number_text(value);
  return text + "]";
}

// One part: values, then what they say together.
class PartReader {
 public:
  PartReader(const std::string& name, const toml::table& table, MissionSource& source, ProblemList& problems)
      : table_(table), source_(source), problems_(problems), prefix_("part." + name + ".") {
    part_.name = name;
  }

  void read() {
    found_ = read_table(table_, prefix_, part_rows(), {}, problems_);
    for (const ValueRow& row : part_rows()) source_.origins[prefix_ + row.key] = origin_of_key(row.key);
    if (!problems_.empty()) return;
    for (const PartField& field : part_fields()) fill(field);
    check_values();
    find_model();
    if (!problems_.empty()) return;
    scale_to_unit(part_.view);
    scale_to_unit(part_.quaternion);
    source_.parts.push_back(part_);
  }

 private:
  Origin origin_of_key(const std::string& key) const {
    const auto value = found_.find(key);
    return value == found_.end() ? Origin{} : value->second.origin;
  }
  void complain(const std::string& key, const std::string& value, const std::string& expected) {
    const Origin origin = origin_of_key(key);
    problems_.add(origin.preset() ? origin_of(table_.source()) : origin, prefix_ + key, value, expected);
  }

  void fill(const PartField& field) {
    const auto value = found_.find(field.row.key);
    std::vector<double> numbers = value == found_.end() ? field.row.preset : value->second.numbers;
    for (double& number : numbers) number *= field.row.to_si;
    if (field.list != nullptr) part_.*field.list = numbers;
    if (field.number != nullptr) part_.*field.number = numbers.at(0);
  }

  void check_values() {
    if (part_.range_m[0] >= part_.range_m[1])
      complain("range_m", list_text(part_.range_m), "expected the nearest distance first, then a larger one");
    if (!(length_of(part_.view) > 0)) complain("view", list_text(part_.view), "expected a direction, which is not zero");
    if (std::fabs(length_of(part_.quaternion) - 1) > kQuaternionTolerance) {
      complain("quaternion", list_text(part_.quaternion),
               "expected x, y, z, w of unit length (within " + number_text(kQuaternionTolerance) + ")");
    }
    for (std::size_t i = 0; i < 3 && !part_.box_m.empty(); ++i) {
      if (part_.box_m[i] < part_.box_m[i + 3]) continue;
      return complain("box_m", list_text(part_.box_m), "expected the low x, y, z, and then higher ones");
    }
  }

  void find_model() {
    const std::size_t given = found_.count("box_m") + found_.count("model") + found_.count("mesh");
    if (given != 1)
      return complain(
          "box_m", "",
          "the part needs exactly one model: box_m (cut from the target), model or mesh; " + std::to_string(given) + " are given");
    if (!part_.box_m.empty()) return;
    part_.parametric = found_.count("model") != 0;
    find_file(part_.parametric ? "model" : "mesh");
  }
  void find_file(const std::string& key) {
    const std::string& written = found_[key].texts.at(0);
    if (find_beside(source_, written, part_.file)) return;
    const std::string folder = std::filesystem::absolute(source_.file).parent_path().string();
    complain(key, '"' + written + '"', "no such file in " + folder + " or the folder above it: restore it, or delete the part");
  }

  const toml::table& table_;
  MissionSource& source_;
  ProblemList& problems_;
  std::string prefix_;
  PartSource part_;
  FoundValues found_;
};

}  // namespace

void read_parts(const toml::table& root, MissionSource& source, ProblemList& problems) {
  const toml::table* parts = root["part"].as_table();
  if (parts != nullptr && parts->size() > kMaxParts) {
    return problems.add(*parts, "part",
                        "expected at most " + std::to_string(kMaxParts) + " parts: the flight component has room for no more");
  }
  for_each_table(root, "part", problems,
                 [&](const std::string& name, const toml::table& table) { PartReader(name, table, source, problems).read(); });
}

}  // namespace lasso::mdat
