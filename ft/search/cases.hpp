// The cases of `make campaign WHAT=search`: what is in view, and how it is seen.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fsw/mission/parameters.hpp"
#include "mdat/modelc/mesh.hpp"

namespace lasso::search {

// What is asked of the search.
struct Case {
  std::string name;
  double range_low_m = 2, range_high_m = 7;
  double outliers = 0, dropouts = 0, array_deg = 0, spin_radps = 0;
  bool noise = true;
  bool hits_only = false;  // the first 512 returns, as of a point cloud
  std::uint16_t rays = 1024;
  enum class Target { kModel, kAbsent, kCylinder, kSphere, kPanels, kTwofold } target = Target::kModel;
  bool may_accept() const { return target == Target::kModel; }
};

std::vector<Case> all_cases();

struct Setting {
  MissionParameters parameters{};
  std::vector<std::uint8_t> image;
  mdat::Mesh in_view;
};

// Is this mission's model one whose arrays can be turned?
bool has_arrays(const std::string& file);

// The mission's model, `scale` times as large, and what is in view of the case. Says on stderr what was compiled.
Setting make_setting(const std::string& file, const Case& c, double scale);

}  // namespace lasso::search
