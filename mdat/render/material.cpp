#include "mdat/render/material.hpp"

#include <algorithm>

#include "mdat/missiondb/likely_material.hpp"

namespace lasso::mdat {
namespace {

Reflection grey(double diffuse, double specular, double roughness) { return {Rgb::Constant(diffuse), Rgb::Constant(specular), roughness}; }

// Reflectances add up to 1 - alpha, the solar absorptance that is stated. Sources:
// [F] Fortescue, Swinerd, Stark, Spacecraft Systems Engineering, 4th ed. 2011, table 11.3.
// [H] Henninger, Solar Absorptance and Thermal Emittance of Some Common Spacecraft Thermal-Control Coatings, NASA RP-1121, 1984.
// [L] Lauretta et al., The unexpected surface of asteroid (101955) Bennu, Nature 568, 2019 (0.044), and S types of about 0.2: between them.
// How the reflectance is divided into diffuse and specular, roughness, tilt and size of facets are estimates by eye from pictures of
// spacecraft: no source states them for foil as it is laid.
std::span<const Material> presets() {
  static const Material kPresets[] = {
      // Silicate white paint after 1000 h of ultraviolet light, alpha 0.14 [F]; the binder's surface reflects 4 %.
      {"white-paint", "white thermal paint", grey(0.82, 0.04, 0.5), 0, 0, 0.03, 0, 0.14},
      // Silver-coated FEP (second-surface mirror), alpha 0.08 [F]; laid as tape, slightly wavy.
      {"silver-teflon", "silver-backed Teflon tape", grey(0.14, 0.78, 0.14), 0.05, 0.023, 0.06, 0, 0.08},
      // Aluminium tape, alpha 0.21 [F].
      {"aluminium-foil", "aluminium foil or tape", grey(0.15, 0.64, 0.18), 0.09, 0.018, 0.04, 0, 0.21},
      // Aluminised Kapton, Kapton outside, alpha 0.40 [F]; amber, as it absorbs blue.
      {"mli",
       "multi-layer insulation, aluminised Kapton outside",
       {{0.18, 0.13, 0.05}, {0.68, 0.50, 0.26}, 0.20},
       0.17,
       0.014,
       0.08,
       0,
       0.40},
      // GaAs cells behind cover glass, alpha 0.88 [F]; the glass reflects 4 %; the rest is the grid of contacts and gaps, and a bluish
      // coat.
      {"solar-cells", "solar cells behind glass", {{0.020, 0.030, 0.085}, Rgb::Constant(0.04), 0.06}, 0.004, 0.03, 0.05, 0.012, 0.88},
      // Black anodised aluminium, alpha 0.86 [H].
      {"black-anodised", "black anodised aluminium", grey(0.10, 0.04, 0.35), 0, 0, 0.03, 0, 0.86},
      // Stone and dust [L].
      {"regolith", "stone and dust of an asteroid", {{0.13, 0.12, 0.11}, Rgb::Zero(), 1}, 0.10, 0.02, 0.10, 0, 0.88},
  };
  return kPresets;
}

}  // namespace

std::span<const Material> material_presets() { return presets(); }

const Material* material_preset(const std::string& name) {
  const auto found = std::find_if(presets().begin(), presets().end(), [&](const Material& preset) { return preset.name == name; });
  return found == presets().end() ? nullptr : &*found;
}

const Material& likely_material(const std::string& part) { return *material_preset(likely_material_name(part)); }

}  // namespace lasso::mdat
