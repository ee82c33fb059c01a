#include "fsw/pose/silhouette/silhouette.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/silhouette/contour.hpp"
#include "fsw/pose/silhouette/contour_probe.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using Length = N::Length;

constexpr double kCertain2 = 36;         // labels that the pose makes certain to six sigma carry nothing
constexpr double kConsistentDepths = 4;  // a return belongs to a contour's near or far side within this many edge depths
constexpr double kConsistentSigmas = 6;
constexpr double kCornerCosine = 0.3;  // beyond an edge's end the contour turns at most this sharply

// A ray's line in the target frame.
struct Line {
  Vec3 origin, u;
};

Line to_line(const View<N>& view, const ScanRay<N>& ray) {
  Length o[3];
  N::Unit u[3];
  transform(view.pose, ray.o, o);
  rotate(view.pose, ray.u, u);
  return {to_vec3(o), to_vec3(u)};
}

struct EdgePlace {
  Vec3 point;             // on the edge, closest to the ray in the image
  Vec3 confirm;           // where it is probed: not at the very end of the edge
  Vec3 across;            // unit, across edge and ray
  bool interior = false;  // the closest point is not an end
  bool usable = false;
};

EdgePlace place_on_edge(const ModelEdge<N>& model, const ContourEdge<N>& contour, double along, const Line& line) {
  EdgePlace place;
  const Vec3 a = to_vec3(model.a);
  const Vec3 ab = to_vec3(model.b) - a;
  const double t = along_in_space(contour, along);
  const Vec3 normal = ab.cross(line.u);
  const double length2 = normal.squaredNorm();
  if (!(length2 > 1e-12 * ab.squaredNorm())) return place;
  place.point = a + t * ab;
  place.confirm = a + clamp(t, 0.02, 0.98) * ab;
  place.across = normal * (1 / square_root(length2));
  place.interior = along > 0 && along < 1;
  place.usable = true;
  return place;
}

// Distance of the ray inside the contour and its change with the pose: s = d + a.x, d > 0 inside. False where the contour turns away.
bool measure(const EdgePlace& place, const ContourPoint& contour, const Line& line, Label& label) {
  const Vec3 nearest = line.origin + (place.point - line.origin).dot(line.u) * line.u;
  Vec3 outward = contour.outward;
  label.d_m = outward.dot(place.point - nearest);
  if (!place.interior) {  // beyond an end the contour is taken as the corner itself
    const Vec3 w = place.point - nearest;
    const double length = square_root(w.squaredNorm());
    if (length > 1e-9) {
      const double cosine = w.dot(outward) / length;
      if (cosine < kCornerCosine && cosine > -kCornerCosine) return false;
      const double side = cosine > 0 ? 1 : -1;
      outward = w * (side / length);
      label.d_m = side * length;
    }
  }
  label.a.head<3>() = -nearest.cross(outward);
  label.a.tail<3>() = -outward;
  return true;
}

// +1 inside, -1 outside, 0 no statement.
int side_of(const ScanRay<N>& ray, const ContourPoint& contour, const LabelSearch& search, double depth_m) {
  const double weakly_observable = kConsistentDepths * depth_m + kConsistentSigmas * search.range_sigma_m;
  const double range = N::to_double(ray.range);
  if (ray.state == RayState::kMiss) return contour.kind == ContourKind::kOuter && search.misses_known ? -1 : 0;
  const bool near_edge = range > contour.range_m - weakly_observable && range < contour.range_m + weakly_observable;
  if (contour.kind == ContourKind::kOuter) return near_edge && search.misses_known ? 1 : 0;
  if (range < 0.5 * (contour.range_m + contour.far_range_m)) return near_edge ? 1 : 0;
  return range < contour.far_range_m + weakly_observable ? -1 : 0;
}

bool is_informative(const Label& label, const Mat6& covariance, double own_variance) {
  const double variance = label.a.dot(covariance * label.a) + own_variance;
  return label.d_m * label.d_m < kCertain2 * variance;
}

// What was last found on some edges.
constexpr std::size_t kProbedPlaces = 8;
struct ProbedPlace {
  std::uint32_t edge = kNoElement;
  Vec3 confirm = Vec3::Zero();
  ContourPoint point;
};
struct ProbedPlaces {
  ProbedPlace of_edge[kProbedPlaces];
};

// Everything that stays the same from ray to ray.
struct PoseSearch {
  const Mission& mission;
  const View<N>& view;
  const LabelSearch& search;
  ProbeSettings probe;
  Vec3 origin;
  double own_variance;
  double across_variance;
  ProbedPlaces& probed;
};

// A label and the contour that it was found at.
struct FoundLabel {
  Label label{};
  ContourPoint point;
};

// Rays that are aimed at one place follow one another: what is there has been found out for the first.
ContourPoint probe_or_recall(const PoseSearch& s, std::uint32_t edge, const EdgePlace& place) {
  ProbedPlace& last = s.probed.of_edge[edge % kProbedPlaces];
  const double step = N::to_double(s.probe.step);
  if (last.edge != edge || !((place.confirm - last.confirm).squaredNorm() < step * step)) {
    last = {edge, place.confirm, probe_contour(s.mission.field, s.probe, s.origin, place.confirm, place.across)};
  }
  ContourPoint point = last.point;
  point.outward = place.across.dot(last.point.outward) < 0 ? Vec3(-place.across) : place.across;
  return point;
}

// A label of one ray at one contour edge; false where there is none.
bool label_edge(const PoseSearch& s, const ScanRay<N>& ray, const Line& line, const ContourEdge<N>& contour, double along,
                FoundLabel& found) {
  Label& label = found.label;
  ContourPoint& point = found.point;
  const EdgePlace place = place_on_edge(s.mission.edges.data()[contour.edge], contour, along, line);
  if (!place.usable) return false;
  ContourPoint guess;
  guess.outward = place.across;  // the sign does not matter for whether a label is worth a probe
  if (!measure(place, guess, line, label) || !is_informative(label, s.search.covariance, s.own_variance)) return false;
  point = probe_or_recall(s, contour.edge, place);
  if (point.kind == ContourKind::kNone) return false;
  label.inside = static_cast<std::int8_t>(side_of(ray, point, s.search, s.mission.parameters.edge_depth_m));
  label.at_end = !place.interior;
  label.across_variance = s.across_variance;
  if (label.inside == 0) return false;
  return measure(place, point, line, label);
}

// Beyond its end an edge takes the corner for the contour, and the side from its own line. A ray outside a corner can be on that line's
// inner side: then it passes the corner's other edge more closely, which says so if it gives a label. Inside beyond an end are only reflex
// corners.
bool misleads(bool nearer_without_label, double along, double d_m) { return nearer_without_label && (along <= 0 || along >= 1) && d_m > 0; }

// The nearest contour labels the ray; a second one does where the ray passes inside a thin part, between two contours.
void label_ray(const PoseSearch& s, std::size_t ray_index, Workspace& workspace) {
  const RayEdges<N>& edges = workspace.ray_edges[ray_index];
  const ScanRay<N>& ray = workspace.rays[ray_index];
  const Line line = to_line(s.view, ray);
  Vec3 first_outward = Vec3::Zero();
  bool passed_over = false;
  int found = 0;
  for (std::uint32_t k = 0; k < edges.count && found < 2; ++k) {
    const double along = N::to_double(edges.along[k]);
    FoundLabel candidate;
    Label& label = candidate.label;
    const ContourPoint& point = candidate.point;
    const bool labelled = label_edge(s, ray, line, workspace.contour[edges.contour[k]], along, candidate);
    passed_over = passed_over || !labelled;
    if (!labelled || misleads(passed_over, along, label.d_m)) continue;
    if (found == 1 && point.outward.dot(first_outward) > -0.5) continue;
    label.ray = static_cast<std::uint16_t>(ray_index);
    if (!workspace.labels.push_back(label)) return;
    first_outward = point.outward;
    if (label.d_m < 0) return;
    ++found;
  }
}

double smaller(double a, double b) { return a < b ? a : b; }

// Rays farther from a contour than six sigmas of the pose there carry nothing.
double search_band(const Mission& mission, const LabelSearch& search, double own_variance) {
  const double shift = search.covariance.bottomRightCorner<3, 3>().trace();
  const double turn = search.covariance.topLeftCorner<3, 3>().trace() * mission.radius_m * mission.radius_m;
  return smaller(search.band_m, square_root(kCertain2 * (2 * (shift + turn) + own_variance)));
}

PoseSearch make_search(const Mission& mission, const View<N>& view, const LabelSearch& search, ProbedPlaces& probed) {
  const double range_m = N::to_double(view.target_depth);
  const MissionParameters& p = mission.parameters;
  const double across = range_m * p.sigma_angle_rad;
  const ProbeSettings probe = probe_settings(p, search.range_sigma_m);
  return {mission,         view,  search, probe, to_vec3(view.pose.t), p.silhouette_sigma_m * p.silhouette_sigma_m + across * across,
          across * across, probed};
}

}  // namespace

void find_labels(const Mission& mission, const Pose& T_target_sensor, const LabelSearch& search, Workspace& workspace) {
  workspace.labels.clear();
  const View<N> view = make_view(mission, T_target_sensor);
  ProbedPlaces probed;
  const PoseSearch s = make_search(mission, view, search, probed);
  find_contour(mission, view, workspace);
  find_ray_edges(view, N::to_length(search_band(mission, search, s.own_variance)), workspace);
  for (std::size_t i = 0; i < workspace.rays.size() && !workspace.labels.full(); ++i) {
    if (workspace.ray_edges[i].count > 0) label_ray(s, i, workspace);
  }
}

}  // namespace lasso
