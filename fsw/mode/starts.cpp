#include "fsw/mode/starts.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/estimator/estimator.hpp"

namespace lasso {
namespace {

constexpr double kBearingSigmas = 4;
constexpr double kWidest_rad = 3.2;    // one sigma: any attitude
constexpr double kWidestReaches = 10;  // the same of the place, in what the farthest sensor reaches

template <class M>
bool all_finite(const M& m) {
  bool finite = true;
  for (int i = 0; i < m.size(); ++i) finite = finite && is_finite(m.data()[i]);
  return finite;
}

bool all_finite(const StartOffer& offer) {
  return all_finite(offer.T_sensor_target.q.coeffs()) && all_finite(offer.T_sensor_target.p) && all_finite(offer.rates.omega_radps) &&
         all_finite(offer.rates.v_mps) && all_finite(offer.covariance);
}

// A pose that may lie anywhere would pass every check against it.
bool tells_something(const Mission& mission, const Mat6& covariance) {
  double farthest_m = mission.parameters.range_max_m;
  for (const SensorParameters& sensor : mission.sensors) farthest_m = sensor.range_max_m > farthest_m ? sensor.range_max_m : farthest_m;
  const double widest_m = kWidestReaches * farthest_m;
  return covariance.diagonal().head<3>().maxCoeff() <= kWidest_rad * kWidest_rad &&
         covariance.diagonal().tail<3>().maxCoeff() <= widest_m * widest_m;
}

StartRefusal check_values(const MissionParameters& p, const StartOffer& offer, TimeUs now_us) {
  if (!all_finite(offer)) return StartRefusal::kNotFinite;
  if (!is_valid(offer.T_sensor_target)) return StartRefusal::kNotUnit;
  if (offer.t_us > now_us) return StartRefusal::kFromFuture;
  const auto age_max_us = static_cast<DurationUs>(p.start_age_max_s * 1e6);
  return offer.t_us < now_us - age_max_us ? StartRefusal::kTooOld : StartRefusal::kNone;
}

bool reaches(const SensorParameters& sensor, double nearest_m, double farthest_m) {
  return farthest_m >= sensor.range_min_m && nearest_m <= sensor.range_max_m;
}

// Of this sensor, or of another one.
bool in_reach(const Mission& mission, const Vec3& center_m) {
  const double range_m = square_root(center_m.squaredNorm());
  const double nearest_m = range_m - mission.radius_m;
  const double farthest_m = range_m + mission.radius_m;
  bool reached = reaches(mission.parameters, nearest_m, farthest_m);
  for (const SensorParameters& sensor : mission.sensors) reached = reached || reaches(sensor, nearest_m, farthest_m);
  return center_m.z() > 0 && reached;
}

bool at_bearing(const Mission& mission, const BearingState& bearing, const FilterState& filter, const Vec3& center_m) {
  const double age_s = to_seconds(filter.t_us - bearing.t_us);
  if (!bearing.started || age_s > mission.parameters.bearing_memory_s) return true;
  const double rate_mps = mission.parameters.bearing_rate_mps;
  const double variance = filter.covariance.diagonal().segment<3>(3).maxCoeff() + bearing.covariance.diagonal().head<3>().maxCoeff() +
                          age_s * age_s * rate_mps * rate_mps;
  const Vec3 apart_m = center_m - bearing.p_m - age_s * bearing.v_mps;
  return square_root(apart_m.squaredNorm()) <= mission.radius_m + kBearingSigmas * square_root(variance);
}

struct SourceOrder {
  InitialPoseSource sources[5];
};

SourceOrder order_of(const MissionParameters& p) {
  const auto source_of = [](double choice) { return static_cast<InitialPoseSource>(static_cast<std::uint8_t>(choice)); };
  return {
      {source_of(p.start_first), source_of(p.start_second), source_of(p.start_third), source_of(p.start_fourth), source_of(p.start_fifth)}};
}

std::size_t index_of(InitialPoseSource source) {
  const auto index = static_cast<std::size_t>(source);
  invariant(index < kInitialPoseSources, "no such source of a start");
  return index;
}

}  // namespace

FilterStart filter_start(const MissionParameters& p, const StartOffer& offer) {
  FilterStart from;
  from.t_us = offer.t_us;
  from.T_sensor_target = offer.T_sensor_target;
  from.rates = offer.rates;
  from.pose_covariance = offer.covariance;
  from.sigma_omega_radps = p.initial_angular_rate_radps;
  from.sigma_v_mps = p.initial_rate_mps;
  return from;
}

FilterNoise filter_noise(const MissionParameters& p) {
  return {p.acceleration_mps2, p.angular_acceleration_radps2, p.precession, p.common_memory_s};
}

bool is_in_order(const MissionParameters& p, InitialPoseSource source) {
  bool named = false;
  for (const InitialPoseSource one : order_of(p).sources) named = named || one == source;
  return named;
}

StartOffer rough_offer(const MissionParameters& p, const Pose& T_sensor_target, const Twist& rates, TimeUs t_us) {
  StartOffer offer{t_us, T_sensor_target, rates, Mat6::Zero()};
  offer.covariance.diagonal().head<3>().setConstant(p.start_sigma_rad * p.start_sigma_rad);
  offer.covariance.diagonal().tail<3>().setConstant(p.start_sigma_m * p.start_sigma_m);
  return offer;
}

StartRefusal start_from(const Mission& mission, const StartOffer& offer, TimeUs now_us, const BearingState& bearing, FilterState& filter) {
  const MissionParameters& p = mission.parameters;
  const StartRefusal refusal = check_values(p, offer, now_us);
  if (refusal != StartRefusal::kNone) return refusal;
  if (!tells_something(mission, offer.covariance)) return StartRefusal::kBadCovariance;
  FilterState started;
  if (start_filter(started, filter_start(p, offer)) != Status::kOk) return StartRefusal::kBadCovariance;
  if (predict_filter(started, now_us, filter_noise(p)) != Status::kOk) return StartRefusal::kTooFast;
  if (is_too_fast(p, started.rates, 0.5 * p.duration_s)) return StartRefusal::kTooFast;
  const Vec3 center_m = started.T_sensor_target * mission.center_m;
  if (!in_reach(mission, center_m)) return StartRefusal::kOutOfReach;
  if (!at_bearing(mission, bearing, started, center_m)) return StartRefusal::kNotAtBearing;
  filter = started;
  return StartRefusal::kNone;
}

void InitialPoseSources::put(InitialPoseSource source, const StartOffer& offer) {
  offers_[index_of(source)] = offer;
  fresh_[index_of(source)] = true;
}

const StartOffer& InitialPoseSources::take(InitialPoseSource source) {
  fresh_[index_of(source)] = false;
  return offers_[index_of(source)];
}

InitialPoseSource InitialPoseSources::next(const MissionParameters& p, bool may_search) const {
  InitialPoseSource again = InitialPoseSource::kNone;
  for (const InitialPoseSource source : order_of(p).sources) {
    const bool possible = may_search || source != InitialPoseSource::kSearch;
    if (possible && fresh_[index_of(source)]) return source;
    if (possible && source == InitialPoseSource::kSearch) again = source;
  }
  return again;
}

const char* to_string(InitialPoseSource source) {
  static constexpr const char* kNames[] = {"none", "handover", "navigation", "apriori", "uplink", "search"};
  const auto index = static_cast<std::size_t>(source);
  return index < kInitialPoseSources ? kNames[index] : "unknown";
}

const char* to_string(StartRefusal refusal) {
  static constexpr const char* kNames[] = {"none",           "not_begun",     "no_such_source", "not_finite",  "not_unit",
                                           "bad_covariance", "from_future",   "too_old",        "too_fast",    "out_of_reach",
                                           "not_at_bearing", "not_confirmed", "not_from_here",  "contradicted"};
  const auto index = static_cast<std::size_t>(refusal);
  return index < sizeof(kNames) / sizeof(kNames[0]) ? kNames[index] : "unknown";
}

}  // namespace lasso
