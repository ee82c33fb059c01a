// The experiments of the 3DLASSO paper (2005), repeated; and what the paper says of them, as far as this project knows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mdat/paper/laboratory.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// Of the paper. Where it says how Z and its reference are formed, and whether means are of absolute values, is not known here.
struct PaperLaboratory {
  double z_mean_mm = 5.01, z_std_mm = 2.62;          // table 2
  double turn_mean_deg = 0.46, turn_std_deg = 0.24;  // of the rotation about the cylinder's axis, 15 degrees between stands
};
constexpr PaperLaboratory kPaperTable2;
struct PaperTime {
  double laptop_ms = 9.2;  // 1.6 GHz Pentium M
  double card_ms = 148;    // PowerPC 603e
};
constexpr PaperTime kPaperTime;

// A table or figure that the paper has: what it shows, where it is on this page, or that it is not known here.
struct PaperItem {
  std::string name, shows, here;
};
std::vector<PaperItem> paper_items();

struct PaperOptions {
  std::filesystem::path missions = "cfg/missions";  // folder of hubble_tenth.toml and laboratory.toml
  std::optional<std::uint32_t> frames;              // of each range of table 1, and at most as many of each stand
  LaboratoryOptions laboratory;
  unsigned jobs = 1;
  bool cached = true;  // compiled models
};

struct PaperResult {
  SimulationResult simulation;  // the paper's simulation without noise, and the same with noise: two variants of one table
  LaboratoryResult laboratory;
  std::string machine, commit;
  std::vector<std::string> warnings;
  double seconds = 0;
};

// Throws as mdat run does; InputError where a mission is missing.
PaperResult repeat_paper(const PaperOptions& options);

}  // namespace lasso::mdat
