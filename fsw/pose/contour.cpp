#include "fsw/pose/contour.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using Length = N::Length;
using Ratio = N::Ratio;

// Which side of the edge's face the sensor is on.
bool faces(const Length* origin, const N::Unit* n, Length d) { return dot3<N>(n, origin) > d; }

bool project_edge(const PathPose<N>& pose, const ModelEdge<N>& edge, ContourEdge<N>& out) {
  const ImagePoint a = project(pose, edge.a);
  const ImagePoint b = project(pose, edge.b);
  if (!(a.z > 0) || !(b.z > 0)) return false;
  out.x = a.x;
  out.y = a.y;
  out.dx = b.x - a.x;
  out.dy = b.y - a.y;
  const Ratio length2 = out.dx * out.dx + out.dy * out.dy;
  out.inverse_length2 = length2 > 0 ? 1 / length2 : 0;
  out.za = a.z;
  out.zb = b.z;
  return true;
}

struct Extent {
  Ratio low, high;
  void include(Ratio v) {
    if (v < low) low = v;
    if (v > high) high = v;
  }
};

int clamp_bin(Ratio v) {
  if (!(v > 0)) return 0;
  return v < static_cast<Ratio>(kRayBins) ? static_cast<int>(v) : kRayBins - 1;
}

std::size_t bin_of(const RayBins<N>& bins, std::size_t ray) {
  const int column = clamp_bin((bins.x[ray] - bins.x0) * bins.bins_per_x);
  const int row = clamp_bin((bins.y[ray] - bins.y0) * bins.bins_per_y);
  return static_cast<std::size_t>(row) * kRayBins + static_cast<std::size_t>(column);
}

// Where the rays pass at the target's depth, and the rectangle that they fill.
void place_rays(const View<N>& view, const Workspace& workspace, RayBins<N>& bins) {
  Extent x{1e30F, -1e30F};
  Extent y{1e30F, -1e30F};
  for (std::size_t i = 0; i < workspace.rays.size(); ++i) {
    const ScanRay<N>& ray = workspace.rays.begin()[i];
    const Ratio inverse = 1 / (ray.o[2] + view.target_depth * ray.u[2]);
    bins.x[i] = (ray.o[0] + view.target_depth * ray.u[0]) * inverse;
    bins.y[i] = (ray.o[1] + view.target_depth * ray.u[1]) * inverse;
    x.include(bins.x[i]);
    y.include(bins.y[i]);
  }
  const auto across = static_cast<Ratio>(kRayBins);
  bins.x0 = x.low;
  bins.y0 = y.low;
  bins.bins_per_x = x.high > x.low ? across / (x.high - x.low) : 0;
  bins.bins_per_y = y.high > y.low ? across / (y.high - y.low) : 0;
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

void insert_edge(std::uint32_t contour, Ratio distance2, Ratio along, RayEdges<N>& edges) {
  if (edges.count == kEdgesPerRay && distance2 >= edges.distance2[kEdgesPerRay - 1]) return;
  std::uint32_t place = edges.count < kEdgesPerRay ? edges.count++ : static_cast<std::uint32_t>(kEdgesPerRay - 1);
  for (; place > 0 && edges.distance2[place - 1] > distance2; --place) {
    edges.contour[place] = edges.contour[place - 1];
    edges.distance2[place] = edges.distance2[place - 1];
    edges.along[place] = edges.along[place - 1];
  }
  edges.contour[place] = contour;
  edges.distance2[place] = distance2;
  edges.along[place] = along;
}

Ratio clamp_unit(Ratio t) { return !(t > 0) ? 0 : t < 1 ? t : 1; }

void test_ray(const ContourEdge<N>& edge, std::uint32_t contour, std::size_t ray, Ratio band2, Workspace& workspace) {
  const Ratio rx = workspace.bins.x[ray] - edge.x;
  const Ratio ry = workspace.bins.y[ray] - edge.y;
  const Ratio along = clamp_unit((rx * edge.dx + ry * edge.dy) * edge.inverse_length2);
  const Ratio ex = rx - along * edge.dx;
  const Ratio ey = ry - along * edge.dy;
  const Length z = edge.za + along * (edge.zb - edge.za);
  const Ratio distance2 = (ex * ex + ey * ey) * z * z;
  if (distance2 < band2) insert_edge(contour, distance2, along, workspace.ray_edges[ray]);
}

struct BinRange {
  int low, high;
};

BinRange bins_between(Ratio a, Ratio b, Ratio band, Ratio origin, Ratio per_unit) {
  const Ratio low = (a < b ? a : b) - band;
  const Ratio high = (a < b ? b : a) + band;
  return {clamp_bin((low - origin) * per_unit), clamp_bin((high - origin) * per_unit)};
}

void test_edge(std::uint32_t contour, Ratio band, Workspace& workspace) {
  const ContourEdge<N>& edge = workspace.contour.begin()[contour];
  const RayBins<N>& bins = workspace.bins;
  const Ratio image_band = band / (edge.za < edge.zb ? edge.za : edge.zb);
  const BinRange columns = bins_between(edge.x, edge.x + edge.dx, image_band, bins.x0, bins.bins_per_x);
  const BinRange rows = bins_between(edge.y, edge.y + edge.dy, image_band, bins.y0, bins.bins_per_y);
  for (int row = rows.low; row <= rows.high; ++row) {
    const int first = row * kRayBins + columns.low;
    const int end = row * kRayBins + columns.high + 1;
    // NOLINTNEXTLINE(clang-analyzer-security.ArrayBound): clamp_bin ends at kRayBins - 1; the analyser does not see it
    for (std::uint32_t k = bins.start[first]; k < bins.start[end]; ++k) test_ray(edge, contour, bins.ray[k], band * band, workspace);
  }
}

}  // namespace

ImagePoint project(const PathPose<N>& pose, const Length* p_target) {
  const Length q[3] = {p_target[0] - pose.t[0], p_target[1] - pose.t[1], p_target[2] - pose.t[2]};
  Length s[3];
  for (int i = 0; i < 3; ++i) s[i] = pose.R[0][i] * q[0] + pose.R[1][i] * q[1] + pose.R[2][i] * q[2];
  if (!(s[2] > 0)) return {0, 0, 0};
  const Ratio inverse = 1 / s[2];
  return {s[0] * inverse, s[1] * inverse, s[2]};
}

View<FlightNumber> make_view(const Mission& mission, const Pose& T_target_sensor) {
  View<N> view{};
  view.pose = to_path<N>(T_target_sensor);
  const Vec3 center_sensor = inverse(T_target_sensor) * mission.center_m;
  view.target_depth = N::to_length(center_sensor[2]);
  return view;
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

void find_ray_edges(const View<FlightNumber>& view, double band_m, Workspace& workspace) {
  for (std::size_t i = 0; i < workspace.rays.size(); ++i) workspace.ray_edges[i].count = 0;
  if (!(view.target_depth > 0)) return;
  place_rays(view, workspace, workspace.bins);
  sort_rays(workspace.rays.size(), workspace.bins);
  const Ratio band = N::to_length(band_m);
  for (std::size_t i = 0; i < workspace.contour.size(); ++i) test_edge(static_cast<std::uint32_t>(i), band, workspace);
}

}  // namespace lasso
