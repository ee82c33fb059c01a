#include "mdat/missiondb/laser_material.hpp"

#include <algorithm>
#include <map>

#include "mdat/missiondb/likely_material.hpp"
#include "mdat/missiondb/target_parts.hpp"

namespace lasso::mdat {
namespace {

// Sources of the whole reflectance; its division into diffuse and specular, and the roughness, are those of pictures (mdat/render), which
// are estimates by eye: no source states them for foil as it is laid. The lean s of facets, which pictures show, widens the lobe here:
// roughness^2 = alpha^2 + 2 s^2.
// Metals by Fresnel's equation at right angles from n + ik at 1550 nm: aluminium 1.44 + 16.0i gives 0.98, silver 0.14 + 11.4i more than
// 0.99 (Rakic, Djurisic, Elazar, Majewski, Optical properties of metallic films, Applied Optics 37, 1998).
const std::map<std::string, sim::LaserReflection>& laser_presets() {
  static const std::map<std::string, sim::LaserReflection> presets = {
      // Estimate: binders of white paints absorb a little between 1.4 and 1.9 um, so somewhat less than in the visible.
      {"white-paint", {0.75, 0.04, 0.5}},
      // Silver behind FEP, which is clear there.
      {"silver-teflon", {0.15, 0.83, 0.16}},
      // Aluminium, tarnished: 0.95.
      {"aluminium-foil", {0.18, 0.77, 0.22}},
      // Aluminium behind Kapton, which is amber by what it absorbs below 0.6 um, and clear there: 0.90.
      {"mli", {0.19, 0.71, 0.31}},
      // Estimate: an anti-reflection coat off its design, the grid of contacts, and germanium that absorbs what GaAs lets through.
      {"solar-cells", {0.05, 0.10, 0.06}},
      // Estimate: black by an organic dye, which is clear beyond 0.8 um, so that the metal shows (Marshall et al., Characterization of the
      // reflectivity of various black materials, SPIE 9147, 2014, measured such samples from 250 to 2500 nm).
      {"black-anodised", {0.40, 0.04, 0.35}},
      // As in the visible.
      {"regolith", {0.12, 0, 1}},
  };
  return presets;
}

}  // namespace

sim::LaserReflection laser_preset(const std::string& preset) { return laser_presets().at(preset); }

sim::LaserReflection laser_reflection(const MissionSource& source, const std::string& part) {
  for (const MaterialSource& material : source.materials) {
    const auto matches = [&](const std::string& pattern) { return matches_part(part, pattern); };
    if (std::none_of(material.parts.begin(), material.parts.end(), matches)) continue;
    const sim::LaserReflection preset = laser_preset(material.preset);
    return {material.laser.value_or(preset.diffuse), material.laser_specular.value_or(preset.specular),
            material.laser_roughness.value_or(preset.roughness)};
  }
  return laser_preset(likely_material_name(part));
}

std::vector<sim::LaserReflection> laser_reflections(const MissionSource& source, const std::vector<std::string>& names,
                                                    const std::vector<std::uint32_t>& of_triangle) {
  std::vector<sim::LaserReflection> of_part, result;
  for (const std::string& name : names) of_part.push_back(laser_reflection(source, name));
  result.reserve(of_triangle.size());
  for (const std::uint32_t part : of_triangle) result.push_back(of_part[part]);
  return result;
}

bool has_detector(const MissionSource& source) {
  const auto sees = [](const auto& sensor) { return sim::is_simulated(sensor.detector) || sensor.flash.materials; };
  return sees(source) || std::any_of(source.further_sensors.begin(), source.further_sensors.end(), sees);
}

}  // namespace lasso::mdat
