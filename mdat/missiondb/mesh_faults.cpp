#include "mdat/missiondb/mesh_faults.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mdat/modelc/outward.hpp"
#include "mdat/modelc/repair.hpp"
#include "mdat/modelc/topology.hpp"
#include "mdat/source/mission_error.hpp"

namespace lasso::mdat {
namespace {

constexpr double kSheet = 0.5;          // opening over surface: more is a sheet or a dish
constexpr double kCracks = 0.01;        // of the surface: where less is seen from behind, hardly a ray goes in
constexpr std::size_t kAsked = 20'000;  // triangles: bounds the time, whatever the mesh

void count_edges(const Surface& surface, MeshFaults& faults) {
  for_each_edge(edge_uses(surface), [&](const EdgeUse* first, const EdgeUse* last) {
    const auto uses = last - first;
    faults.open_edges += uses == 1;
    faults.crowded_edges += uses > 2;
    faults.opposite_pairs += uses == 2 && first[0].forward == first[1].forward;
  });
}

Vec3d twice_area(const Surface& surface, std::size_t t) {
  return (surface.corner(t, 1) - surface.corner(t, 0)).cross(surface.corner(t, 2) - surface.corner(t, 0));
}

// Components that enclose little. Of a surface whose triangles agree, the sum of areas along the normals is that of its openings (Stokes);
// of a flat sheet it is as large as the surface, of half a sphere half as large, of a box without one of its faces less.
std::vector<bool> sheets_of(const Surface& surface, const Components& components) {
  std::vector<Vec3d> opening(components.count(), Vec3d::Zero());
  std::vector<double> area(components.count(), 0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Vec3d twice = twice_area(surface, t);
    opening[components.of_triangle[t]] += twice;
    area[components.of_triangle[t]] += twice.norm();
  }
  std::vector<bool> sheets;
  for (std::size_t c = 0; c < area.size(); ++c) sheets.push_back(opening[c].norm() > kSheet * area[c]);
  return sheets;
}

std::size_t hole_edges_of(const Surface& surface, const Components& components, const std::vector<bool>& sheets) {
  std::size_t count = 0;
  for_each_edge(edge_uses(surface), [&](const EdgeUse* first, const EdgeUse* last) {
    count += last - first == 1 && !sheets[components.of_triangle[first->triangle]];
  });
  return count;
}

// What each triangle stands for: its area, or, of many, how many of kAsked equal shares of the area begin in it.
std::vector<double> weights_of(const Surface& surface) {
  std::vector<double> weights;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) weights.push_back(twice_area(surface, t).norm());
  if (weights.size() <= kAsked) return weights;
  const double share = std::accumulate(weights.begin(), weights.end(), 0.0) / static_cast<double>(kAsked);
  double before = 0;
  for (double& weight : weights) {
    const double after = before + weight;
    weight = std::floor(after / share) - std::floor(before / share);
    before = after;
  }
  return weights;
}

// The compiler's own judgement of what light from far away reaches.
void look_behind(Surface surface, MeshFaults& faults) {
  CompileReport ignored;
  const Components components = orient_consistently(surface, ignored);
  const std::vector<bool> sheets = sheets_of(surface, components);
  faults.hole_edges = hole_edges_of(surface, components, sheets);
  const std::vector<double> weights = weights_of(surface);
  std::fill(surface.two_sided.begin(), surface.two_sided.end(), std::uint8_t{0});  // what is given twice is no hole
  turn_outward(surface, components, ignored, weights);
  double whole = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    whole += weights[t];
    if (surface.two_sided[t] != 0) (sheets[components.of_triangle[t]] ? faults.sheets : faults.seen_behind) += weights[t];
  }
  for (double* share : {&faults.sheets, &faults.seen_behind}) *share = *share < kCracks * whole ? 0 : *share / whole;
}

// "1 edge belongs", "2 edges belong".
std::string counted(std::size_t count, const char* one, const char* more) {
  return std::to_string(count) + ' ' + (count == 1 ? one : more);
}

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " % of the surface "; }

std::string open_text(const MeshFaults& faults) {
  if (faults.seen_behind == 0) return "";
  const bool parted = faults.hole_edges == 0;  // where more than two triangles meet, the piece ends without an edge of its own
  const std::string where = parted ? "" : counted(faults.hole_edges, "edge belongs", "edges belong") + " to one triangle, and ";
  return "open: " + where + percent(faults.seen_behind) +
         "is seen from behind: rays go in where it ends; a target that is closed there does not fit: close the mesh; a thin sheet, dish, "
         "tube or nozzle, which is open on the target, too, may stay as it is";
}

std::string sheets_text(const MeshFaults& faults) {
  if (faults.sheets == 0) return "";
  return "sheets: " + percent(faults.sheets) +
         "is of sheets or dishes, open and seen from both sides: solar panels and antennas may stay so; the shell of a body that is closed "
         "on the target does not fit: close the mesh";
}

std::string crowded_text(const MeshFaults& faults) {
  if (faults.crowded_edges == 0) return "";
  return "edges: " + counted(faults.crowded_edges, "belongs", "belong") +
         " to more than two triangles: the surface is taken apart there, each piece turned outwards by itself; poses are as good; a union "
         "of the solids without inner walls has none";
}

std::string winding_text(const MeshFaults& faults) {
  if (faults.opposite_pairs == 0) return "";
  return "winding: " + counted(faults.opposite_pairs, "pair of neighbours is", "pairs of neighbours are") +
         " wound against each other: triangles are turned until they agree, and face outwards; poses are as good; to cut parts out of the "
         "target (box_m), let its program make the normals consistent, as the inside of a part is seen otherwise";
}

std::string triangles_text(const MeshFaults& faults) {
  if (faults.degenerate + faults.duplicates == 0) return "";
  return "triangles: " + std::to_string(faults.degenerate) + " without area and " + std::to_string(faults.duplicates) +
         " given twice are left out: poses are as good; the clean-up of any modelling program takes them out of the file";
}

}  // namespace

MeshFaults mesh_faults(const Mesh& mesh) {
  CompileReport report;
  const Surface surface = repair_mesh(mesh, 0, report);
  MeshFaults faults;
  faults.degenerate = report.dropped_degenerate;
  faults.duplicates = report.dropped_duplicates;
  count_edges(surface, faults);
  if (faults.open_edges > 0) look_behind(surface, faults);
  return faults;
}

std::vector<MeshRemark> mesh_remarks(const MeshFaults& faults) {
  std::vector<MeshRemark> remarks = {{true, open_text(faults)},
                                     {false, sheets_text(faults)},
                                     {false, crowded_text(faults)},
                                     {false, winding_text(faults)},
                                     {false, triangles_text(faults)}};
  std::erase_if(remarks, [](const MeshRemark& remark) { return remark.text.empty(); });
  return remarks;
}

std::vector<MeshRemark> mesh_remarks(const std::filesystem::path& file, const Mesh& mesh, bool parametric) {
  try {
    std::vector<MeshRemark> remarks = mesh_remarks(mesh_faults(mesh));
    if (parametric) std::erase_if(remarks, [](const MeshRemark& remark) { return !remark.follows; });
    return remarks;
  } catch (const CompileError& error) {
    throw MissionError({file.string(), 0, 0, "", "", std::string("the mesh cannot be compiled: ") + error.what()});
  }
}

}  // namespace lasso::mdat
