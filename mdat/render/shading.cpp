#include "mdat/render/shading.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/render/relief.hpp"

namespace lasso::mdat {
namespace {

constexpr int kFactors = 2048;             // of the table of view factors
constexpr int kFacetOctaves = 3;           // each 0.4 as large and leaning half as much
constexpr double kClear = 1e-6;            // of the target's size: rays start this far off the surface that they leave
constexpr double kLeastCosine = 0.02;      // of the leaning normal to the view
constexpr double kRoughestMirrored = 0.3;  // least roughness of what is seen in a mirror: a glint of a glint is noise, not light
enum Purpose : std::uint32_t { kSunDisc = 1, kEarthDisc = 2, kFacet = 3, kMirroredSun = 4, kMirroredEarth = 5 };

// How much of a pattern of this size a pixel of this width still shows.
double shown_share(double size_m, double footprint_m) { return clamp(size_m / (2 * footprint_m) - 0.5, 0, 1); }

// Share of an interval of `width` about `x` that lies on lines at whole numbers, `line` wide.
double line_cover(double x, double width, double line) {
  const auto lines_below = [line](double at) {
    const double whole = std::floor(at);
    return whole * line + std::min(at - whole, line);
  };
  return (lines_below(x + width / 2) - lines_below(x - width / 2)) / width;
}

}  // namespace

// What of a surface point its reflection needs.
struct Shader::Local {
  Vec3 start_m, view, facet_normal, normal;  // start_m: just off the surface
  Tangents side;
  Reflection reflection;
  Vec3 to_frame(const Vec3& v) const { return {side.x.dot(v), side.y.dot(v), normal.dot(v)}; }
};

Shader::Shader(const ModelSurface& surface, std::vector<Material> materials, const Lights& lights)
    : surface_(surface), materials_(std::move(materials)), lights_(lights), earth_Wpm2sr_(earth_radiance(lights)) {
  for (int i = 0; i <= kFactors; ++i) earth_factors_.push_back(disc_view_factor(2.0 * i / kFactors - 1, lights_.earth_half_angle_rad));
}

// Facets lean against the surface. Those that are smaller than the pixel make it rougher instead: a lobe of alpha^2 grows by twice the
// variance of the slopes that are not shown.
void Shader::lean(const SurfacePoint& point, double footprint_m, const Material& material, Local& local) const {
  Vec3 tilt = Vec3::Zero();
  const Vec3 place_m = surface_.to_body(point);
  double size_m = material.facet_size * surface_.extent_m(point.body), amplitude = material.tilt_rad, lost = 0;
  for (std::uint32_t octave = 0; octave < kFacetOctaves; ++octave) {
    const double share = shown_share(size_m, footprint_m);
    if (share > 0) tilt += amplitude * share * facet_tilt(place_m / size_m, 16 * point.part + octave);
    lost += amplitude * amplitude * (1 - share * share);
    amplitude *= 0.5;
    size_m *= 0.4;
  }
  if (point.body != 0) tilt = surface_.turned_to_target(point.body, tilt);
  local.normal = (local.normal + tilt - local.normal * tilt.dot(local.normal)).normalized();
  const double alpha = local.reflection.roughness;
  local.reflection.roughness = std::min(1.0, std::sqrt(alpha * alpha + 2 * lost));
}

// Factor of the diffuse reflectance; `line_share` of the pixel is on the lines between solar cells.
double Shader::shade(const SurfacePoint& point, const Vec3& normal_target, const Material& material, double footprint_m,
                     double& line_share) const {
  const double extent_m = surface_.extent_m(point.body), size_m = 0.04 * extent_m;
  const Vec3 place_m = surface_.to_body(point),
             normal = point.body == 0 ? normal_target : surface_.turned_to_body(point.body, normal_target);
  const double noise = smooth_noise(place_m / size_m, 1000 + point.part) + 0.6 * smooth_noise(place_m / (0.25 * size_m), 77);
  line_share = 0;
  if (material.grid_pitch > 0) {
    int least = 0;
    normal.cwiseAbs().minCoeff(&least);
    const Vec3 u = (Vec3::Unit(least) - normal * normal[least]).normalized(), v = normal.cross(u);
    const double pitch_m = material.grid_pitch * extent_m;
    const double width = footprint_m / pitch_m;
    const double a = line_cover(u.dot(place_m) / pitch_m, width, kGridLine);
    const double b = line_cover(v.dot(place_m) / pitch_m, width, kGridLine);
    line_share = a + b - a * b;
  }
  return std::max(0.2, 1 + material.contrast * noise);
}

Shader::Local Shader::local_at(const SurfacePoint& point, const Vec3& direction, double footprint_m) const {
  const Material& material = materials_[point.part];
  Local local;
  local.start_m = point.place_m + kClear * surface_.extent_m() * point.facet_normal;
  local.view = -direction;
  local.facet_normal = point.facet_normal;
  local.normal = point.smooth_normal;
  local.reflection = material.reflection;
  if (material.tilt_rad > 0) lean(point, footprint_m, material, local);
  const double toward = local.normal.dot(local.view);
  if (toward < kLeastCosine) local.normal = (local.normal + (kLeastCosine - toward) * local.view).normalized();
  local.side = tangents_of(local.normal);
  if (material.contrast > 0 || material.grid_pitch > 0) {
    double line_share = 0;
    const double factor = shade(point, point.smooth_normal, material, footprint_m, line_share);
    const Rgb ground = (material.reflection.diffuse * factor).min(1 - material.reflection.specular);
    local.reflection.diffuse = ground + line_share * (Rgb::Constant(kGridReflectance) - ground);
  }
  return local;
}

Rgb Shader::from_sun(const Local& local, const PictureRay& ray, std::uint32_t purpose) const {
  if (!lights_.sun || lights_.sun_share <= 0) return Rgb::Zero();
  const Vec3 light = disc_direction(*lights_.sun, kSunHalfAngle_rad, ray.samples.at(ray.index, purpose));
  const double cosine = local.normal.dot(light);
  if (cosine <= 0 || local.facet_normal.dot(light) <= 0 || surface_.is_blocked(local.start_m, light)) return Rgb::Zero();
  return lights_.sun_share * kSun_Wpm2 * cosine * reflected(local.reflection, local.to_frame(local.view), local.to_frame(light));
}

Rgb Shader::from_lamp(const Lamp& lamp, const Local& local) const {
  const Vec3 way_m = lamp.place_m - local.start_m;
  const double range_m = way_m.norm();
  const Vec3 light = way_m / range_m;
  const double cosine = local.normal.dot(light), irradiance_Wpm2 = lamp_irradiance(lamp, local.start_m);
  if (cosine <= 0 || local.facet_normal.dot(light) <= 0 || !(irradiance_Wpm2 > 0)) return Rgb::Zero();
  if (lamp.casts_shadows && surface_.is_blocked(local.start_m, light, range_m)) return Rgb::Zero();
  return irradiance_Wpm2 * cosine * reflected(local.reflection, local.to_frame(local.view), local.to_frame(light));
}

Rgb Shader::from_lamps(const Local& local) const {
  Rgb sum = Rgb::Zero();
  for (const Lamp& lamp : lights_.lamps) sum += from_lamp(lamp, local);
  return sum;
}

// The view factor is exact where all of the disc is seen; its shadows are those of one place of the disc for each sample.
Rgb Shader::from_earth(const Local& local, const PictureRay& ray, std::uint32_t purpose) const {
  if (!lights_.earth || earth_Wpm2sr_ <= 0) return Rgb::Zero();
  const double place = 0.5 * (local.normal.dot(*lights_.earth) + 1) * kFactors;
  const auto low = std::min<std::size_t>(kFactors - 1, static_cast<std::size_t>(std::max(0.0, place)));
  const double share = place - static_cast<double>(low);
  const double factor = earth_factors_[low] + share * (earth_factors_[low + 1] - earth_factors_[low]);
  if (factor <= 0) return Rgb::Zero();
  UnitSquare sample = ray.samples.at(ray.index, purpose);
  Vec3 light = disc_direction(*lights_.earth, lights_.earth_half_angle_rad, sample);
  for (int turn = 1; turn < 4 && local.facet_normal.dot(light) <= 0; ++turn) {  // that place is below the horizon: another one
    sample = {fractional_part(sample.u + 0.618034), fractional_part(sample.v + 0.25)};
    light = disc_direction(*lights_.earth, lights_.earth_half_angle_rad, sample);
  }
  if (local.facet_normal.dot(light) > 0 && surface_.is_blocked(local.start_m, light)) return Rgb::Zero();
  return kPi * factor * earth_Wpm2sr_ * diffusely_reflected(local.reflection, local.to_frame(local.view));
}

Rgb Shader::mirrored_in(const Local& local, const PictureRay& ray) const {
  if (!(local.reflection.specular > 0).any()) return Rgb::Zero();
  const Mirrored mirror = mirrored(local.reflection, local.to_frame(local.view), ray.samples.at(ray.index, kFacet));
  if (!(mirror.share > 0).any()) return Rgb::Zero();
  const Vec3 out = mirror.light.x() * local.side.x + mirror.light.y() * local.side.y + mirror.light.z() * local.normal;
  if (local.facet_normal.dot(out) <= 0) return Rgb::Zero();
  SurfacePoint other;
  if (surface_.find(local.start_m, out, other)) {
    Local there = local_at(other, out, std::max(0.01 * surface_.extent_m(), 2 * local.reflection.roughness * other.range_m));
    there.reflection.roughness = std::max(kRoughestMirrored, there.reflection.roughness);
    return mirror.share * (from_sun(there, ray, kMirroredSun) + from_lamps(there) + from_earth(there, ray, kMirroredEarth));
  }
  return mirror.share * earth_Wpm2sr_ * mirrored_earth(local);
}

// Share of the mirrored lobe that lies on Earth's disc, whose edge is taken as straight: slopes of GGX facets along one axis are below s
// with the probability (1 + s / sqrt(alpha^2 + s^2)) / 2, and a facet turns the ray by twice its own angle.
double Shader::mirrored_earth(const Local& local) const {
  if (!lights_.earth || earth_Wpm2sr_ <= 0) return 0;
  const Vec3 mirror = 2 * local.normal.dot(local.view) * local.normal - local.view;
  const double off_rad = arc_tangent2(mirror.cross(*lights_.earth).norm(), mirror.dot(*lights_.earth));
  const double s = tangent(0.5 * (lights_.earth_half_angle_rad - off_rad)), alpha = local.reflection.roughness;
  return 0.5 * (1 + s / std::sqrt(alpha * alpha + s * s));
}

bool Shader::radiance(const PictureRay& ray, SurfacePoint& point, Rgb& radiance) const {
  radiance = Rgb::Zero();
  if (!surface_.find(ray.origin_m, ray.direction, point)) return false;
  const Local local = local_at(point, ray.direction, point.range_m * ray.pixel_rad);
  radiance = from_sun(local, ray, kSunDisc) + from_lamps(local) + from_earth(local, ray, kEarthDisc) + mirrored_in(local, ray);
  return true;
}

}  // namespace lasso::mdat
