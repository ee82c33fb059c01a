#include "mdat/missiondb/scene_values.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/missiondb/beside.hpp"
#include "mdat/missiondb/mission_checks.hpp"

namespace lasso::mdat {
namespace {

constexpr double kFarthest_m = 1e9;

std::string value_text_of(const ValueRow& row, const FoundValue& value) {
  if (row.kind != ValueKind::kText) return toml_text(row, value.numbers);
  std::string text;
  for (const std::string& item : value.texts) text += (text.empty() ? "\"" : ", \"") + item + '"';
  return value.texts.size() == 1 ? text : "[" + text + "]";
}

}  // namespace

Origin origin_of(const scene::Place& place) { return {place.line, place.column, place.file == kSettingPlace}; }

Problem at_key(const Problem& problem, const std::string& path, const std::string& what, const MissionSource& source) {
  static const std::map<std::string, std::string> meanings = {{"pose", "quaternion"}, {"roll reference", "up_reference"}};
  const auto meaning = meanings.find(what);
  const std::string key = path + "." + (meaning == meanings.end() ? what : meaning->second);
  const auto origin = source.origins.find(key);
  Problem told = problem;
  told.key = origin != source.origins.end() ? key : path + (what.empty() ? "" : ", " + what);
  const bool placed = origin != source.origins.end() && !origin->second.preset();
  return placed ? problem_at(source, key, problem.value, problem.expected) : told;
}

ValueRow position_row(const char* meaning) {
  return list_row(number_row("position_m", "m", ValueKind::kReal, 1, -kFarthest_m, kFarthest_m, 0, meaning), 3, {0, 0, 0});
}

ValueRow quaternion_row(const char* meaning) {
  return list_row(number_row("quaternion", "1", ValueKind::kReal, 1, -1, 1, 0, meaning), 4, {0, 0, 0, 1});
}

ValueRow axis_row(const char* key, const Vec3& preset, const char* meaning) {
  return list_row(number_row(key, "1", ValueKind::kReal, 1, -1e6, 1e6, 0, meaning), 3, {preset.x(), preset.y(), preset.z()});
}

SceneValues::SceneValues(const toml::table& table, std::string path, const std::vector<ValueRow>& rows,
                         const std::vector<std::string>& others, MissionSource& source, ProblemList& problems)
    : table_(table), path_(std::move(path)), rows_(rows), source_(source), problems_(problems) {
  found_ = read_table(table_, path_ + ".", rows_, others, problems_);
  const Origin origin = origin_of(table_.source());
  place_ = {origin.set ? kSettingPlace : source_.file.string(), origin.line, origin.column};
  for (const ValueRow& row : rows_) {
    const auto value = found_.find(row.key);
    const std::string key = path_ + "." + row.key;
    source_.origins[key] = value == found_.end() ? Origin{} : value->second.origin;
    if (value != found_.end()) source_.scene.values.push_back({key, value_text_of(row, value->second), row.unit, row.meaning});
  }
}

bool SceneValues::is_any_written(const std::string& beginning) const {
  return std::any_of(found_.begin(), found_.end(), [&](const auto& entry) { return entry.first.rfind(beginning, 0) == 0; });
}

std::vector<double> SceneValues::list(const std::string& key) const {
  const ValueRow& row = *find_row(rows_, key);
  const auto value = found_.find(key);
  std::vector<double> numbers = value == found_.end() ? row.preset : value->second.numbers;
  numbers.resize(row.count_min);  // of one that was not read, and is a problem
  for (double& number : numbers) number *= row.to_si;
  return numbers;
}

std::string SceneValues::text(const std::string& key) const {
  const std::vector<std::string> written = texts(key);
  return written.empty() ? "" : written.front();
}

Vec3 SceneValues::axis(const std::string& key) {
  const Vec3 direction = vector(key);
  if (direction.norm() > 0) return direction.normalized();
  if (is_written(key)) complain(key, "", "expected a direction, which is not zero");
  return Vec3::UnitX();
}

Pose SceneValues::pose() {
  Pose pose;
  if (find_row(rows_, "position_m") != nullptr) pose.p = vector("position_m");
  if (find_row(rows_, "quaternion") == nullptr) return pose;
  const std::vector<double> q = list("quaternion");
  const Quat written(q[3], q[0], q[1], q[2]);
  if (std::fabs(written.norm() - 1) > kQuaternionTolerance) {
    complain("quaternion", toml_text(*find_row(rows_, "quaternion"), q),
             "expected x, y, z, w of unit length (within " + number_text(kQuaternionTolerance) + ")");
    return pose;
  }
  pose.q = written.normalized();
  return pose;
}

std::filesystem::path SceneValues::file(const std::string& key) {
  std::filesystem::path found;
  const std::string written = text(key);
  if (written.empty()) return found;  // is missing, which has been said
  if (find_beside(source_, written, found)) return found;
  const std::string folder = std::filesystem::absolute(source_.file).parent_path().string();
  complain(key, '"' + written + '"', "no such file in " + folder + " or the folder above it");
  return {};
}

void SceneValues::complain(const std::string& key, const std::string& value, const std::string& expected) {
  const auto written = found_.find(key);
  problems_.add(written == found_.end() ? origin_of(table_.source()) : written->second.origin, path_ + (key.empty() ? "" : "." + key),
                value, expected);
}

}  // namespace lasso::mdat
