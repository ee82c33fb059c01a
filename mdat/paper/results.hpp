// What the repeated experiments leave for programs (results.json) and say on the terminal.
#pragma once

#include <string>
#include <vector>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/paper/experiments.hpp"

namespace lasso::mdat {

// How a figure of the laboratory test is shown: in mm or degrees.
struct ShownFigure {
  LaboratoryFigure figure;
  const char *key, *title, *unit;
  double scale;  // from m or rad
  int digits;
};
constexpr ShownFigure kShownFigures[kLaboratoryFigures] = {
    {LaboratoryFigure::kZ, "z_mm", "Z against the truth", "mm", 1e3, 3},
    {LaboratoryFigure::kTurn, "turn_deg", "rotation about the axis against the truth", "deg", 1 / kRadPerDeg, 4},
    {LaboratoryFigure::kZStep, "z_step_mm", "Z against the stand before", "mm", 1e3, 3},
    {LaboratoryFigure::kTurnStep, "turn_step_deg", "rotation against the stand before", "deg", 1 / kRadPerDeg, 4}};

// A number of four decimals, or of two digits where they would not show it; "–" of what is not finite.
std::string small_number(double value);

// One line of the table that a person looks at first.
struct PaperRow {
  std::string what, unit;
  std::string paper;  // "0.53 ± 4.87"
  std::string here, noisy;
};
std::vector<PaperRow> paper_rows(const PaperResult& result);

// The tables for a terminal; the values for programs (docs/paper.md).
std::string paper_text(const PaperResult& result);
std::string paper_json(const PaperResult& result);

}  // namespace lasso::mdat
