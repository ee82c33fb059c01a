#include "mdat/missiondb/model_file.hpp"

#include <Eigen/Geometry>
#include <numbers>
#include <optional>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/missiondb/solid.hpp"
#include "mdat/missiondb/toml_reader.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

using Eigen::Vector3d;

ValueRow real_row(const std::string& key, double minimum, double maximum, const std::string& meaning) {
  ValueRow row;
  row.key = key;
  row.minimum = minimum;
  row.maximum = maximum;
  row.preset = {0};
  row.meaning = meaning;
  return row;
}

ValueRow line_row(const std::string& key, const std::string& meaning) {
  ValueRow row = real_row(key, 0, 0, meaning);
  row.kind = ValueKind::kText;
  row.pattern = "[^\\x00-\\x1f]*";
  return row;
}

std::vector<ValueRow> parameter_table_rows() {
  std::vector<ValueRow> rows{real_row("preset", -1e9, 1e9, "value where the mission has none"),
                             real_row("minimum", -1e9, 1e9, "least value"), real_row("maximum", -1e9, 1e9, "greatest value"),
                             line_row("unit", "unit of the value"), line_row("meaning", "one line")};
  for (ValueRow& row : rows) row.required = true;
  return rows;
}

// Reads one model; all problems gather, values that are wrong count as 1 so that reading can go on.
class ModelReader {
 public:
  explicit ModelReader(const std::filesystem::path& file) : ModelReader(parse_toml(file), file) {}
  ModelReader(toml::table root, const std::filesystem::path& file) : root_(std::move(root)), problems_(file) {
    read_table(root_, "", {line_row("name", "name of the model"), scale_row()}, {"parameters", "part"}, problems_);
    scale_ = root_["scale"].value<double>().value_or(1);
    read_parameters();
  }

  const std::vector<ModelParameter>& parameters() const { return parameters_; }
  void finish() const { problems_.throw_if_any(); }

  Mesh build(const std::map<std::string, double>& values, std::vector<ModelSolid>* solids = nullptr) {
    for (const ModelParameter& parameter : parameters_) values_[parameter.name] = parameter.preset;
    for (const auto& [name, value] : values) values_[name] = value;
    Mesh mesh;
    const toml::array* parts = root_["part"].as_array();
    if (parts == nullptr || !root_["part"].is_array_of_tables()) {
      problems_.add(origin_of(root_.source()), "part", "", "expected at least one [[part]]");
    } else {
      for (const toml::node& part : *parts) {
        const std::size_t before = mesh.triangles.size();
        add_part(*part.as_table(), mesh);
        if (solids != nullptr) solids->push_back({part_name(*part.as_table()), mesh.triangles.size() - before});
      }
    }
    finish();
    for (Vector3d& vertex : mesh.vertices) vertex *= scale_;
    return mesh;
  }

 private:
  static ValueRow scale_row() {
    ValueRow row = real_row("scale", 1e-9, 1e9, "the file's lengths times this are metres");
    row.preset = {1};
    return row;
  }
  void read_parameters() {
    const toml::node* node = root_.get("parameters");
    if (node == nullptr) return;
    if (!node->is_table()) return problems_.add(*node, "parameters", "wrong type: expected tables [parameters.NAME]");
    for (const auto& [name, entry] : *node->as_table()) {
      const std::string prefix = "parameters." + std::string(name.str());
      if (const toml::table* table = entry.as_table()) {
        add_parameter(std::string(name.str()), read_table(*table, prefix + ".", parameter_table_rows(), {}, problems_));
      } else {
        problems_.add(entry, prefix, "wrong type: expected a table [" + prefix + "]");
      }
    }
  }
  void add_parameter(const std::string& name, const FoundValues& found) {
    if (found.size() != parameter_table_rows().size()) return;  // said already
    const auto number = [&](const char* key) { return found.at(key).numbers[0]; };
    parameters_.push_back(
        {name, found.at("unit").texts.at(0), found.at("meaning").texts.at(0), number("preset"), number("minimum"), number("maximum")});
    if (number("preset") < number("minimum") || number("preset") > number("maximum")) {
      problems_.add(found.at("preset").origin, "parameters." + name + ".preset", number_text(number("preset")),
                    "expected within minimum and maximum");
    }
  }

  // A number, or the name of a parameter, with a minus sign before it to negate.
  double number(const toml::node* node, const toml::table& owner, const std::string& key, double minimum, double maximum,
                std::optional<double> preset = std::nullopt) {
    const ValueRow row = real_row(key, minimum, maximum, "or the name of a parameter");
    if (node == nullptr) {
      if (preset) return *preset;
      problems_.add(origin_of(owner.source()), where_ + key, "", "is missing: " + expectation(row));
      return 1;
    }
    if (node->is_string()) return parameter_value(*node, key, row);
    const auto value = read_value(*node, row, where_ + key, problems_);
    return value ? value->numbers[0] : 1;
  }
  double parameter_value(const toml::node& node, const std::string& key, const ValueRow& row) {
    std::string name = node.value_or(std::string());
    const double sign = name.rfind('-', 0) == 0 ? -1 : 1;
    if (sign < 0) name.erase(0, 1);
    const auto value = values_.find(name);
    if (value != values_.end() && sign * value->second >= row.minimum && sign * value->second <= row.maximum) return sign * value->second;
    problems_.add(node, where_ + key, expectation(row) + ", or the name of a parameter of the model with such a value");
    return 1;
  }
  double number(const toml::table& table, const std::string& key, double minimum, double maximum,
                std::optional<double> preset = std::nullopt) {
    return number(table.get(key), table, key, minimum, maximum, preset);
  }
  double length(const toml::table& table, const std::string& key, std::optional<double> preset = std::nullopt) {
    return number(table, key, 1e-9, 1e9, preset);
  }
  int count(const toml::table& table, const std::string& key, int minimum, int maximum, int preset) {
    ValueRow row = real_row(key, minimum, maximum, "a count");
    row.kind = ValueKind::kInteger;
    const toml::node* node = table.get(key);
    if (node == nullptr) return preset;
    const auto value = read_value(*node, row, where_ + key, problems_);
    return value ? static_cast<int>(value->numbers[0]) : preset;
  }
  double angle_rad(const toml::table& table, const std::string& key, std::optional<double> preset = std::nullopt) {
    return kRadPerDeg * number(table, key, -36000, 36000, preset);
  }
  Vector3d vector(const toml::node* node, const toml::table& owner, const std::string& key, std::optional<Vector3d> preset = std::nullopt) {
    if (node == nullptr && preset) return *preset;
    const toml::array* array = node == nullptr ? nullptr : node->as_array();
    if (array == nullptr || array->size() != 3) {
      problems_.add(origin_of(node == nullptr ? owner.source() : node->source()), where_ + key, "",
                    "expected a list of 3 numbers: x, y, z");
      return Vector3d::UnitX();
    }
    Vector3d value;
    for (int i = 0; i < 3; ++i) value[i] = number(array->get(static_cast<std::size_t>(i)), owner, key, -1e9, 1e9);
    return value;
  }
  Vector3d vector(const toml::table& table, const std::string& key, const std::optional<Vector3d>& preset = std::nullopt) {
    return vector(table.get(key), table, key, preset);
  }
  Vector3d direction(const toml::table& table, const std::string& key) {
    const Vector3d axis = vector(table, key);
    if (axis.norm() > 1e-9) return axis.normalized();
    problems_.add(origin_of(table.source()), where_ + key, "", "expected an axis, not a vector of length 0");
    return Vector3d::UnitX();
  }

  void known_keys(const toml::table& table, const std::vector<std::string>& keys) {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (std::find(keys.begin(), keys.end(), name) != keys.end()) continue;
      problems_.add(origin_of(key.source()), where_ + name, "", "unknown key" + did_you_mean(name, keys));
    }
  }

  static std::string part_name(const toml::table& part) { return part["name"].value_or(std::string("part")); }
  void add_part(const toml::table& part, Mesh& mesh) {
    const std::string name = part_name(part);
    where_ = name + ": ";
    const Mesh solid = make_part(part);
    if (!problems_.empty()) return;
    if (!has_volume(solid)) {
      return problems_.add(origin_of(part.source()), name, "", "has no volume: expected a closed solid that does not cross itself");
    }
    append_repeated(part, placed(part, solid), mesh);
  }
  static bool has_volume(const Mesh& solid) {
    constexpr double kLeastShare = 1e-9;  // of the cube about it; a rod a thousand times longer than thick has 1e-6
    double extent = 0;
    for (const Vector3d& vertex : solid.vertices) extent = std::max(extent, (vertex - solid.vertices[0]).cwiseAbs().maxCoeff());
    return signed_volume(solid) > kLeastShare * extent * extent * extent;
  }
  Mesh make_part(const toml::table& part) {
    const std::string kind = part["kind"].value_or(std::string());
    if (kind == "box") return box_part(part);
    if (kind == "rod") return rod_part(part);
    if (kind == "dish") return dish_part(part);
    if (kind == "revolve") return revolve_part(part);
    if (kind == "rock") return rock_part(part);
    problems_.add(origin_of(part.source()), where_ + "kind", '"' + kind + '"',
                  "expected one of \"box\", \"rod\", \"dish\", \"revolve\", \"rock\"");
    return {};
  }
  Vector3d sides(const toml::table& part) {
    const Vector3d size = vector(part, "size");
    if (size.minCoeff() <= 0) problems_.add(origin_of(part.source()), where_ + "size", "", "expected three lengths greater than 0");
    return size;
  }
  Mesh box_part(const toml::table& part) {
    known_keys(part, {"name", "kind", "place", "repeat", "size"});
    return make_box(sides(part));
  }
  Mesh rock_part(const toml::table& part) {
    known_keys(part, {"name", "kind", "place", "repeat", "size", "roughness", "seed", "fineness"});
    RockShape shape;
    shape.size = sides(part);
    shape.roughness = number(part, "roughness", 0, 0.5, 0.2);
    shape.seed = static_cast<std::uint64_t>(count(part, "seed", 0, 1000000000, 0));
    shape.fineness = count(part, "fineness", 0, 5, 3);
    return make_rock(shape);
  }
  Mesh rod_part(const toml::table& part) {
    known_keys(part, {"name", "kind", "place", "repeat", "from", "to", "radius", "radius_to", "sides"});
    const Vector3d from = vector(part, "from");
    const Vector3d to = vector(part, "to");
    const double radius = length(part, "radius");
    const double radius_to = number(part, "radius_to", 0, 1e9, radius);
    const int sides = count(part, "sides", 3, 360, 16);
    if ((to - from).norm() > 1e-9) return make_rod(from, to, radius, radius_to, sides);
    problems_.add(origin_of(part.source()), where_ + "to", "", "expected another point than `from`");
    return {};
  }
  Mesh dish_part(const toml::table& part) {
    known_keys(part, {"name", "kind", "place", "repeat", "radius", "depth", "thickness", "rings", "sides"});
    DishShape shape;
    shape.radius = length(part, "radius");
    shape.depth = length(part, "depth");
    shape.thickness = length(part, "thickness");
    shape.rings = count(part, "rings", 1, 100, 6);
    shape.sides = count(part, "sides", 3, 360, 32);
    return make_dish(shape);
  }
  Mesh revolve_part(const toml::table& part) {
    known_keys(part, {"name", "kind", "place", "repeat", "profile", "start_deg", "sweep_deg", "sides"});
    const std::vector<Eigen::Vector2d> profile = read_profile(part);
    Turn turn;
    turn.start_rad = angle_rad(part, "start_deg", 0.0);
    turn.sweep_rad = kRadPerDeg * number(part, "sweep_deg", 0.01, 360, 360.0);
    turn.sides = count(part, "sides", 1, 720, 96);
    if (turn.sides * 120 * kRadPerDeg < turn.sweep_rad - 1e-9) {
      problems_.add(origin_of(part.source()), where_ + "sides", std::to_string(turn.sides), "expected a side for at most every 120 deg");
    }
    if (profile.size() < 3 || !problems_.empty()) return {};
    return make_revolve(profile, turn);
  }
  std::vector<Eigen::Vector2d> read_profile(const toml::table& part) {
    std::vector<Eigen::Vector2d> profile;
    const toml::array* points = part["profile"].as_array();
    for (std::size_t i = 0; points != nullptr && i < points->size(); ++i) {
      const toml::array* point = points->get(i)->as_array();
      if (point == nullptr || point->size() != 2) {
        problems_.add(*points->get(i), where_ + "profile", "expected a point [x, r]");
        continue;
      }
      const double x = number(point->get(0), part, "profile", -1e9, 1e9);
      const double r = number(point->get(1), part, "profile", 0, 1e9);
      profile.emplace_back(x, r);
    }
    if (profile.size() < 3) problems_.add(origin_of(part.source()), where_ + "profile", "", "expected at least 3 points [[x, r], ...]");
    return profile;
  }

  static void turn_mesh(Mesh& mesh, const Vector3d& axis, double angle, const Vector3d& through) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    for (Vector3d& p : mesh.vertices) p = (through + R * (p - through)).eval();
  }
  // The steps of `place`, one after the other.
  Mesh placed(const toml::table& part, Mesh mesh) {
    const toml::node* node = part.get("place");
    if (node == nullptr) return mesh;
    const toml::array* steps = node->as_array();
    if (steps == nullptr) {
      problems_.add(*node, where_ + "place", "expected a list of steps [{turn = [..], angle_deg = ..}, {move = [..]}]");
      return mesh;
    }
    for (const toml::node& step : *steps) {
      if (const toml::table* table = step.as_table()) {
        place_step(*table, mesh);
      } else {
        problems_.add(step, where_ + "place", "expected a step {move = [x, y, z]} or {turn = [x, y, z], angle_deg = ..}");
      }
    }
    return mesh;
  }
  void place_step(const toml::table& step, Mesh& mesh) {
    if (step.contains("move")) {
      known_keys(step, {"move"});
      const Vector3d shift = vector(step, "move");
      for (Vector3d& p : mesh.vertices) p += shift;
      return;
    }
    known_keys(step, {"turn", "angle_deg", "through"});
    const Vector3d axis = direction(step, "turn");
    const double angle = angle_rad(step, "angle_deg");
    turn_mesh(mesh, axis, angle, vector(step, "through", Vector3d::Zero()));
  }
  void append_repeated(const toml::table& part, Mesh solid, Mesh& mesh) {
    append(mesh, solid);
    const toml::node* node = part.get("repeat");
    if (node == nullptr) return;
    if (!node->is_table()) return problems_.add(*node, where_ + "repeat", "expected {count = .., axis = [x, y, z], angle_deg = ..}");
    const toml::table& repeat = *node->as_table();
    known_keys(repeat, {"count", "axis", "angle_deg", "through"});
    const Vector3d axis = direction(repeat, "axis");
    const double angle = angle_rad(repeat, "angle_deg");
    const Vector3d through = vector(repeat, "through", Vector3d::Zero());
    const int copies = count(repeat, "count", 1, 1000, 1);
    for (int i = 1; i < copies; ++i) {
      turn_mesh(solid, axis, angle, through);
      append(mesh, solid);
    }
  }

  toml::table root_;
  ProblemList problems_;
  double scale_ = 1;
  std::vector<ModelParameter> parameters_;
  std::map<std::string, double> values_;
  std::string where_;
};

}  // namespace

std::vector<ModelParameter> model_parameters(const std::filesystem::path& file) {
  ModelReader reader(file);
  reader.finish();
  return reader.parameters();
}

Mesh build_model(const std::filesystem::path& file, const std::map<std::string, double>& values, std::vector<ModelSolid>* solids) {
  ModelReader reader(file);
  reader.finish();
  return reader.build(values, solids);
}

Mesh build_model_text(const std::string& text, const std::map<std::string, double>& values) {
  const std::filesystem::path nowhere = "model";
  ModelReader reader(parse_toml_text(text, nowhere), nowhere);
  reader.finish();
  return reader.build(values);
}

}  // namespace lasso::mdat
