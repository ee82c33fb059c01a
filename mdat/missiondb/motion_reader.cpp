#include "mdat/missiondb/motion_reader.hpp"

#include <functional>
#include <set>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/scene/ccsds.hpp"
#include "mdat/scene/clohessy_wiltshire.hpp"
#include "mdat/scene/motion_csv.hpp"
#include "mdat/scene/torque_free.hpp"
#include "mdat/scene/way.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

using enum ValueKind;
using scene::MotionPtr;

constexpr double kLongest_s = 1e9;
constexpr std::size_t kMostInChain = 16;
constexpr std::size_t kMostLinks = 64;  // of chains in chains

ValueRow file_row(const char* meaning) { return required(text_row("file", "[^\\x00-\\x1f]+", meaning)); }

ValueRow frame_row(const char* meaning) {
  ValueRow row = text_row("frame", "[^\\x00-\\x1f]+", meaning);
  row.count_max = kMostInChain;
  return required(row);
}

ValueRow chain_row() {
  ValueRow row = text_row("of", "[^\\x00-\\x1f]+", "motions, the outer one first: each moves in the frame of the one before");
  row.count_max = kMostInChain;
  return required(row);
}

ValueRow number(const char* key, const char* unit, double to_si, double low, double high, double preset, const char* meaning) {
  return number_row(key, unit, kReal, to_si, low, high, preset, meaning);
}

ValueRow vector_row(const char* key, const char* unit, double to_si, double most, const char* meaning) {
  return list_row(number(key, unit, to_si, -most, most, 0, meaning), 3, {0, 0, 0});
}

ValueRow spin_row() { return vector_row("spin_degps", "deg/s", kRadPerDeg, 360, "angular rate at t = 0 about the node's own x, y, z"); }

std::vector<ValueRow> pointing_rows() {
  return {axis_row("axis", Vec3::UnitZ(), "axis of the node that points, of any length"),
          axis_row("up", -Vec3::UnitY(), "axis of the node that is turned as near to up_reference as can be"),
          axis_row("up_reference", Vec3::UnitZ(), "roll reference, in the parent's axes")};
}

ValueRow leg_kind_row() {
  ValueRow row =
      number_row("kind", "1", kChoice, 1, 0, 2, 0, "hold: at rest; drift: free, from velocity_mps; transfer: to to_m by two impulses");
  row.choices = {"hold", "drift", "transfer"};
  return required(row);
}

std::vector<ValueRow> leg_rows() {
  return {leg_kind_row(), required(number("duration_s", "s", 1, 1e-6, kLongest_s, 0, "how long it takes")),
          vector_row("velocity_mps", "m/s", 1, 1e5, "drift: velocity at its begin, Hill frame"),
          vector_row("to_m", "m", 1, 1e9, "transfer: where it ends, Hill frame")};
}

std::vector<ValueRow> waypoint_rows() {
  return {required(number("time_s", "s", 1, -kLongest_s, kLongest_s, 0, "since frame 0, ascending")),
          required(position_row("where it rests then"))};
}

std::vector<MotionKind> make_kinds() {
  const ValueRow position = position_row("position at t = 0 in the parent"),
                 attitude = quaternion_row("attitude at t = 0: takes node axes to parent axes");
  const ValueRow own_attitude = quaternion_row("attitude: takes node axes to parent axes");
  // clang-format off
  return {
    {"still", "it rests", {position_row("position in the parent"), own_attitude}, "", {}, false},
    {"rates", "constant velocity of a point of the node, constant rate about it",
     {position, attitude, vector_row("velocity_mps", "m/s", 1, 1e5, "velocity along the parent's x, y, z"), spin_row(),
      vector_row("pivot_m", "m", 1, 1e6, "that point, in the node's frame; position_m is its own")}, "", {}, false},
    {"steps", "a turn at the begin of each period, at rest between",
     {position, attitude, axis_row("axis", Vec3::UnitX(), "axis of the turns, node's axes"), number("step_deg", "deg", kRadPerDeg, -180, 180, 1, "each turn"),
      number("period_s", "s", 1, 1e-3, kLongest_s, 0.2, "from turn to turn")}, "", {}, false},
    {"waypoints", "through positions at times, smoothly, at rest at each", {own_attitude}, "at", waypoint_rows(), false},
    {"table", "a CSV file of times, positions and attitudes (docs/scenes.md)", {file_row("the file, from the mission's folder or the one above")}, "", {}, false},
    {"oem", "positions of an orbit ephemeris message of CCSDS", {file_row("the file; its first row is at t = 0"), frame_row("REF_FRAME that is the parent's")}, "", {}, false},
    {"aem", "attitudes of an attitude ephemeris message of CCSDS", {file_row("the file; its first row is at t = 0"), frame_row("the frame that is the parent's")}, "", {}, false},
    {"torque_free", "a rigid body that tumbles about its centre of mass, the node's origin, with principal axes along the node's",
     {position, attitude, spin_row(), list_row(number("inertia", "1", 1, 1e-9, 1e12, 1, "principal moments about x, y, z, in any unit"), 3, {1, 1, 1})}, "", {}, false},
    {"clohessy_wiltshire", "relative motion near the orbit, in the Hill frame", {position_row("where it is at t = 0")}, "legs", leg_rows(), true},
    {"inertial", "keeps its attitude among the stars, in the Hill frame", {attitude}, "", {}, true},
    {"sun_pointing", "an axis follows the Sun, in the Hill frame", pointing_rows(), "", {}, true},
    {"chain", "motions one on the other", {chain_row()}, "", {}, false},
  };
  // clang-format on
}

// One [motion.NAME], but for chains, which need all others.
class MotionReader {
 public:
  MotionReader(const MotionKind& kind, const toml::table& table, const std::string& path, MissionSource& source, ProblemList& problems)
      : kind_(kind), table_(table), path_(path), source_(source), problems_(problems), problems_before_(problems.size()) {
    std::vector<std::string> others{"kind"};
    if (!kind.list.empty()) others.push_back(kind.list);
    values_ = std::make_unique<SceneValues>(table, path, kind.rows, others, source, problems);
  }

  // Null where something is wrong.
  MotionPtr read() {
    static_cast<void>(values_->pose());
    if (problems_.size() != problems_before_) return nullptr;
    orbit_ = source_.scene.orbit ? &*source_.scene.orbit : nullptr;
    if (kind_.needs_orbit && orbit_ == nullptr) {
      values_->complain("kind", '"' + kind_.name + '"', "needs the mission's orbit: add [orbit]");
      return nullptr;
    }
    const std::map<std::string, std::function<MotionPtr()>> makers = {
        {"still", [&] { return make<scene::Still>(values_->pose()); }},
        {"rates", [&] { return rates(); }},
        {"steps", [&] { return steps(); }},
        {"waypoints", [&] { return waypoints(); }},
        {"table", [&] { return table(); }},
        {"oem", [&] { return ephemeris(scene::read_oem); }},
        {"aem", [&] { return ephemeris(scene::read_aem); }},
        {"torque_free", [&] { return torque_free(); }},
        {"clohessy_wiltshire", [&] { return clohessy_wiltshire(); }},
        {"inertial", [&] { return std::make_shared<scene::ConstantRates>(scene::inertial_attitude(*orbit_, values_->pose().q)); }},
        {"sun_pointing", [&] { return sun_pointing(); }},
    };
    return makers.at(kind_.name)();
  }

 private:
  template <class Motion, class Setup>
  MotionPtr make(const Setup& setup) {
    return std::make_shared<Motion>(setup, values_->place());
  }

  MotionPtr rates() {
    scene::ConstantRates::Setup setup;
    setup.T_parent_pivot = values_->pose();
    setup.rates = {rotate(setup.T_parent_pivot.q, values_->vector("spin_degps")), values_->vector("velocity_mps")};
    setup.pivot_node_m = values_->vector("pivot_m");
    return make<scene::ConstantRates>(setup);
  }

  MotionPtr steps() {
    scene::Steps::Setup setup;
    setup.T_parent_node = values_->pose();
    setup.axis_node = values_->axis("axis");
    setup.step_rad = values_->number("step_deg");
    setup.period_us = static_cast<DurationUs>(std::llround(1e6 * values_->number("period_s")));
    return make<scene::Steps>(setup);
  }

  MotionPtr waypoints() {
    scene::MotionTable table;
    each_of_list([&](SceneValues& point) {
      table.times_s.push_back(point.number("time_s"));
      table.positions_m.push_back(point.vector("position_m"));
      table.lines.push_back(point.place().line);
    });
    if (problems_.size() != problems_before_) return nullptr;
    Pose attitude;
    attitude.q = values_->pose().q;
    return std::make_shared<scene::Sum>(make<scene::Way>(table), make<scene::Still>(attitude));
  }

  MotionPtr table() {
    const std::filesystem::path file = values_->file("file");
    return file.empty() ? nullptr : make<scene::TableMotion>(scene::read_motion_csv(file));
  }

  MotionPtr ephemeris(scene::Ephemeris (*read_file_of)(const std::filesystem::path&, const std::vector<std::string>&)) {
    const std::filesystem::path file = values_->file("file");
    return file.empty() ? nullptr : make<scene::TableMotion>(read_file_of(file, values_->texts("frame")).table);
  }

  MotionPtr torque_free() {
    scene::TorqueFree::Setup setup;
    setup.T_parent_node = values_->pose();
    setup.omega_node_radps = values_->vector("spin_degps");
    setup.inertia = values_->vector("inertia");
    return make<scene::TorqueFree>(setup);
  }

  MotionPtr clohessy_wiltshire() {
    scene::ClohessyWiltshire::Setup setup;
    setup.mean_motion_radps = orbit_->mean_motion_radps();
    setup.start_m = values_->vector("position_m");
    each_of_list([&](SceneValues& leg) { setup.legs.push_back(leg_of(leg)); });
    if (problems_.size() != problems_before_) return nullptr;
    return make<scene::ClohessyWiltshire>(setup);
  }

  static scene::ClohessyWiltshire::Leg leg_of(SceneValues& values) {
    using Kind = scene::ClohessyWiltshire::LegKind;
    scene::ClohessyWiltshire::Leg leg;
    leg.kind = static_cast<Kind>(static_cast<int>(values.number("kind")));
    leg.duration_s = values.number("duration_s");
    for (const auto& [key, kind] : {std::pair{"velocity_mps", Kind::kDrift}, std::pair{"to_m", Kind::kTransfer}}) {
      if (leg.kind == kind) leg.vector = values.vector(key);
      if (leg.kind == kind && !values.is_written(key)) values.complain(key, "", "is missing: a leg of this kind needs it");
      if (leg.kind != kind && values.is_written(key)) values.complain(key, "", "has no effect in a leg of this kind: leave it out");
    }
    return leg;
  }

  MotionPtr sun_pointing() {
    const scene::Pointing pointing{values_->axis("axis"), values_->axis("up"), values_->axis("up_reference")};
    return std::make_shared<scene::SunPointing>(*orbit_, pointing, values_->place());
  }

  void each_of_list(const std::function<void(SceneValues&)>& take) {
    const toml::array* array = table_.get(kind_.list) == nullptr ? nullptr : table_.get(kind_.list)->as_array();
    if (array == nullptr || array->empty())
      return values_->complain(kind_.list, "", "expected a list of tables, such as " + kind_.list + " = [{...}, {...}]");
    for (std::size_t i = 0; i < array->size(); ++i) {
      const std::string item = path_ + "." + kind_.list + "[" + std::to_string(i) + "]";
      const toml::table* row = (*array)[i].as_table();
      if (row == nullptr) {
        problems_.add((*array)[i], item, "wrong type: expected a table, such as {...}");
        continue;
      }
      SceneValues values(*row, item, kind_.list_rows, {}, source_, problems_);
      take(values);
    }
  }

  const MotionKind& kind_;
  const toml::table& table_;
  const std::string& path_;
  MissionSource& source_;
  ProblemList& problems_;
  std::size_t problems_before_;
  std::unique_ptr<SceneValues> values_;
  const scene::Orbit* orbit_ = nullptr;
};

// All motions; chains once those are known that they are of.
class MotionsReader {
 public:
  MotionsReader(MissionSource& source, ProblemList& problems) : source_(source), problems_(problems) {}

  void read(const toml::table& root) {
    for_each_table(root, "motion", problems_, [&](const std::string& name, const toml::table& table) {
      names_.push_back(name);
      read_one(name, table);
    });
    for (const auto& [name, chain] : chains_) static_cast<void>(chained(name));
  }

 private:
  void read_one(const std::string& name, const toml::table& table) {
    source_.scene.motions[name] = nullptr;  // known, until it is read
    const std::string path = "motion." + name;
    const MotionKind* kind = kind_of(table, path);
    if (kind == nullptr) return;
    source_.scene.values.push_back({path + ".kind", '"' + kind->name + '"', "", kind->meaning});
    source_.origins[path + ".kind"] = origin_of(table.get("kind")->source());
    kinds_[name] = kind->name;
    if (kind->needs_orbit) source_.scene.in_hill.insert(name);
    if (kind->name == "torque_free") source_.scene.free_tumbles.insert(name);
    if (kind->name == "chain") {
      const SceneValues values(table, path, kind->rows, {"kind"}, source_, problems_);
      chains_[name] = values.texts("of");
      return;
    }
    try {
      source_.scene.motions[name] = MotionReader(*kind, table, path, source_, problems_).read();
    } catch (const MissionError& error) {
      std::vector<Problem> told = error.problems();
      for (Problem& problem : told) {
        if (problem.file == source_.file.string()) problem = at_key(problem, path, problem.key, source_);
      }
      problems_.add(MissionError(told));
    }
  }

  const MotionKind* kind_of(const toml::table& table, const std::string& path) {
    std::vector<std::string> names;
    std::string all;
    const std::string written = table["kind"].value_or(std::string());
    for (const MotionKind& kind : motion_kinds()) {
      if (written == kind.name) return &kind;
      names.push_back(kind.name);
      all += (all.empty() ? "" : ", ") + kind.name;
    }
    const toml::node* node = table.get("kind");
    problems_.add(origin_of(node == nullptr ? table.source() : node->source()), path + ".kind", written.empty() ? "" : '"' + written + '"',
                  "expected one of " + all + did_you_mean(written, names));
    return nullptr;
  }

  MotionPtr known(const std::string& name) const {
    const auto found = source_.scene.motions.find(name);
    return found == source_.scene.motions.end() ? nullptr : found->second;
  }

  // Null where something is wrong, which has been told.
  MotionPtr chained(const std::string& name) {
    const auto chain = chains_.find(name);
    if (chain == chains_.end()) return known(name);
    if (open_.count(name) != 0) return complain(name, "is part of itself");
    if (!tried_.insert(name).second) return known(name);
    open_.insert(name);
    const MotionPtr motion = joined(name, chain->second);
    open_.erase(name);
    source_.scene.motions[name] = motion;
    return motion;
  }

  // What keeps `link` from standing there; empty: nothing does. `keeps_hill`: the motions before it keep the Hill frame's axes.
  std::string fault_of(const std::string& link, bool keeps_hill) const {
    if (std::find(names_.begin(), names_.end(), link) == names_.end())
      return "there is no motion \"" + link + '"' + did_you_mean(link, names_);
    if (keeps_hill || source_.scene.in_hill.count(link) == 0) return "";
    return '"' + link + "\" is a motion in the Hill frame's axes: before it, only clohessy_wiltshire keeps them";
  }

  MotionPtr joined(const std::string& name, const std::vector<std::string>& links) {
    MotionPtr motion;
    bool keeps_hill = true, whole = !links.empty();
    for (const std::string& link : links) {
      const MotionPtr next = chained(link);  // first: it says whether the link is in the Hill frame
      const std::string fault = fault_of(link, keeps_hill);
      if (!fault.empty()) return complain(name, fault);
      if (next == nullptr) {
        whole = false;  // which has been said
        continue;
      }
      keeps_hill = keeps_hill && kinds_[link] == "clohessy_wiltshire";
      source_.scene.used_motions.insert(link);
      sizes_[name] += std::max<std::size_t>(1, sizes_[link]);
      motion = motion == nullptr ? next : std::make_shared<scene::Chain>(motion, next);
    }
    if (!whole) return nullptr;
    if (source_.scene.in_hill.count(links.front()) != 0) source_.scene.in_hill.insert(name);
    if (source_.scene.free_tumbles.count(links.front()) != 0) source_.scene.free_tumbles.insert(name);
    if (sizes_[name] <= kMostLinks) return motion;
    return complain(name, "has " + std::to_string(sizes_[name]) + " motions: expected at most " + std::to_string(kMostLinks));
  }

  MotionPtr complain(const std::string& name, const std::string& what) {
    const std::string key = "motion." + name + ".of";
    problems_.add(source_.origins.at(key), key, "", what);
    return nullptr;
  }

  MissionSource& source_;
  ProblemList& problems_;
  std::vector<std::string> names_;
  std::map<std::string, std::vector<std::string>> chains_;
  std::set<std::string> open_, tried_;  // chains that are being made, or have been
  std::map<std::string, std::size_t> sizes_;
  std::map<std::string, std::string> kinds_;
};

void read_orbit(const toml::table& root, MissionSource& source, ProblemList& problems) {
  const toml::node* node = root.get("orbit");
  if (node == nullptr) return;
  if (!node->is_table()) return problems.add(*node, "orbit", "wrong type: expected a table [orbit]");
  const SceneValues values(*node->as_table(), "orbit", orbit_rows(), {}, source, problems);
  scene::Orbit::Setup setup{1e3 * values.number("altitude_km"), values.number("beta_deg"), values.number("angle_deg")};
  try {
    source.scene.orbit.emplace(setup, values.place());
  } catch (const MissionError& error) {
    problems.add(error);
  }
}

}  // namespace

const std::vector<MotionKind>& motion_kinds() {
  static const std::vector<MotionKind> kinds = make_kinds();
  return kinds;
}

const std::vector<ValueRow>& orbit_rows() {
  static const std::vector<ValueRow> rows = {
      number("altitude_km", "km", 1, 1, 1e6, 400, "height of the circular orbit above the Earth's mean radius"),
      number("beta_deg", "deg", kRadPerDeg, -90, 90, 0, "elevation of the Sun above the orbit's plane"),
      number("angle_deg", "deg", kRadPerDeg, -360, 360, 0, "where the orbit's origin is at frame 0: from orbit noon, along the track"),
  };
  return rows;
}

void read_motions(const toml::table& root, MissionSource& source, ProblemList& problems) {
  read_orbit(root, source, problems);
  MotionsReader(source, problems).read(root);
}

}  // namespace lasso::mdat
