// What a surface is made of, as light sees it.
#pragma once

#include <span>
#include <string>

#include "mdat/render/ggx.hpp"

namespace lasso::mdat {

// Lengths are shares of the target's largest side, so that a mock-up looks as what it stands for.
struct Material {
  const char* name;     // as --material has it
  const char* meaning;  // a few words
  Reflection reflection;
  double tilt_rad = 0;       // of facets that lean against the surface, root mean square of each of two axes; 0: flat
  double facet_size = 0;     // of the largest ones; smaller ones lie on them
  double contrast = 0;       // of the diffuse reflectance, from place to place
  double grid_pitch = 0;     // bright lines about solar cells; 0: none
  double solar_absorptance;  // of the source that is named beside the preset
};

// Of the lines of a cell grid: width as a share of the pitch, and diffuse reflectance.
constexpr double kGridLine = 0.05, kGridReflectance = 0.35;

// All presets; the first one is what a part has of which nothing is known.
std::span<const Material> material_presets();
// Null where there is none of the name.
const Material* material_preset(const std::string& name);

// What a part of this name is likely made of: "solar array +y" of solar cells, "bus" of MLI.
const Material& likely_material(const std::string& part);

}  // namespace lasso::mdat
