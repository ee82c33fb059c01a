#include "mdat/replay/diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/estimator/estimator.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kTried = 5;  // scans
constexpr double kMostTurn_rad = 20 * kRadPerDeg;
constexpr double kMostShift = 0.5;                                  // of the model's radius: a quarter of its size
constexpr double kMuchBetter = 0.7;                                 // of residuals
constexpr double kNear = 1.5;                                       // times the model's radius
constexpr double kNoisy = 1.5, kNoisyWeighted = 1.2, kQuiet = 0.2;  // residuals over the noise

struct LengthUnit {
  double metres;
  const char* name;
};
constexpr LengthUnit kLengths[] = {{1e-3, "millimetres"}, {1e-2, "centimetres"}, {0.0254, "inches"}, {0.3048, "feet"}, {1e3, "kilometres"}};

// The unit that brings the range to where the target is, to within its radius, or within what the sensor measures; null if none does.
const LengthUnit* unit_for(const MissionParameters& p, double range_m, double target_m, double radius_m) {
  for (const LengthUnit& unit : kLengths) {
    const double there_m = range_m * unit.metres;
    const bool fits = target_m > 0 ? std::abs(there_m - target_m) < kNear * radius_m : there_m >= p.range_min_m && there_m <= p.range_max_m;
    if (fits) return &unit;
  }
  return nullptr;
}

double target_range_m(const std::vector<InitialPose>& poses) {
  std::vector<double> ranges_m;
  for (const InitialPose& pose : poses) ranges_m.push_back(pose.T_sensor_target.p.norm());
  return median(ranges_m);
}

// A scan and the pose to start from.
struct Trial {
  std::unique_ptr<RangeImage> image;
  Pose start;
};

std::vector<Trial> trials(const ReplayOptions& options, const ReplayInput& input) {
  std::vector<Trial> chosen;
  const std::size_t count = options.closed_loop ? 1 : std::min(kTried, input.scans.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t scan = i * input.scans.size() / count;
    const Pose start =
        options.closed_loop ? input.poses.front().T_sensor_target : pose_of(input.poses, input.scans.stem(scan), options.initial);
    chosen.push_back({std::make_unique<RangeImage>(input.scans.read(scan)), start});
  }
  return chosen;
}

Pose as_it_is(const Pose& pose) { return pose; }

struct Reading {
  std::string meaning;
  std::function<Pose(const Pose&)> pose;
  Mat3 axes = Mat3::Identity();                // of the scans
  std::function<void(RangeSample&)> ray = {};  // and of each return behind them; empty: as it is
};

using Direction = Eigen::Map<Eigen::Vector3f>;

void scale(RangeSample& ray, double factor) { ray.range_m = static_cast<float>(static_cast<double>(ray.range_m) * factor); }

Reading scaled(double factor) {
  return {"", as_it_is, Mat3::Identity(), [factor](RangeSample& ray) { scale(ray, factor); }};
}

// As if the sensor stood on the other side of the file's origin.
Reading other_side(const sim::ScanFrame& frame) {
  const Vec3 way_m = 2 * frame.R_sensor_file * frame.sensor_m;
  return {"--sensor-offset of the other sign", as_it_is, Mat3::Identity(), [way_m](RangeSample& ray) {
            const Vec3 place_m = static_cast<double>(ray.range_m) * Direction(ray.direction).cast<double>() + way_m;
            ray.range_m = static_cast<float>(place_m.norm());
            Direction(ray.direction) = place_m.normalized().cast<float>();
          }};
}

// Depths along the boresight that are ranges, or ranges that are depths.
Reading other_values(bool along_ray) {
  return {along_ray ? "values = \"depth\"" : "values = \"range\"", as_it_is, Mat3::Identity(), [along_ray](RangeSample& ray) {
            const double z = static_cast<double>(ray.direction[2]);
            scale(ray, along_ray ? 1 / z : z);
          }};
}

Pose inverse_attitude(const Pose& pose) { return {pose.q.conjugate(), pose.p}; }

std::vector<Reading> readings(const ReplayOptions& options) {
  std::vector<Reading> all = {
      {"the inverse of each pose: the file seems to hold T_target_sensor, where T_sensor_target is needed", inverse},
      {"poses with their quaternions scalar first: the columns qx,qy,qz,qw seem to hold qw,qx,qy,qz", scalar_first},
      {"the inverse of each pose, its quaternion scalar first: the file seems to hold T_target_sensor as qw,qx,qy,qz",
       [](const Pose& pose) { return inverse(scalar_first(pose)); }},
      {"poses with inverse quaternions: they seem to take the sensor's axes to the target's", inverse_attitude},
      {"poses with inverse quaternions, scalar first: qx,qy,qz,qw seem to hold qw,qx,qy,qz from the sensor's axes to the target's",
       [](const Pose& pose) { return inverse_attitude(scalar_first(pose)); }}};
  for (const char* axes : {"forward-right-down", "forward-left-up", "right-up-backward", "right-forward-up", "left-down-forward",
                           "right-up-forward", "left-up-forward"}) {
    all.push_back({std::string("scans in other axes: --axes ") + axes, as_it_is, sim::axes_of(axes)});
  }
  if (!options.frame.sensor_m.isZero()) all.push_back(other_side(options.frame));
  if (!options.frame.R_sensor_file.isIdentity()) {
    const Mat3 R = options.frame.R_sensor_file;
    all.push_back({"scans as they are: leave --axes out", as_it_is, R.transpose()});
    if (R.determinant() < 0) return all;  // a change of handedness, which no pose can follow
    all.push_back(
        {"poses turned as the scans are: --axes turns the scans alone, poses are those in the sensor frame", [R](const Pose& pose) {
           return Pose{Quat(R) * pose.q, R * pose.p};
         }});
  }
  return all;
}

RangeImage read_as(const RangeImage& image, const Reading& reading) {
  RangeImage result = image;
  for (RangeSample& sample : result.samples) {
    Direction direction(sample.direction);
    direction = (reading.axes * direction.cast<double>()).cast<float>().eval();
    if (reading.ray && sample.state == RayState::kHit) reading.ray(sample);
  }
  return result;
}

bool fits(const Mission& mission, Estimator& estimator, const RangeImage& image, const Pose& start, bool wide) {
  const Registration registration = estimator.estimate(mission, image, {start, {}, wide});
  const Vec6 moved = pose_difference(registration.T_sensor_target, start);
  return registration.valid() && moved.head<3>().norm() < kMostTurn_rad && moved.tail<3>().norm() < kMostShift * mission.radius_m;
}

std::size_t fitting(const Mission& mission, Estimator& estimator, const std::vector<Trial>& trials, const Reading& reading,
                    bool wide = true) {
  return static_cast<std::size_t>(std::count_if(trials.begin(), trials.end(), [&](const Trial& trial) {
    return fits(mission, estimator, read_as(*trial.image, reading), reading.pose(trial.start), wide);
  }));
}

bool has_return_near(const Trial& trial, double within_m) {
  return std::any_of(trial.image->samples.begin(), trial.image->samples.end(), [&](const RangeSample& sample) {
    const Vec3 place = static_cast<double>(sample.range_m) * Eigen::Map<const Eigen::Vector3f>(sample.direction).cast<double>();
    return sample.state == RayState::kHit && (place - trial.start.p).norm() < within_m;
  });
}

// Of a range, by the mission: the sensor's noise and angle, and the surface's.
double stated_sigma_m(const MissionParameters& p, double range_m) {
  const double far_m = p.sigma_k_per_m * range_m * range_m, aside_m = p.sigma_angle_rad * range_m;
  return std::sqrt(p.sigma0_m * p.sigma0_m + far_m * far_m + aside_m * aside_m + p.surface_sigma_m * p.surface_sigma_m);
}

// Do most scans fit whose lengths are in such a unit? Without poses it is not tried, which takes a search.
bool fits_in(const Mission& mission, const ReplayOptions& options, const ReplayInput& input, double metres) {
  if (input.poses.empty()) return true;
  const std::vector<Trial> chosen = trials(options, input);
  return 2 * fitting(mission, *std::make_unique<Estimator>(), chosen, scaled(metres)) > chosen.size();
}

// Root mean squares of residuals of scans that fit, the median, m; beyond any where fewer than half fit.
double residual_m(const Mission& mission, Estimator& estimator, const std::vector<Trial>& trials, const Reading& reading) {
  std::vector<double> rms_m;
  for (const Trial& trial : trials) {
    const Registration r = estimator.estimate(mission, read_as(*trial.image, reading), {reading.pose(trial.start), {}, true});
    if (r.valid()) rms_m.push_back(r.rms_m);
  }
  return 2 * rms_m.size() < trials.size() ? std::numeric_limits<double>::infinity() : median(rms_m);
}

}  // namespace

Notes value_notes(const Mission& mission, const ReplayOptions& options, const ReplayInput& input) {
  if (input.poses.empty() || !(options.camera.fx > 0)) return {};
  const std::vector<Trial> chosen = trials(options, input);
  const auto estimator = std::make_unique<Estimator>();
  const Reading other = other_values(options.camera.along_ray);
  const double given_m = residual_m(mission, *estimator, chosen, {"", as_it_is}), other_m = residual_m(mission, *estimator, chosen, other);
  if (!(other_m < kMuchBetter * given_m)) return {};
  const std::string given = std::isfinite(given_m) ? format("residuals of %.3g mm", 1e3 * given_m) : "few valid poses";
  return {format("warning: depth images have %s as given, and residuals of %.3g mm (median of %s tried) with %s in the camera's file",
                 given.c_str(), 1e3 * other_m, amount(chosen.size(), "scan").c_str(), other.meaning.c_str())};
}

Notes range_notes(const Mission& mission, const ReplayOptions& options, const ReplayInput& input) {
  const MissionParameters& p = mission.parameters;
  std::vector<double> ranges_m;
  for (const sim::ScanFacts& scan : input.facts) {
    if (scan.hits > 0) ranges_m.push_back(scan.median_range_m);
  }
  if (ranges_m.empty()) return {"warning: no scan has any return"};
  const bool far = std::all_of(ranges_m.begin(), ranges_m.end(), [&](double range_m) { return range_m > p.range_max_m; });
  const bool close = std::all_of(ranges_m.begin(), ranges_m.end(), [&](double range_m) { return range_m < p.range_min_m; });
  if (!far && !close) return {};
  const double range_m = median(ranges_m);
  std::string text =
      format("warning: the returns of %s lie %s %g (their median range: %.4g m)",
             ranges_m.size() == 1 ? "the scan" : format("all %zu scans", ranges_m.size()).c_str(),
             far ? "beyond sensor.range_max_m" : "nearer than sensor.range_min_m", far ? p.range_max_m : p.range_min_m, range_m);
  const LengthUnit* const unit = unit_for(p, range_m, target_range_m(input.poses), mission.radius_m);
  if (unit != nullptr && fits_in(mission, options, input, unit->metres))
    return {text + format(": in %s? --scale %g reads them so", unit->name, unit->metres)};
  Notes notes = {text + ": is the mission's sensor the one that took them? In no other unit do they fit"};
  for (const std::string& note : reading_notes(mission, options, input)) notes.push_back(note);
  return notes;
}

Notes reading_notes(const Mission& mission, const ReplayOptions& options, const ReplayInput& input) {
  if (input.poses.empty()) return {};
  const std::vector<Trial> chosen = trials(options, input);
  const auto estimator = std::make_unique<Estimator>();
  const std::size_t as_asked = fitting(mission, *estimator, chosen, {"", as_it_is});
  Notes notes;
  const double within_m = kNear * mission.radius_m;
  if (std::none_of(chosen.begin(), chosen.end(), [&](const Trial& trial) { return has_return_near(trial, within_m); })) {
    notes.push_back(
        format("warning: no return of %s tried is within %.3g m (1.5 times the target's radius) of the target's origin at "
               "the given poses",
               amount(chosen.size(), "scan").c_str(), within_m));
  }
  if (2 * as_asked > chosen.size()) {
    const std::size_t near = options.wide ? as_asked : fitting(mission, *estimator, chosen, {"", as_it_is}, false);
    if (2 * near <= chosen.size())
      notes.push_back(format("note: of %s tried %zu fit as given, and %zu with --wide: the poses are rough",
                             amount(chosen.size(), "scan").c_str(), near, as_asked));
    return notes;
  }
  std::size_t most = as_asked;
  std::string best;
  for (const Reading& reading : readings(options)) {
    const std::size_t count = fitting(mission, *estimator, chosen, reading);
    if (count <= most) continue;
    most = count;
    best = reading.meaning;
  }
  if (!best.empty()) {
    notes.push_back(format("warning: of %s tried %zu fit as given, and %zu with ", amount(chosen.size(), "scan").c_str(), as_asked, most) +
                    best);
  } else if (!notes.empty()) {
    notes.back() +=
        ", nor do inverse poses, quaternions scalar first, or other axes fit: check units, and whether the scans are the target's";
  }
  return notes;
}

// Residuals as they are, not weighted, over what is stated; the estimator's own ratio has to agree, which knows angles of incidence.
Notes noise_notes(const Mission& mission, const ReplayInput& input, const std::vector<ReplayedScan>& scans) {
  std::vector<double> ratios, weighted, shown_m, ranges_m;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Registration& r = scans[i].registration;
    if (!r.valid() && r.reason != PoseReason::kHighResidual) continue;
    ranges_m.push_back(input.facts[i].median_range_m);
    shown_m.push_back(r.rms_m);
    ratios.push_back(r.rms_m / stated_sigma_m(mission.parameters, ranges_m.back()));
    weighted.push_back(r.normalized_residual);
  }
  const double ratio = median(ratios);
  const bool noisy = ratio > kNoisy && median(weighted) > kNoisyWeighted;
  if (ratios.empty() || !(noisy || ratio < kQuiet)) return {};
  const double range_m = median(ranges_m);
  const std::string figures = format(
      "residuals are %.2g times the noise that the mission states (median of %s): at %.3g m they show %.3g mm, and sensor.sigma0_m, "
      "sigma_k_per_m and sigma_angle_rad with estimation.surface_sigma_m make %.3g mm",
      ratio, amount(ratios.size(), "scan").c_str(), range_m, 1e3 * median(shown_m), 1e3 * stated_sigma_m(mission.parameters, range_m));
  if (noisy) return {"warning: " + figures + ": state the sensor's own noise, or how well the surface is known"};
  return {"note: " + figures + ": a noise stated far too large makes gates too wide beside edges"};
}

Notes mismatch_notes(const Mission& mission, const std::vector<ReplayedScan>& scans) {
  std::vector<double> contradicting;
  for (const ReplayedScan& scan : scans) {
    if (scan.registration.reason == PoseReason::kModelMismatch) contradicting.push_back(1 - scan.registration.agreement);
  }
  if (2 * contradicting.size() <= scans.size()) return {};
  const double most = *std::max_element(contradicting.begin(), contradicting.end());
  return {format(
      "warning: of %s rays contradict the pose: as many as %.2g %% of the returns (median), at most %.2g %%; "
      "tracking.agreement_min allows %.2g %%. Is the target as it was modelled? If so, the sensor has outliers or drop-outs that "
      "are not stated, its rays do not begin in one point, or the model lacks parts: then lower it, at the price of mismatch",
      amount(contradicting.size(), "scan").c_str(), 100 * median(contradicting), 100 * most, 100 * (1 - mission.parameters.agreement_min))};
}

}  // namespace lasso::mdat
