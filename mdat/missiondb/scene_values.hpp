// Values of a table that a scene is told by: poses, axes, places in the file. Inside of missiondb.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {

Origin origin_of(const scene::Place& place);

ValueRow position_row(const char* meaning);    // position_m
ValueRow quaternion_row(const char* meaning);  // quaternion, x, y, z, w
ValueRow axis_row(const char* key, const Vec3& preset, const char* meaning);

// A problem of the table `path`, of which `what` names a key, or what that says: at the key's own place, where there is one in the file.
Problem at_key(const Problem& problem, const std::string& path, const std::string& what, const MissionSource& source);

// One table by its rows: what it says, or else the presets, in SI. Each problem is told with its place.
class SceneValues {
 public:
  // `path` without a dot at its end; `others` as those of read_table. What is written is among the source's values and origins.
  SceneValues(const toml::table& table, std::string path, const std::vector<ValueRow>& rows, const std::vector<std::string>& others,
              MissionSource& source, ProblemList& problems);

  bool is_written(const std::string& key) const { return found_.count(key) != 0; }
  bool is_any_written(const std::string& beginning) const;
  double number(const std::string& key) const { return list(key).at(0); }
  std::vector<double> list(const std::string& key) const;
  Vec3 vector(const std::string& key) const { return Vec3(list(key).data()); }
  std::string text(const std::string& key) const;  // empty: not written
  std::vector<std::string> texts(const std::string& key) const { return texts_of(found_, key); }
  Vec3 axis(const std::string& key);                   // scaled to unit length
  Pose pose();                                         // of position_m and quaternion, as far as there are such rows
  std::filesystem::path file(const std::string& key);  // in the mission's folder or the one above; empty: a problem

  scene::Place place() const { return place_; }
  void complain(const std::string& key, const std::string& value, const std::string& expected);

 private:
  const toml::table& table_;
  std::string path_;
  const std::vector<ValueRow>& rows_;
  MissionSource& source_;
  ProblemList& problems_;
  FoundValues found_;
  scene::Place place_;
};

}  // namespace lasso::mdat
