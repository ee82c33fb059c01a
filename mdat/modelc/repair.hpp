// From a mesh as files have it to a surface that can be trusted: checked, welded, without degenerate or double triangles.
#pragma once

#include "mdat/modelc/mesh.hpp"
#include "mdat/modelc/model.hpp"
#include "mdat/modelc/surface.hpp"

namespace lasso::mdat {

constexpr double kExtentMin_m = 1e-3;
constexpr double kExtentMax_m = 1000;

// Throws CompileError for what cannot be repaired (see compile_model). Fills the report's repair counts and weld tolerance.
// A triangle given twice with opposite windings becomes one two-sided triangle.
Surface repair_mesh(const Mesh& mesh, double weld_tolerance_m, CompileReport& report);

}  // namespace lasso::mdat
