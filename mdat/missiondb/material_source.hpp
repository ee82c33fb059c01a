// What parts are made of, as a mission says it: pictures and lasers need it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lasso::mdat {

// Names of the presets, which mdat/render/material.cpp and laser_material.cpp fill.
inline constexpr std::array kMaterialNames = {"white-paint", "silver-teflon",  "aluminium-foil", "mli",
                                              "solar-cells", "black-anodised", "regolith"};

// [material.NAME]. What is not said is the preset's.
struct MaterialSource {
  std::string name, preset;
  std::vector<std::string> parts;         // of the target, or NODE.PART; * at the end stands for any ending
  std::vector<double> diffuse, specular;  // red, green, blue; both, or the preset's
  std::optional<double> roughness, tilt_rad;
  std::optional<double> laser, laser_specular, laser_roughness;  // hal_sim/laser_reflection.hpp
};

}  // namespace lasso::mdat
