#include "fsw/pose/silhouette/ray_placement.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/silhouette/contour_probe.hpp"
#include "fsw/pose/silhouette/information_forecast.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr double kOffsetSigmas = 2;      // rays reach this far to either side of the predicted contour
constexpr double kLabelWorth = 0.6;      // how many labels make a measurement, measured: docs/experiments/2026-11-26-aimed-scans.md
constexpr double kSurfaceSpread = 5e-4;  // of the range: rays at a surface stay beside one another
static_assert(kMaxAimSurfaces == kForecastRays, "each can be a place");
constexpr double kGoldenRatio = 0.6180339887498949;

double square(double x) { return x * x; }
double larger(double a, double b) { return a > b ? a : b; }

// Everything that stays the same from place to place.
struct AimSearch {
  const Mission& mission;
  const RayPlacementRequest& request;
  View<N> view;
  Mat6 P;  // of the prediction, target axes
  Mat3 R_sensor_target;
  Vec3 origin;  // the sensor, target frame
  double range_m;
  double own_variance;
  double limit_x, limit_y;  // of the field of view on the tangent plane
};

AimSearch make_search(const Mission& mission, const RayPlacementRequest& request) {
  const MissionParameters& p = mission.parameters;
  const Pose T_target_sensor = inverse(request.T_sensor_target);
  const Mat3 R = to_matrix(request.T_sensor_target.q);
  const double range_m = square_root(T_target_sensor.p.squaredNorm());
  return {mission,
          request,
          make_view(mission, T_target_sensor),
          rotated_covariance(R.transpose(), request.covariance),
          R,
          T_target_sensor.p,
          range_m,
          square(p.silhouette_sigma_m) + square(range_m * p.sigma_angle_rad),
          tangent(p.fov_half_x_rad),
          tangent(p.fov_half_y_rad)};
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

float length_in_image(const ContourEdge<N>& edge) {
  const float dx = N::to_float(edge.dx);
  const float dy = N::to_float(edge.dy);
  return (dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy);
}

// Evenly along all contour edges, one after the other.
void find_places(const AimSearch& s, Workspace& workspace) {
  workspace.places.clear();
  float whole = 0;
  for (const ContourEdge<N>& edge : workspace.contour) whole += length_in_image(edge);
  const float step = whole / static_cast<float>(kMaxAimPlaces);
  if (!(step > 0)) return;
  float next =
      step * static_cast<float>(fractional_part(s.request.scan_id * kGoldenRatio));  // of the next place, from the edge's first end
  for (const ContourEdge<N>& edge : workspace.contour) {
    const float length = length_in_image(edge);
    while (next < length) {
      add_place(s, edge, static_cast<double>(next / length), workspace);
      next += step;
    }
    next -= length;
  }
}

// A place whose rays return, as far around it as they go.
void add_surface(const AimSearch& s, const SeenPoint& seen, Workspace& workspace) {
  AimPlace place;
  place.surface = true;
  place.point = seen.point;
  place.across = s.R_sensor_target.row(0).transpose();
  place.a = seen.row;
  place.w = kRaysPerPlace * seen.weight;
  place.s_pred = kSurfaceSpread * s.range_m;
  if (!in_field_of_view(s, place.point, kOffsetSigmas * place.s_pred)) return;
  static_cast<void>(workspace.places.push_back(place));  // as many as fit
}

// What the pattern's `rays` rays will tell, as kForecastRays of them show. Where one of these returns is a place, too.
Mat6 look_around(const AimSearch& s, double rays, Workspace& workspace) {
  const ScanRectangle rectangle = outline_of(s.mission, s.view);
  Mat6 information = Mat6::Zero();
  for (int i = 0; i < kForecastRays; ++i) {
    const SeenPoint seen = look_at(s.mission, s.view, rectangle, i);
    if (!(seen.weight > 0)) continue;
    information += seen.weight * seen.row * seen.row.transpose();
    add_surface(s, seen, workspace);
  }
  return (rays / kForecastRays) * information;
}

// How much the place's rays, of the weight w of one measurement, will take off trace(D C D).
void find_gain(const AimSearch& s, const Mat6& C, AimPlace& place) {
  const Vec6 Ca = C * place.a;
  const double variance = place.a.dot(Ca);
  const double sigma = square_root(variance + s.own_variance);
  if (!place.surface) place.w = kRaysPerPlace / (kLabelWorth * sigma * larger(sigma, place.s_pred));
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
    const bool confirmed =
        place.surface || probe_contour(s.mission.field, probe, s.origin, place.point, place.across).kind != ContourKind::kNone;
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
  double phase = fractional_part(s.request.scan_id * kGoldenRatio);
  for (const AimPlace& place : workspace.places) {
    if (place.fate != AimPlace::Fate::kChosen) continue;
    phase = fractional_part(phase + kGoldenRatio);
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

void aim_rays(const Mission& mission, const RayPlacementRequest& request, Workspace& workspace, AimedRays& rays) {
  rays.clear();
  const MissionParameters& p = mission.parameters;
  const std::size_t wanted = places_wanted(p);
  if (wanted == 0 || !(p.silhouettes > 0.5)) return;
  const AimSearch s = make_search(mission, request);
  Mat6 information;
  Mat6 C;
  if (invert6(s.P, information) != Status::kOk) return;
  find_contour(mission, s.view, workspace);
  find_places(s, workspace);
  const bool contour_known = !workspace.places.empty();
  information += look_around(s, (1 - p.aimed_share) * p.points, workspace);
  if (invert6(information, C) != Status::kOk || !contour_known) return;
  choose_places(s, wanted, C, workspace);
  aim_at_places(s, workspace, rays);
}

}  // namespace lasso
