#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "cfg/capacities.hpp"
#include "mdat/modelc/hull.hpp"
#include "mdat/modelc/model.hpp"
#include "mdat/modelc/near_field.hpp"
#include "mdat/modelc/near_symmetry.hpp"
#include "mdat/modelc/outward.hpp"
#include "mdat/modelc/ray_field.hpp"
#include "mdat/modelc/repair.hpp"
#include "mdat/modelc/search_grid.hpp"
#include "mdat/modelc/silhouette_edges.hpp"
#include "mdat/modelc/view_table.hpp"

namespace lasso::mdat {
namespace {

constexpr double kCellsPerExtent = 110;
constexpr double kBandCells = 5;
constexpr int kCellTries = 4;              // sizes of automatic cells after the first
constexpr double kCellShrink = 0.75;       // from one to the next
constexpr std::size_t kHullPointsMin = 4;  // the loader expects a body

void check_range(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high)) fail("model option ", name, " is ", value, "; it must lie between ", low, " and ", high);
}

void check_options(const ModelOptions& options) {
  check_range("cell_size_m", options.cell_size_m, 0, kExtentMax_m);
  check_range("crease_angle_deg", options.crease_angle_deg, 0, 90);
  check_range("weld_tolerance_m", options.weld_tolerance_m, 0, 0.1);
  check_range("far_margin", options.far_margin, 0, 5);
  check_range("near_band_m", options.near_band_m, 0, kExtentMax_m);
}

// Before time is spent on a mesh of which no image has room: two triangles are one element at best.
void check_count(const Mesh& mesh) {
  constexpr std::size_t kMost = 2 * std::size_t{kMaxElements};
  if (mesh.triangles.size() > kMost)
    fail("the mesh has ", mesh.triangles.size(), " triangles; an image has room for ", kMost, " at most: ", kCoarserMesh);
}

Surface prepare_surface(const Mesh& mesh, const ModelOptions& options, CompileReport& report, const Progress& progress) {
  progress("repair the mesh", 0);
  Surface surface = repair_mesh(mesh, options.weld_tolerance_m, report);
  if (options.oriented) return surface;
  const Components components = orient_consistently(surface, report);
  progress("find the outside", 0.05);
  turn_outward(surface, components, report);
  return surface;
}

std::uint32_t length_word(const LengthScale& scale, double metres) { return static_cast<std::uint32_t>(scale.to_word(metres)); }

void append_point(std::vector<std::uint32_t>& words, const LengthScale& scale, const Vec3d& p) {
  for (int i = 0; i < 3; ++i) words.push_back(length_word(scale, p[i]));
}

std::vector<std::uint32_t> geometry_words(const Surface& surface, const Grid& grid, const LengthScale& scale, double band_m) {
  double radius = 0;
  for (const Vec3d& v : surface.vertices) radius = std::max(radius, v.norm());
  std::vector<std::uint32_t> words = {static_cast<std::uint32_t>(scale.bits())};
  append_point(words, scale, grid.origin);
  words.push_back(length_word(scale, grid.cell_m));
  words.insert(words.end(), grid.bricks.begin(), grid.bricks.end());
  words.push_back(length_word(scale, radius + scale.resolution_m()));
  append_point(words, scale, (surface.low + surface.high) / 2);
  words.push_back(length_word(scale, band_m));
  return words;
}

std::vector<std::uint32_t> hull_words(const Surface& surface, const LengthScale& scale, CompileReport& report) {
  std::vector<Vec3d> points = extreme_points(surface.vertices, surface.extent, kMaxHullPoints);
  while (points.size() < kHullPointsMin) points.push_back(points.back());  // a single triangle has but three
  report.hull_points = points.size();
  std::vector<std::uint32_t> words;
  for (const Vec3d& p : points) append_point(words, scale, p);
  return words;
}

void put_ray_field(RayField ray, ModelTables& tables) {
  for (const std::uint32_t word : ray.brick_words) {
    tables[TableId::kBricks].push_back(word);
    tables[TableId::kBricks].push_back(0);  // no near cells yet
  }
  tables[TableId::kRayCells] = std::move(ray.cells);
  tables[TableId::kRayLists] = std::move(ray.lists);
}

void put_near_field(NearField near, ModelTables& tables) {
  for (std::size_t i = 0; i < near.brick_words.size(); ++i) tables[TableId::kBricks][kBrickWords * i + 1] = near.brick_words[i];
  tables[TableId::kNearCells] = std::move(near.cells);
  tables[TableId::kFootPoints] = std::move(near.foot_points);
}

// Also asked half-way, before time is spent on a model that cannot fit.
void put_sizes(const ModelTables& tables, CompileReport& report) {
  report.total_bytes = 0;
  for (std::size_t id = 0; id < tables.words.size(); ++id) {
    report.table_bytes[id] = 4 * tables.words[id].size();
    report.total_bytes += report.table_bytes[id];
  }
  if (report.total_bytes <= kMaxImageBytes) return;
  fail<LargeFieldError>("the tables need ", report.total_bytes, " bytes (elements ",
                        report.table_bytes[static_cast<std::size_t>(TableId::kElements)], ", ray cells ",
                        report.table_bytes[static_cast<std::size_t>(TableId::kRayCells)], ", lists ",
                        report.table_bytes[static_cast<std::size_t>(TableId::kRayLists)], ", near cells ",
                        report.table_bytes[static_cast<std::size_t>(TableId::kNearCells)], ", edges ",
                        report.table_bytes[static_cast<std::size_t>(TableId::kEdges)], "); the limit of an image is ", kMaxImageBytes,
                        ": take larger cells, or ", kCoarserMesh);
}

struct GriddedField {
  Grid grid;
  RayField ray;
};

// With automatic cells, smaller ones are tried where the mesh is too dense for the first.
GriddedField make_gridded_field(const Surface& surface, const std::vector<Element>& elements, const LengthScale& scale, double margin_m,
                                double cell_m, int tries, CompileReport& report) {
  for (;; --tries, cell_m *= kCellShrink) {
    const Grid grid = make_grid(surface, margin_m, cell_m, scale);
    try {
      return {grid, make_ray_field(elements, grid, report)};
    } catch (const CrowdedCellError&) {
      if (tries <= 0) throw;
    }
  }
}

void put_search(const Surface& surface, const std::vector<Element>& elements, const LengthScale& scale, ModelTables& tables,
                CompileReport& report) {
  const NearestSearch nearest(elements);
  const SearchGrid grid = make_search_grid(surface, nearest, scale);
  const std::vector<View> views = make_views(surface);
  const std::vector<NearSymmetryMotion> symmetries = find_near_symmetries(views, grid, nearest);
  tables[TableId::kSearchGrid] = geometry_words(grid, scale);
  tables[TableId::kDistances] = distance_words(grid);
  tables[TableId::kViews] = view_words(views, scale);
  tables[TableId::kSymmetries] = symmetry_words(symmetries, scale);
  report.views = views.size();
  report.symmetries = symmetries.size();
  if (!symmetries.empty()) report.symmetry_mismatch = symmetries.front().mismatch;
}

ModelTables make_tables(const Surface& surface, const ModelOptions& options, CompileReport& report, const Progress& progress) {
  progress("make elements", 0.2);
  const std::vector<EdgeUse> uses = edge_uses(surface);
  const auto normals = smooth_normals(surface, options.crease_angle_deg * std::numbers::pi / 180);
  const Polygons polygons = make_polygons(surface, uses, normals);
  const double cell_m = options.cell_size_m > 0 ? options.cell_size_m : surface.extent / kCellsPerExtent;
  const double margin_m = options.far_margin * surface.extent;
  const LengthScale scale(image_reach_m(surface, margin_m, cell_m));
  const double band_m = scale.round(options.near_band_m > 0 ? options.near_band_m : kBandCells * cell_m);
  ElementSet elements = make_elements(polygons.list, scale, surface.extent, report);
  report.near_band_m = band_m;
  report.length_fraction_bits = scale.bits();

  ModelTables tables;
  tables[TableId::kEdges] = make_edges(surface, uses, polygons, elements.list, scale, report);
  progress("list the elements of each cell", 0.3);
  GriddedField field =
      make_gridded_field(surface, elements.list, scale, margin_m, cell_m, options.cell_size_m > 0 ? 0 : kCellTries, report);
  const Grid& grid = field.grid;
  report.cell_size_m = grid.cell_m;
  put_ray_field(std::move(field.ray), tables);
  tables[TableId::kElements] = std::move(elements.words);
  tables[TableId::kCurvatures] = std::move(elements.curvature_words);
  put_sizes(tables, report);
  progress("find closest elements", 0.6);
  put_near_field(make_near_field(elements.list, grid, scale, band_m, report), tables);
  progress("look from all sides", 0.85);
  put_search(surface, elements.list, scale, tables, report);
  tables[TableId::kFieldGeometry] = geometry_words(surface, grid, scale, band_m);
  tables[TableId::kHull] = hull_words(surface, scale, report);
  return tables;
}

}  // namespace

ModelTables compile_model(const Mesh& mesh, const ModelOptions& options, CompileReport& report, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const Progress tell = progress ? progress : [](const std::string&, double) {};
  report = {};
  check_options(options);
  check_count(mesh);
  const Surface surface = prepare_surface(mesh, options, report, tell);
  ModelTables tables = make_tables(surface, options, report, tell);
  put_sizes(tables, report);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  tell("done", 1);
  return tables;
}

std::uint32_t words_per_record(TableId id) {
  switch (id) {
    case TableId::kParameters:
      return 2;
    case TableId::kFieldGeometry:
      return kFieldGeometryWords;
    case TableId::kElements:
      return kElementWords;
    case TableId::kCurvatures:
      return kCurvatureWords;
    case TableId::kBricks:
      return kBrickWords;
    case TableId::kRayCells:
      return kRayCellsPerBrick;
    case TableId::kRayLists:
      return 1;
    case TableId::kNearCells:
      return kNearWordsPerBrick;
    case TableId::kFootPoints:
      return kFootWords;
    case TableId::kEdges:
      return kEdgeWords;
    case TableId::kHull:
      return 3;
    case TableId::kSearchGrid:
      return kSearchGridWords;
    case TableId::kDistances:
      return 1;
    case TableId::kViews:
      return kViewWords;
    case TableId::kSymmetries:
      return kSymmetryWords;
    case TableId::kParts:
      return kPartWords;
    case TableId::kPartImages:
      return 1;
    case TableId::kSensors:
      return kSensorWords;
    case TableId::kCalibrations:
      return kCalibrationWords;
    case TableId::kNamedFrames:
      return kNamedFrameWords;
  }
  return 1;
}

}  // namespace lasso::mdat
