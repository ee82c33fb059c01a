// The model compiler: a triangle mesh becomes the reference model and look-up field of the flight image, exactly as image_format.hpp
// states them. Deterministic: the same mesh and options give the same words on one machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fsw/mission/image_format.hpp"
#include "mdat/modelc/compile_error.hpp"
#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

struct ModelOptions {
  double cell_size_m = 0;        // edge of a cell; 0: largest extent / 110
  double crease_angle_deg = 30;  // faces that meet at less than this are one smooth surface
  double weld_tolerance_m = 0;   // vertices closer than this are one; 0: 1e-6 of the largest extent
  double far_margin = 0.35;      // grid beyond the bounding box, as a share of the largest extent
  double near_band_m = 0;        // closest elements are known this far from the surface; 0: 5 cells
  bool oriented = false;         // triangles face outwards as given: nothing is turned, and nothing seen from behind
};

// Sizes of a set of lists.
struct ListStatistics {
  std::size_t count = 0;
  double mean = 0;
  std::size_t p99 = 0;
  std::size_t max = 0;
  bool operator==(const ListStatistics&) const = default;
};

struct CompileReport {
  // The mesh and what was repaired.
  std::size_t vertices = 0, triangles = 0;  // as given
  std::size_t welded_vertices = 0;          // merged into another one
  std::size_t unused_vertices = 0;
  std::size_t dropped_degenerate = 0;                             // triangles without area
  std::size_t dropped_duplicates = 0;                             // triangles given twice
  std::size_t components = 0;                                     // parts connected by edges of exactly two triangles
  std::size_t open_components = 0;                                // with a boundary, or not orientable
  std::size_t flipped_components = 0;                             // were inside out
  std::size_t flipped_triangles = 0;                              // turned so that they agree with their component, or with it
  std::size_t two_sided_components = 0, two_sided_triangles = 0;  // seen from both sides
  std::size_t hidden_components = 0;                              // no outside ray reaches them; kept
  std::size_t boundary_edges = 0, nonmanifold_edges = 0;
  // The result.
  std::size_t elements = 0, quads = 0, curved_elements = 0, edges = 0, hull_points = 0;
  std::size_t bricks = 0, ray_bricks = 0, near_bricks = 0;
  std::size_t views = 0, symmetries = 0;
  double symmetry_mismatch = 1;  // of the best: mean distance of the moved surface from the model over the truncation; 0: exactly itself
  ListStatistics ray_lists;      // over occupied cells
  std::size_t distinct_lists = 0;
  double cell_size_m = 0, near_band_m = 0, weld_tolerance_m = 0;
  int length_fraction_bits = 0;
  std::array<std::size_t, kTableCount + 1> table_bytes{};  // by TableId; kParameters is left 0
  std::size_t total_bytes = 0;
  double seconds = 0;
  bool operator==(const CompileReport&) const = default;
};

// The words of every table but kParameters, in the host's byte order.
struct ModelTables {
  std::array<std::vector<std::uint32_t>, kTableCount + 1> words;  // by TableId
  std::vector<std::uint32_t>& operator[](TableId id) { return words[static_cast<std::size_t>(id)]; }
  const std::vector<std::uint32_t>& operator[](TableId id) const { return words[static_cast<std::size_t>(id)]; }
};

// Called on entry to each stage and as it advances; fraction 0..1 of the whole.
using Progress = std::function<void(const std::string& stage, double fraction)>;

// Throws CompileError: empty mesh, vertex that is not finite, triangle that names a missing vertex, extent below 1 mm or above 1000 m
// (the scale is probably wrong), option out of range, cell list or table over a flight capacity (cfg/capacities.hpp).
ModelTables compile_model(const Mesh& mesh, const ModelOptions& options, CompileReport& report, const Progress& progress = {});

// Words of one record of a table.
std::uint32_t words_per_record(TableId id);

}  // namespace lasso::mdat
