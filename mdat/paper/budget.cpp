#include "mdat/paper/budget.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/so3.hpp"
#include "fsw/geometry/symmetric6.hpp"

namespace lasso::mdat {
namespace {

double squared(double value) { return value * value; }

// A corner's share of a point in the plane of a triangle.
Vec3 barycentric(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& point) {
  const Vec3 normal = (b - a).cross(c - a);
  const double area2 = normal.squaredNorm();
  const double of_b = (point - a).cross(c - a).dot(normal) / area2, of_c = (b - a).cross(point - a).dot(normal) / area2;
  return {1 - of_b - of_c, of_b, of_c};
}

// Of the rays on the target, those that return what they meet.
double returned_share(const sim::ScannerModel& sensor) { return (1 - sensor.dropout_probability) * (1 - sensor.outlier_probability); }

double assumed_sigma_m(const BudgetAssumptions& a, double z_m) {
  return std::sqrt(squared(a.sigma0_m) + squared(a.sigma_k_per_m * z_m * z_m));
}

}  // namespace

// What one ray meets, in target axes but for `direction`.
struct BudgetTarget::Hit {
  Vec3 direction;  // sensor axes
  Vec3 u, normal;
  double range_m = 0, z_m = 0, cosine = 0;  // of normal and ray, negative towards the sensor
  double variance_m2 = 0;                   // of the range, as the estimator weighs it
  Vec6 gradient;                            // of the range with (rotation, translation) of the target
  std::array<std::uint32_t, 3> places{};
  Vec3 shares;  // of their displacements
  Vec3 turn_m;  // of the range with a common turn about each sensor axis, per rad
};

BudgetTarget::BudgetTarget(const Mesh& model) : mesh_(model) {
  const auto has_no_area = [&](const std::array<std::uint32_t, 3>& t) {
    return !((model.vertices[t[1]] - model.vertices[t[0]]).cross(model.vertices[t[2]] - model.vertices[t[0]]).norm() > 0);
  };
  std::erase_if(mesh_.triangles, has_no_area);
  caster_ = sim::make_ray_caster(mesh_.vertices, mesh_.triangles);
  std::map<std::array<double, 3>, std::uint32_t> numbers;
  for (const Vec3& vertex : mesh_.vertices) {
    const auto number = static_cast<std::uint32_t>(numbers.size());
    place_of_.push_back(numbers.try_emplace({vertex.x(), vertex.y(), vertex.z()}, number).first->second);
  }
  place_count_ = numbers.size();
}

bool BudgetTarget::hit_of(const BudgetAssumptions& a, const Pose& T_target_sensor, const Vec3& direction, Hit& hit) const {
  hit.direction = direction;
  hit.u = rotate(T_target_sensor.q, direction);
  const sim::RayHit met = caster_->cast(T_target_sensor.p, hit.u);
  const double incidence_max_rad = std::min(a.incidence_max_rad, a.sensor.dropout_incidence_rad);
  hit.cosine = met.normal.dot(hit.u);
  if (!met.hit || std::fabs(hit.cosine) < std::cos(incidence_max_rad)) return false;
  hit.normal = met.normal;
  hit.range_m = met.range_m;
  hit.z_m = met.range_m * direction.z();
  const Vec3 point = T_target_sensor.p + met.range_m * hit.u;
  hit.gradient << point.cross(hit.normal), hit.normal;
  hit.gradient /= hit.cosine;
  const double tilt2 = squared(hit.cosine);
  hit.variance_m2 = squared(assumed_sigma_m(a, hit.z_m)) + (1 / tilt2 - 1) * squared(hit.range_m * a.sigma_angle_rad) +
                    squared(a.surface_sigma_m) / tilt2;
  const std::array<std::uint32_t, 3>& t = mesh_.triangles[met.triangle];
  for (std::size_t i = 0; i < 3; ++i) hit.places[i] = place_of_[t[i]];
  hit.shares = barycentric(mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]], point);
  // A ray that is measured along u - t x u has a range that is longer by R n.(t x u) / (n.u).
  const Vec3 normal_sensor = rotate(T_target_sensor.q.conjugate(), hit.normal);
  hit.turn_m = hit.range_m / hit.cosine * direction.cross(normal_sensor);
  return true;
}

std::vector<BudgetTarget::Hit> BudgetTarget::hits_of(const BudgetAssumptions& a, const Pose& T_sensor_target,
                                                     const std::vector<Vec3>& scan) const {
  const Pose T_target_sensor = inverse(T_sensor_target);
  std::vector<Hit> hits;
  for (const Vec3& direction : scan) {
    Hit hit;
    if (hit_of(a, T_target_sensor, direction, hit)) hits.push_back(hit);
  }
  return hits;
}

// `weight`: of this ray's range error in the figure. Of its pointing two components count, across the ray: together the square of the sine.
void BudgetTarget::add(const BudgetAssumptions& a, const Hit& hit, double weight, double scans, Response& response) const {
  const double rays = returned_share(a.sensor), share = 1 / scans;
  const double tilt = (1 - squared(hit.cosine)) / squared(hit.cosine);
  response.noise += share * squared(weight * sim::range_sigma_m(a.sensor, hit.z_m)) / (rays * a.scans);
  response.pointing += share * tilt * squared(weight * hit.range_m * a.sensor.sigma_angle_rad) / (rays * a.scans);
  response.range += share * weight * (a.sensor.common_sigma_m + a.sensor.common_sigma_k_per_m * squared(hit.range_m));
  response.turn += share * weight * a.sensor.common_sigma_rad * hit.turn_m;
  for (int i = 0; i < 3; ++i)
    response.places[hit.places[static_cast<std::size_t>(i)]] += share * weight * hit.shares[i] / hit.cosine * hit.normal;
}

bool BudgetTarget::add_scan(const BudgetAssumptions& a, const Pose& T_sensor_target, const std::vector<Vec3>& scan, double scans,
                            StandResponse& stand) const {
  const std::vector<Hit> hits = hits_of(a, T_sensor_target, scan);
  Mat6 information = Mat6::Zero();
  for (const Hit& hit : hits) information += hit.gradient * hit.gradient.transpose() / hit.variance_m2;
  Mat6 covariance;
  if (invert6(information, covariance) != Status::kOk) return false;
  Vec6 z = Vec6::Zero(), turn = Vec6::Zero();
  z.tail<3>() = rotate(T_sensor_target.q.conjugate(), Vec3::UnitZ());
  turn[0] = 1;
  for (const Hit& hit : hits) {
    const Vec6 gain = covariance * hit.gradient / hit.variance_m2;
    add(a, hit, z.dot(gain), scans, stand.z_m);
    add(a, hit, turn.dot(gain), scans, stand.turn_rad);
  }
  return true;
}

StandResponse BudgetTarget::stand(const BudgetAssumptions& assumptions, const Pose& T_sensor_target,
                                  std::span<const std::vector<Vec3>> scans) const {
  StandResponse stand;
  stand.z_m.places.resize(place_count_, Vec3::Zero());
  stand.turn_rad.places.resize(place_count_, Vec3::Zero());
  stand.defined = true;
  for (const std::vector<Vec3>& scan : scans)
    stand.defined = add_scan(assumptions, T_sensor_target, scan, static_cast<double>(scans.size()), stand) && stand.defined;
  return stand;
}

Variances variances_of(const Response& response, double vertex_sigma_m) {
  double places = 0;
  for (const Vec3& place : response.places) places += place.squaredNorm();
  return {response.noise, response.pointing + response.turn.squaredNorm(), squared(response.range), squared(vertex_sigma_m) * places};
}

Variances variances_between(const Response& before, const Response& after, double vertex_sigma_m) {
  const Variances first = variances_of(before, 0), second = variances_of(after, 0);
  Variances sum{};
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = first[i] + second[i];
  double places = 0;
  for (std::size_t i = 0; i < after.places.size(); ++i) places += (after.places[i] - before.places[i]).squaredNorm();
  sum[static_cast<std::size_t>(BudgetSource::kMockUp)] = squared(vertex_sigma_m) * places;
  return sum;
}

double total(const Variances& variances) {
  double sum = 0;
  for (const double variance : variances) sum += variance;
  return sum;
}

}  // namespace lasso::mdat
