#include "fsw/pose/silhouette/contour.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using Length = N::Length;
using Tangent = N::Tangent;

// Which side of the edge's face the sensor is on.
bool faces(const Length* origin, const N::Unit* n, Length d) { return d < dot3<N>(n, origin); }

bool project_edge(const PathPose<N>& pose, const ModelEdge<N>& edge, ContourEdge<N>& out) {
  const ImagePoint a = project(pose, edge.a);
  const ImagePoint b = project(pose, edge.b);
  if (!(a.z > Length{0}) || !(b.z > Length{0})) return false;
  out.x = a.x;
  out.y = a.y;
  out.dx = b.x - a.x;
  out.dy = b.y - a.y;
  out.length = inverse_length2(out.dx * out.dx + out.dy * out.dy);
  out.za = a.z;
  out.zb = b.z;
  return true;
}

struct Extent {
  Tangent low, high;
  void include(Tangent v) {
    if (v < low) low = v;
    if (v > high) high = v;
  }
};

// The bin of a place that is this far from the first one's beginning; those beyond belong to the outermost.
int bin_at(Tangent offset, N::BinRate bins_per_unit) {
  if (!(offset > Tangent{0})) return 0;
  return N::index_below(kRayBins, offset * bins_per_unit);
}

std::size_t bin_of(const RayBins<N>& bins, std::size_t ray) {
  const int column = bin_at(bins.x[ray] - bins.x0, bins.bins_per_x);
  const int row = bin_at(bins.y[ray] - bins.y0, bins.bins_per_y);
  return static_cast<std::size_t>(row) * kRayBins + static_cast<std::size_t>(column);
}

// Where the rays pass at the target's depth, and the rectangle that they fill.
void place_rays(const View<N>& view, const Workspace& workspace, RayBins<N>& bins) {
  constexpr auto kEndless = N::to<Tangent>(1e30);
  Extent x{kEndless, -kEndless};
  Extent y = x;
  for (std::size_t i = 0; i < workspace.rays.size(); ++i) {
    const ScanRay<N>& ray = workspace.rays.begin()[i];
    Length p[3];
    for (int k = 0; k < 3; ++k) p[k] = ray.o[k] + view.target_depth * ray.u[k];
    const auto inverse = inverse_of(p[2]);
    bins.x[i] = bounded<Tangent>(over<Tangent>(p[0], inverse));
    bins.y[i] = bounded<Tangent>(over<Tangent>(p[1], inverse));
    x.include(bins.x[i]);
    y.include(bins.y[i]);
  }
  const auto rate = [](const Extent& e) {
    constexpr auto kBins = N::to<Tangent>(kRayBins);
    return e.high > e.low ? quotient<N::BinRate>(kBins, e.high - e.low) : N::BinRate{0};
  };
  bins.x0 = x.low;
  bins.y0 = y.low;
  bins.bins_per_x = rate(x);
  bins.bins_per_y = rate(y);
}

// Counting sort of the rays by bin: start[b]..start[b+1] index ray[].
void sort_rays(std::size_t count, RayBins<N>& bins) {
  constexpr std::size_t kBins = std::size_t{kRayBins} * kRayBins;
  for (std::size_t b = 0; b <= kBins; ++b) bins.start[b] = 0;
  for (std::size_t i = 0; i < count; ++i) ++bins.start[bin_of(bins, i) + 1];
  for (std::size_t b = 0; b < kBins; ++b) bins.start[b + 1] = static_cast<std::uint16_t>(bins.start[b + 1] + bins.start[b]);
  for (std::size_t i = count; i > 0; --i) {  // fills each bin from its end, using start[b + 1] as cursor
    const std::size_t b = bin_of(bins, i - 1);
    bins.ray[--bins.start[b + 1]] = static_cast<std::uint16_t>(i - 1);
  }
  for (std::size_t b = 0; b < kBins; ++b) bins.start[b] = bins.start[b + 1];  // the cursors ended at the bins' starts
  bins.start[kBins] = static_cast<std::uint16_t>(count);
}

void insert_edge(std::uint32_t contour, N::Area distance2, N::Unit along, RayEdges<N>& edges) {
  if (edges.count == kEdgesPerRay && !(distance2 < edges.distance2[kEdgesPerRay - 1])) return;
  std::uint32_t place = edges.count < kEdgesPerRay ? edges.count++ : static_cast<std::uint32_t>(kEdgesPerRay - 1);
  for (; place > 0 && distance2 < edges.distance2[place - 1]; --place) {
    edges.contour[place] = edges.contour[place - 1];
    edges.distance2[place] = edges.distance2[place - 1];
    edges.along[place] = edges.along[place - 1];
  }
  edges.contour[place] = contour;
  edges.distance2[place] = distance2;
  edges.along[place] = along;
}

struct EdgeFoot {
  N::Unit along;
  N::Area distance2;
};

// The edge's closest point to the ray.
EdgeFoot foot_of(const ContourEdge<N>& edge, const RayBins<N>& bins, std::size_t ray) {
  const Tangent rx = bins.x[ray] - edge.x;
  const Tangent ry = bins.y[ray] - edge.y;
  const N::Unit along = share_along(rx * edge.dx + ry * edge.dy, edge.length);
  const Tangent ex = rx - along * edge.dx;
  const Tangent ey = ry - along * edge.dy;
  const Length z = edge.za + along * (edge.zb - edge.za);
  return {along, N::area_at(ex, ey, z)};
}

struct BinRange {
  int low, high;
};

BinRange bins_between(Tangent a, Tangent b, Tangent band, Tangent origin, N::BinRate per_unit) {
  const Tangent low = (a < b ? a : b) - band;
  const Tangent high = (a < b ? b : a) + band;
  return {bin_at(low - origin, per_unit), bin_at(high - origin, per_unit)};
}

// Visits the rays in the bins that the edge's band touches.
template <class Visit>
void visit_rays(const ContourEdge<N>& edge, Length band, const RayBins<N>& bins, const Visit& visit) {
  const auto image_band = bounded<Tangent>(quotient<Tangent>(band, edge.za < edge.zb ? edge.za : edge.zb));
  const BinRange columns = bins_between(edge.x, edge.x + edge.dx, image_band, bins.x0, bins.bins_per_x);
  const BinRange rows = bins_between(edge.y, edge.y + edge.dy, image_band, bins.y0, bins.bins_per_y);
  for (int row = rows.low; row <= rows.high; ++row) {
    const int first = row * kRayBins + columns.low;
    const int end = row * kRayBins + columns.high + 1;
    // NOLINTNEXTLINE(clang-analyzer-security.ArrayBound): bin_at ends at kRayBins - 1; the analyser does not see it
    for (std::uint32_t k = bins.start[first]; k < bins.start[end]; ++k) visit(bins.ray[k]);
  }
}

// Without rays, or with the target behind the sensor, there are none.
bool fill_bins(const View<N>& view, Workspace& workspace) {
  if (workspace.rays.empty() || !(view.target_depth > Length{0})) return false;
  place_rays(view, workspace, workspace.bins);
  sort_rays(workspace.rays.size(), workspace.bins);
  return true;
}

}  // namespace

ImagePoint project(const PathPose<N>& pose, const Length* p_target) {
  const Length q[3] = {p_target[0] - pose.t[0], p_target[1] - pose.t[1], p_target[2] - pose.t[2]};
  Length s[3];
  for (int i = 0; i < 3; ++i) s[i] = pose.R[0][i] * q[0] + pose.R[1][i] * q[1] + pose.R[2][i] * q[2];
  if (!(s[2] > Length{0})) return {Tangent{0}, Tangent{0}, Length{0}};
  const auto inverse = inverse_of(s[2]);
  return {bounded<Tangent>(over<Tangent>(s[0], inverse)), bounded<Tangent>(over<Tangent>(s[1], inverse)), s[2]};
}

void find_contour(const Mission& mission, const View<FlightNumber>& view, Workspace& workspace) {
  workspace.contour.clear();
  for (std::size_t i = 0; i < mission.edges.size(); ++i) {
    const ModelEdge<N>& edge = mission.edges.data()[i];
    if (faces(view.pose.t, edge.n0, edge.d0) == faces(view.pose.t, edge.n1, edge.d1)) continue;
    ContourEdge<N> contour{};
    contour.edge = static_cast<std::uint32_t>(i);
    if (project_edge(view.pose, edge, contour) && !workspace.contour.push_back(contour)) return;
  }
}

void find_ray_edges(const View<FlightNumber>& view, Length band, Workspace& workspace) {
  for (std::size_t i = 0; i < workspace.rays.size(); ++i) workspace.ray_edges[i].count = 0;
  if (!fill_bins(view, workspace)) return;
  for (std::uint32_t i = 0; i < workspace.contour.size(); ++i) {
    const ContourEdge<N>& edge = workspace.contour.begin()[i];
    visit_rays(edge, band, workspace.bins, [&](std::size_t ray) {
      const EdgeFoot foot = foot_of(edge, workspace.bins, ray);
      if (foot.distance2 < band * band) insert_edge(i, foot.distance2, foot.along, workspace.ray_edges[ray]);
    });
  }
}

void find_rays_near_contour(const View<FlightNumber>& view, Length band, Workspace& workspace) {
  for (std::size_t i = 0; i < workspace.rays.size(); ++i) workspace.near_contour[i] = false;
  if (!fill_bins(view, workspace)) return;
  for (const ContourEdge<N>& edge : workspace.contour) {
    visit_rays(edge, band, workspace.bins, [&](std::size_t ray) {
      bool& near = workspace.near_contour[ray];
      near = near || foot_of(edge, workspace.bins, ray).distance2 < band * band;
    });
  }
}

}  // namespace lasso
