#include "fsw/pose/aim.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/clip.hpp"
#include "fsw/pose/contour.hpp"
#include "fsw/pose/contour_probe.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using Length = N::Length;
using Ratio = N::Ratio;

constexpr double kOffsetSigmas = 2;      // rays reach this far to either side of the predicted contour
constexpr double kLabelWorth = 0.6;      // how many labels make a measurement, measured: see docs/decisions/aimed-scans.md
constexpr int kColumns = 8, kRows = 12;  // rays that stand for those of the scan's pattern
constexpr double kGoldenRatio = 0.6180339887498949;

double square(double x) { return x * x; }
double larger(double a, double b) { return a > b ? a : b; }
double fraction(double x) { return x - static_cast<double>(static_cast<std::int64_t>(x)); }

double tangent(double angle_rad) {
  const SinCos angle = sin_cos(angle_rad);
  return angle.sin / angle.cos;
}

struct Rectangle {
  Ratio low[2] = {1e30F, 1e30F};
  Ratio high[2] = {-1e30F, -1e30F};

  void include(const ImagePoint& point) {
    const Ratio at[2] = {point.x, point.y};
    for (int i = 0; i < 2; ++i) {
      if (at[i] < low[i]) low[i] = at[i];
      if (at[i] > high[i]) high[i] = at[i];
    }
  }
};

// Everything that stays the same from place to place.
struct AimSearch {
  const Mission& mission;
  const AimRequest& request;
  View<N> view;
  Mat6 P;  // of the prediction, target axes
  Mat3 R_sensor_target;
  Vec3 origin;  // the sensor, target frame
  double range_m;
  double own_variance;
  double limit_x, limit_y;  // of the field of view on the tangent plane
};

double range_variance(const MissionParameters& p, double range_m) {
  return square(p.sigma0_m) + square(p.sigma_k_per_m * range_m * range_m);
}

AimSearch make_search(const Mission& mission, const AimRequest& request) {
  const MissionParameters& p = mission.parameters;
  const Pose T_target_sensor = inverse(request.T_sensor_target);
  const Mat3 R = to_matrix(request.T_sensor_target.q);
  Mat6 J = Mat6::Zero();
  J.topLeftCorner<3, 3>() = R;
  J.bottomRightCorner<3, 3>() = R;
  const double range_m = square_root(T_target_sensor.p.squaredNorm());
  return {mission,
          request,
          make_view(mission, T_target_sensor),
          J.transpose() * request.covariance * J,
          R,
          T_target_sensor.p,
          range_m,
          square(p.silhouette_sigma_m) + square(range_m * p.sigma_angle_rad),
          tangent(p.fov_half_x_rad),
          tangent(p.fov_half_y_rad)};
}

// The information that a return along a ray will have; nothing where the ray meets no surface, or grazes it.
void add_return(const AimSearch& s, FieldRay<N>& ray, Mat6& H) {
  const Field<N>& field = s.mission.field;
  set_cells(field, ray);
  if (!near_grid(ray)) return;
  const FieldSpan<N> span = clip_to_grid(field, ray);
  const FieldHit<N> hit = walk_field(field, ray, span.enter, span.leave);
  if (!hit.found) return;
  const Length q[3] = {ray.m[0] + hit.t * ray.u[0], ray.m[1] + hit.t * ray.u[1], ray.m[2] + hit.t * ray.u[2]};
  N::Unit normal[3];
  surface_normal(field, field.elements[hit.element], q, normal);
  const MissionParameters& p = s.mission.parameters;
  const double tilt2 = square(N::to_double(dot3<N>(normal, ray.u)));
  if (tilt2 < square(sin_cos(p.incidence_max_rad).cos)) return;
  const double range_m = N::to_double(hit.t);
  const double variance =
      tilt2 * range_variance(p, range_m) + (1 - tilt2) * square(range_m * p.sigma_angle_rad) + square(p.surface_sigma_m);
  const Vec3 n = to_vec3(normal);
  Vec6 row;
  row << to_vec3(q).cross(n), n;
  H += (1 / variance) * row * row.transpose();
}

// What `returns` rays spread over the target will say of the pose, from a few that stand for them.
Mat6 information_of_returns(const AimSearch& s, double rays) {
  Rectangle outline;
  for (const HullPointOf<N>& point : s.mission.hull) {
    const ImagePoint seen = project(s.view.pose, point.p);
    if (seen.z > 0) outline.include(seen);
  }
  Mat6 H = Mat6::Zero();
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double x = N::to_double(outline.low[0]) + (column + 0.5) / kColumns * N::to_double(outline.high[0] - outline.low[0]);
      const double y = N::to_double(outline.low[1]) + (row + 0.5) / kRows * N::to_double(outline.high[1] - outline.low[1]);
      const double scale = 1 / square_root(x * x + y * y + 1);
      const N::Unit u[3] = {N::to_unit(x * scale), N::to_unit(y * scale), N::to_unit(scale)};
      FieldRay<N> ray{};
      for (int i = 0; i < 3; ++i) ray.m[i] = s.view.pose.t[i];
      rotate(s.view.pose, u, ray.u);
      add_return(s, ray, H);
    }
  }
  return (rays / (kRows * kColumns)) * H;
}

bool in_field_of_view(const AimSearch& s, const Vec3& point, double reach_m) {
  const Vec3 seen = s.R_sensor_target * (point - s.origin);
  const auto within = [&](double across, double limit) { return (across < 0 ? -across : across) + reach_m < limit * seen.z(); };
  return within(seen.x(), s.limit_x) && within(seen.y(), s.limit_y);
}

// A place at parameter `along` of a projected edge, if a ray aimed there can tell anything.
void add_place(const AimSearch& s, const ContourEdge<N>& contour, double along, Workspace& workspace) {
  const ModelEdge<N>& edge = s.mission.edges.data()[contour.edge];
  AimPlace place;
  const Vec3 a = to_vec3(edge.a);
  const Vec3 ab = to_vec3(edge.b) - a;
  place.point = a + clamp(along_in_space(contour, along), 0.02, 0.98) * ab;
  const Vec3 normal = ab.cross(place.point - s.origin);
  place.across = normal * (1 / square_root(normal.squaredNorm()));
  place.a << place.point.cross(place.across), place.across;
  place.s_pred = square_root(place.a.dot(s.P * place.a) + s.own_variance);
  if (!(place.s_pred < s.mission.parameters.silhouette_band_m)) return;  // also where the edge points at the sensor: not a number
  if (!in_field_of_view(s, place.point, kOffsetSigmas * place.s_pred)) return;
  static_cast<void>(workspace.places.push_back(place));  // as many as fit
}

Ratio length_in_image(const ContourEdge<N>& edge) { return (edge.dx < 0 ? -edge.dx : edge.dx) + (edge.dy < 0 ? -edge.dy : edge.dy); }

// Evenly along all contour edges, one after the other.
void find_places(const AimSearch& s, Workspace& workspace) {
  workspace.places.clear();
  Ratio whole = 0;
  for (const ContourEdge<N>& edge : workspace.contour) whole += length_in_image(edge);
  const Ratio step = whole / static_cast<Ratio>(kMaxAimPlaces);
  if (!(step > 0)) return;
  Ratio next = step * N::to_ratio(fraction(s.request.scan_id * kGoldenRatio));  // of the next place, from the edge's first end
  for (const ContourEdge<N>& edge : workspace.contour) {
    const Ratio length = length_in_image(edge);
    while (next < length) {
      add_place(s, edge, N::to_double(next / length), workspace);
      next += step;
    }
    next -= length;
  }
}

// How much the place's rays, of the weight w of a measurement, will take off trace(D C D).
void find_gain(const AimSearch& s, const Mat6& C, AimPlace& place) {
  const Vec6 Ca = C * place.a;
  const double variance = place.a.dot(Ca);
  const double sigma = square_root(variance + s.own_variance);
  place.w = kRaysPerPlace / (kLabelWorth * sigma * larger(sigma, place.s_pred));
  const double moved = square(s.mission.radius_m) * Ca.head<3>().squaredNorm() + Ca.tail<3>().squaredNorm();
  place.gain = place.w * moved / (1 + place.w * variance);
}

// The open place with the largest gain; one is open. What is left to gain at a place only shrinks as others are chosen: a gain found
// earlier is the most that it can be now, and asked again are only places that promise more than the best one has, beginning with the last
// but one.
std::size_t best_place(const AimSearch& s, const Mat6& C, Workspace& workspace, std::size_t& hopeful) {
  std::size_t best = hopeful;
  double most = -1;
  const auto ask = [&](std::size_t i) {
    AimPlace& place = workspace.places[i];
    if (place.fate != AimPlace::Fate::kOpen || !(place.gain > most)) return;
    find_gain(s, C, place);
    if (!(place.gain > most)) return;
    most = place.gain;
    hopeful = best;
    best = i;
  };
  ask(hopeful);
  for (std::size_t i = 0; i < workspace.places.size(); ++i) ask(i);
  return best;
}

// C after the place's rays.
void learn(const AimPlace& place, Mat6& C) {
  const Vec6 Ca = C * place.a;
  C -= (place.w / (1 + place.w * place.a.dot(Ca))) * Ca * Ca.transpose();
}

void choose_places(const AimSearch& s, std::size_t count, Mat6& C, Workspace& workspace) {
  const ProbeSettings probe = probe_settings(s.mission.parameters, square_root(range_variance(s.mission.parameters, s.range_m)));
  std::size_t chosen = 0;
  std::size_t hopeful = 0;
  for (std::size_t tried = 0; tried < workspace.places.size() && chosen < count; ++tried) {
    AimPlace& place = workspace.places[best_place(s, C, workspace, hopeful)];
    const bool confirmed = probe_contour(s.mission.field, probe, s.origin, place.point, place.across).kind != ContourKind::kNone;
    place.fate = confirmed ? AimPlace::Fate::kChosen : AimPlace::Fate::kNoContour;
    if (!confirmed) continue;
    learn(place, C);
    ++chosen;
  }
}

// Where ray `index` of `count` in the middle of the scan meets the tangent plane, so that it passes `point` at its own time.
AimedRay ray_through(const AimSearch& s, const Vec3& point, std::size_t index, std::size_t count) {
  const MissionParameters& p = s.mission.parameters;
  const Vec3 lever = s.R_sensor_target * point;
  Vec3 seen = s.request.T_sensor_target.p + lever;
  if (p.deskew > 0.5) {
    const double tau_s = p.duration_s * (static_cast<double>(index) - 0.5 * static_cast<double>(count - 1)) / (p.points - 1);
    seen += tau_s * (s.request.rates.v_mps + s.request.rates.omega_radps.cross(lever));
  }
  return {static_cast<float>(seen.x() / seen.z()), static_cast<float>(seen.y() / seen.z())};
}

void aim_at_places(const AimSearch& s, const Workspace& workspace, AimedRays& rays) {
  std::size_t count = 0;
  for (const AimPlace& place : workspace.places) count += place.fate == AimPlace::Fate::kChosen ? kRaysPerPlace : 0;
  double phase = fraction(s.request.scan_id * kGoldenRatio);
  for (const AimPlace& place : workspace.places) {
    if (place.fate != AimPlace::Fate::kChosen) continue;
    phase = fraction(phase + kGoldenRatio);
    for (std::size_t i = 0; i < kRaysPerPlace; ++i) {
      const double share = 2 * (static_cast<double>(i) + phase) / kRaysPerPlace - 1;
      const Vec3 point = place.point + share * kOffsetSigmas * place.s_pred * place.across;
      invariant(rays.push_back(ray_through(s, point, rays.size(), count)), "no more aimed rays than there is room for");
    }
  }
}

std::size_t places_wanted(const MissionParameters& p) {
  const auto rays = static_cast<std::size_t>(p.aimed_share * p.points);
  return (rays < kMaxAimedRays ? rays : kMaxAimedRays) / kRaysPerPlace;
}

}  // namespace

void aim_rays(const Mission& mission, const AimRequest& request, Workspace& workspace, AimedRays& rays) {
  rays.clear();
  const MissionParameters& p = mission.parameters;
  const std::size_t wanted = places_wanted(p);
  if (wanted == 0 || !(p.silhouettes > 0.5)) return;
  const AimSearch s = make_search(mission, request);
  Mat6 information;
  Mat6 C;
  if (invert6(s.P, information) != Status::kOk) return;
  information += information_of_returns(s, (1 - p.aimed_share) * p.points);
  if (invert6(information, C) != Status::kOk) return;
  find_contour(mission, s.view, workspace);
  find_places(s, workspace);
  choose_places(s, wanted, C, workspace);
  aim_at_places(s, workspace, rays);
}

}  // namespace lasso
