#include "mdat/missiondb/material_reader.hpp"

#include <utility>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/missiondb/laser_material.hpp"

namespace lasso::mdat {
namespace {

using enum ValueKind;

constexpr std::size_t kMostParts = 64;

ValueRow preset_row() {
  ValueRow row = number_row("preset", "1", kChoice, 1, 0, kMaterialNames.size() - 1, 0, "what it is, but for what the other keys say");
  row.choices.assign(kMaterialNames.begin(), kMaterialNames.end());
  return required(row);
}

ValueRow parts_row() {
  ValueRow row =
      text_row("parts", "[^\\x00-\\x1f]+", "parts of the target by name, or NODE.PART of another node; * at the end stands for any ending");
  row.count_max = kMostParts;
  return required(row);
}

// Of the preset where it is not written.
ValueRow own_row(ValueRow row) {
  row.preset.clear();
  return row;
}

ValueRow colour_row(const char* key, const char* meaning) {
  return own_row(list_row(number_row(key, "1", kReal, 1, 0, 1, 0, meaning), 3, {}));
}

// Of a laser's light no more leaves than comes.
void complain_of_laser(const MaterialSource& material, SceneValues& values) {
  const sim::LaserReflection laser = laser_preset(material.preset);
  const double scattered = material.laser.value_or(laser.diffuse), mirrored = material.laser_specular.value_or(laser.specular);
  if (scattered + mirrored > 1)
    values.complain(material.laser ? "laser" : "laser_specular", number_text(material.laser ? scattered : mirrored),
                    "laser " + number_text(scattered) + " and laser_specular " + number_text(mirrored) +
                        ": more light would leave than comes, expected at most 1 together");
}

// The same of light that pictures show.
void complain_of_light(const MaterialSource& material, SceneValues& values) {
  if (material.diffuse.empty() != material.specular.empty())
    return values.complain(material.diffuse.empty() ? "specular" : "diffuse", "",
                           "expected diffuse and specular, or none of them: together they are at most 1");
  for (std::size_t i = 0; i < material.diffuse.size() && !material.specular.empty(); ++i) {
    if (material.diffuse[i] + material.specular[i] <= 1) continue;
    return values.complain(
        "specular", number_text(material.specular[i]),
        "with the diffuse " + number_text(material.diffuse[i]) + " more light would leave than comes: expected at most 1 together");
  }
}

void read_material(const std::string& name, const toml::table& table, MissionSource& source, ProblemList& problems) {
  const std::size_t before = problems.size();
  SceneValues values(table, "material." + name, material_rows(), {}, source, problems);
  if (problems.size() != before) return;
  MaterialSource material;
  material.name = name;
  material.preset = kMaterialNames.at(static_cast<std::size_t>(values.number("preset")));
  material.parts = values.texts("parts");
  if (values.is_written("diffuse")) material.diffuse = values.list("diffuse");
  if (values.is_written("specular")) material.specular = values.list("specular");
  if (values.is_written("roughness")) material.roughness = values.number("roughness");
  if (values.is_written("tilt_deg")) material.tilt_rad = values.number("tilt_deg");
  for (const auto& [key, member] :
       {std::pair{"laser", &MaterialSource::laser}, std::pair{"laser_specular", &MaterialSource::laser_specular},
        std::pair{"laser_roughness", &MaterialSource::laser_roughness}}) {
    if (values.is_written(key)) material.*member = values.number(key);
  }
  complain_of_laser(material, values);
  complain_of_light(material, values);
  if (problems.size() != before) return;
  source.materials.push_back(std::move(material));
}

}  // namespace

const std::vector<ValueRow>& material_rows() {
  static const std::vector<ValueRow> rows = {
      parts_row(),
      preset_row(),
      colour_row("diffuse", "share of the light that is scattered: red, green, blue"),
      colour_row("specular", "share of the light that is mirrored at right angles: red, green, blue"),
      own_row(number_row("roughness", "1", kReal, 1, 0.01, 1, 0, "of the mirror: alpha of GGX")),
      own_row(number_row("laser", "1", kReal, 1, 0, 1, 0, "share of a laser's light that is scattered, at 1550 nm")),
      own_row(number_row("laser_specular", "1", kReal, 1, 0, 1, 0, "share of a laser's light that is mirrored at right angles")),
      own_row(number_row("laser_roughness", "1", kReal, 1, 0.01, 1, 0, "of that mirror: alpha of GGX")),
      own_row(number_row("tilt_deg", "deg", kReal, kRadPerDeg, 0, 30, 0, "how much facets lean against the surface, root mean square")),
  };
  return rows;
}

void read_materials(const toml::table& root, MissionSource& source, ProblemList& problems) {
  for_each_table(root, "material", problems,
                 [&](const std::string& name, const toml::table& table) { read_material(name, table, source, problems); });
}

}  // namespace lasso::mdat
