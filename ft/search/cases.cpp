#include "ft/search/cases.hpp"

#include <cstdio>

#include "fsw/geometry/portable_math.hpp"
#include "ft/search/shapes.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/modelc/image_writer.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::search {
namespace {

using Target = Case::Target;

double extent(const mdat::Mesh& mesh) {
  Vec3 low = mesh.vertices[0], high = low;
  for (const auto& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return (high - low).maxCoeff();
}

}  // namespace

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  const auto next = [&](const char* name) -> Case& {
    cases.emplace_back().name = name;
    return cases.back();
  };
  next("clean");
  next("outliers").outliers = 0.1;
  next("dropouts").dropouts = 0.1;
  next("clip").range_high_m = 2.001;
  next("arrays").array_deg = 5;
  next("spin").spin_radps = 3 * kRadPerDeg;
  next("twofold").target = Target::kTwofold;
  next("cylinder").target = Target::kCylinder;
  next("sphere").target = Target::kSphere;
  next("panels").target = Target::kPanels;
  Case& absent = next("absent");
  absent.target = Target::kAbsent;
  absent.outliers = 0.3;
  Case& exact = next("exact512");
  exact.noise = false;
  exact.rays = 4096;
  exact.hits_only = true;
  return cases;
}

bool has_arrays(const std::string& file) {
  const mdat::MissionSource source = mdat::load_mission(file);
  return source.target.parameters.count("array_angle_deg") != 0;
}

Setting make_setting(const std::string& file, const Case& c, double scale) {
  mdat::MissionSource source = mdat::load_mission(file);
  mdat::Mesh model = mdat::load_target(source);
  if (c.array_deg != 0) source.target.parameters["array_angle_deg"] += c.array_deg;
  mdat::Mesh in_view = mdat::load_target(source);
  for (mdat::Mesh* mesh : {&model, &in_view}) {
    for (auto& v : mesh->vertices) v *= scale;
  }
  const double size = extent(model);
  if (c.target == Target::kCylinder) in_view = cylinder(0.45 * size, 0.16 * size);
  if (c.target == Target::kSphere) in_view = sphere(0.3 * size);
  if (c.target == Target::kPanels) in_view = panels(size);
  if (c.target == Target::kTwofold) model = in_view = twofold(model);
  mdat::ModelOptions options;
  options.cell_size_m = scale * source.target.cell_size_m;
  options.crease_angle_deg = source.target.crease_angle_rad / kRadPerDeg;
  mdat::CompileReport report;
  const mdat::ModelTables tables = mdat::compile_model(model, options, report);
  std::fprintf(stderr, "model: %zu elements, %zu views, %zu near-symmetries, search tables %zu bytes, compiled in %.1f s\n",
               report.elements, report.views, report.symmetries,
               4 * (tables[TableId::kDistances].size() + tables[TableId::kViews].size() + tables[TableId::kSymmetries].size()),
               report.seconds);
  MissionParameters parameters = source.parameters;
  parameters.initial_present = 0;
  return {parameters, mdat::write_image(1, 1, parameters, tables), in_view};
}

}  // namespace lasso::search
