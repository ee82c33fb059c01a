#include "mdat/library/lasso_mdat.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "fsw/mission/loader.hpp"
#include "fsw/pose/recognition/pose_search.hpp"
#include "hal_sim/raw_scan.hpp"
#include "mdat/replay/single_scans.hpp"

// What is said of bad input: one line for a person.
struct LibraryInputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct lasso_target {
  std::vector<std::uint64_t> memory;  // of the image, which the mission looks into
  lasso::Mission mission;
  lasso::Parts parts;
  std::unique_ptr<lasso::mdat::SingleScans> singles;
  std::unique_ptr<lasso::PoseSearch> search = std::make_unique<lasso::PoseSearch>();
  std::unique_ptr<lasso::Workspace> workspace = std::make_unique<lasso::Workspace>();
};

namespace lasso::mdat {
namespace {

constexpr double kQuaternionTolerance = 1e-3;    // of its length, as in tables of poses
constexpr std::uint32_t kSearchSlice = 100'000;  // units of work; the result does not depend on it
static_assert(kMaxSearchCandidates == LASSO_MOST_CANDIDATES);

void say(const std::string& text, char* why, std::size_t room) {
  if (why == nullptr || room == 0) return;
  const std::size_t size = std::min(text.size(), room - 1);
  std::memcpy(why, text.data(), size);
  why[size] = '\0';
}

// Runs `work`, and makes a return value of what it throws.
template <class Work>
int told(const Work& work, char* why, std::size_t room) {
  try {
    work();
    return 0;
  } catch (const std::exception& error) {
    say(error.what(), why, room);
    return LASSO_BAD_INPUT;
  }
}

void put_pose(const Pose& pose, double (&values)[7]) {
  const double all[] = {pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w(), pose.p.x(), pose.p.y(), pose.p.z()};
  std::copy(std::begin(all), std::end(all), std::begin(values));
}

void put_rows(const Mat6& matrix, double (&values)[36]) {
  for (int i = 0; i < 36; ++i) values[i] = matrix(i / 6, i % 6);
}

Pose prior_of(const double* values) {
  if (values == nullptr) throw LibraryInputError("prior: expected 7 numbers");
  if (!std::all_of(values, values + 7, [](double value) { return std::isfinite(value); }))
    throw LibraryInputError("prior: expected finite numbers");
  const Quat q(values[3], values[0], values[1], values[2]);
  const double length = std::sqrt(q.squaredNorm());
  if (std::fabs(length - 1) > kQuaternionTolerance)
    throw LibraryInputError("prior: the quaternion x, y, z, w has length " + std::to_string(length) + ", expected 1");
  return {normalized(q), Vec3(values[4], values[5], values[6])};
}

RangeSample sample_of(const lasso_ray& ray, std::size_t number) {
  const auto fail = [&](const char* what) { throw LibraryInputError("ray " + std::to_string(number) + ": " + what); };
  RangeSample sample;
  std::copy(std::begin(ray.direction), std::end(ray.direction), std::begin(sample.direction));
  sample.range_m = ray.range_m;
  sample.t_us = ray.t_us;
  sample.sigma_factor = ray.sigma_factor;
  sample.state = static_cast<RayState>(ray.state);
  if (ray.state < 0 || ray.state > 2) fail("expected state 0, 1 or 2");
  const Vec3 u(static_cast<double>(ray.direction[0]), static_cast<double>(ray.direction[1]), static_cast<double>(ray.direction[2]));
  if (!(std::fabs(u.norm() - 1) < kQuaternionTolerance)) fail("expected a direction of length 1");
  if (!(ray.range_m >= 0) || !std::isfinite(ray.range_m)) fail("expected a range of 0 m or more");
  if (!(ray.sigma_factor >= 1) || static_cast<double>(ray.sigma_factor) > kMaxSigmaFactor) fail("sigma_factor is out of its range");
  return sample;
}

std::unique_ptr<RangeImage> image_of(const lasso_scan* scan) {
  if (scan == nullptr || scan->rays == nullptr || scan->count == 0) throw LibraryInputError("the scan has no ray");
  if (scan->count > kMaxRays)
    throw LibraryInputError("the scan has " + std::to_string(scan->count) + " rays, expected at most " + std::to_string(kMaxRays));
  auto image = std::make_unique<RangeImage>();
  image->misses_known = scan->misses_known != 0;
  for (std::size_t i = 0; i < scan->count; ++i) {
    if (i > 0 && scan->rays[i].t_us < scan->rays[i - 1].t_us)
      throw LibraryInputError("ray " + std::to_string(i) + ": is earlier than the one before");
    static_cast<void>(image->samples.push_back(sample_of(scan->rays[i], i)));
  }
  return image;
}

sim::RawScan scan_of(const double* points_m, const double* times_s, const std::uint8_t* hits, std::size_t points) {
  if (points_m == nullptr || points == 0) throw LibraryInputError("the scan has no point");
  sim::RawScan scan;
  scan.file = "scan";
  scan.has_times = times_s != nullptr;
  scan.misses_known = hits != nullptr;
  for (std::size_t i = 0; i < points; ++i) {
    const Vec3 place(points_m[3 * i], points_m[3 * i + 1], points_m[3 * i + 2]);
    const double time_s = times_s == nullptr ? 0 : times_s[i];
    if (i > 0 && times_s != nullptr && !(time_s >= times_s[i - 1]))
      throw LibraryInputError("point " + std::to_string(i) + ": is earlier than the one before; sort the rows by time");
    if (hits == nullptr || hits[i] != 0 || place.isZero(0) || !place.allFinite()) {
      scan.add_point(place, time_s, i);
      continue;
    }
    const double length = place.stableNorm();
    if (std::abs(length - 1) > kQuaternionTolerance)
      throw LibraryInputError("point " + std::to_string(i) + ": the direction of a miss has length " + std::to_string(length) +
                              ", expected 1");
    scan.add_miss(place / length, time_s, i);
  }
  return scan;
}

void put_rays(const RangeImage& image, lasso_ray* rays, std::size_t& count) {
  count = image.samples.size();
  for (std::size_t i = 0; i < count; ++i) {
    const RangeSample& sample = image.samples[i];
    lasso_ray& ray = rays[i];
    std::copy(std::begin(sample.direction), std::end(sample.direction), std::begin(ray.direction));
    ray.range_m = sample.range_m;
    ray.t_us = sample.t_us;
    ray.sigma_factor = sample.sigma_factor;
    ray.state = static_cast<std::int32_t>(sample.state);
  }
}

void put_registration(const Registration& r, lasso_registration& result) {
  put_pose(r.T_sensor_target, result.pose);
  put_rows(r.covariance, result.covariance);
  result.t_us = r.t_us;
  result.valid = r.valid() ? 1 : 0;
  result.reason = static_cast<std::int32_t>(r.reason);
  result.iterations = r.iterations;
  result.rays = r.rays;
  result.returns = r.returns;
  result.inliers = r.inliers;
  result.rms_m = r.rms_m;
  result.normalized_residual = r.normalized_residual;
  result.inlier_share = r.inlier_share;
  result.agreement = r.agreement;
}

void put_search(const SearchResult& found, TimeUs t_us, lasso_search_result& result) {
  put_pose(found.T_sensor_target, result.pose);
  put_rows(found.covariance, result.covariance);
  result.t_us = t_us;
  result.outcome = static_cast<std::int32_t>(found.outcome);
  result.reason = static_cast<std::int32_t>(found.reason);
  result.disagreement = found.disagreement;
  result.ratio = found.ratio;
  result.candidates = static_cast<std::int32_t>(found.candidates.size());
  for (std::size_t i = 0; i < found.candidates.size(); ++i) {
    put_pose(found.candidates[i].T_sensor_target, result.candidate[i].pose);
    result.candidate[i].disagreement = found.candidates[i].disagreement;
    result.candidate[i].score = found.candidates[i].score;
  }
}

std::unique_ptr<lasso_target> load(const std::uint8_t* image, std::size_t bytes) {
  if (image == nullptr || bytes == 0) throw LibraryInputError("the flight image is empty");
  auto target = std::make_unique<lasso_target>();
  target->memory.resize(bytes / sizeof(std::uint64_t) + 1);
  std::memcpy(target->memory.data(), image, bytes);
  const LoadFailure failure = load_image({reinterpret_cast<std::uint8_t*>(target->memory.data()), bytes}, target->mission, target->parts);
  if (failure.status != Status::kOk)
    throw LibraryInputError("not a valid flight image: " + std::string(to_string(failure.status)) + ": " + failure.what);
  target->singles = std::make_unique<SingleScans>(target->mission);
  return target;
}

// As mdat replay --initial search does.
void find_pose(lasso_target& target, const RangeImage& image, lasso_search_result& result) {
  SearchLimits limits;
  limits.scans_max = 1;
  target.search->begin(limits);
  const Status status = target.search->add_scan(target.mission, image, *target.workspace);
  while (!target.search->advance(target.mission, *target.workspace, kSearchSlice)) {
  }
  put_search(target.search->result(), image.reference_time_us(), result);
  if (status == Status::kOk) return;
  result.outcome = static_cast<std::int32_t>(SearchOutcome::kRejected);
  result.reason = static_cast<std::int32_t>(SearchReason::kTooFewReturns);
}

}  // namespace
}  // namespace lasso::mdat

using lasso::mdat::told;

int lasso_interface(void) { return LASSO_INTERFACE; }
size_t lasso_most_rays(void) { return lasso::kMaxRays; }

lasso_target* lasso_open(const uint8_t* image, size_t bytes, char* why, size_t room) {
  std::unique_ptr<lasso_target> target;
  (void)told([&] { target = lasso::mdat::load(image, bytes); }, why, room);
  return target.release();
}

void lasso_close(lasso_target* target) { delete target; }

int lasso_rays_of_points(const double* points_m, const double* times_s, const uint8_t* hits, size_t points, lasso_ray* rays, size_t* count,
                         char* why, size_t room) {
  return told(
      [&] {
        const auto image = std::make_unique<lasso::RangeImage>(
            lasso::sim::to_image(lasso::mdat::scan_of(points_m, times_s, hits, points), lasso::sim::ScanFrame{}));
        lasso::mdat::put_rays(*image, rays, *count);
      },
      why, room);
}

int lasso_register(lasso_target* target, const lasso_scan* scan, const double prior[7], int wide, lasso_registration* result, char* why,
                   size_t room) {
  return told(
      [&] {
        const auto image = lasso::mdat::image_of(scan);
        lasso::mdat::put_registration(target->singles->estimate(*image, {lasso::mdat::prior_of(prior), {}, wide != 0}), *result);
      },
      why, room);
}

int lasso_search(lasso_target* target, const lasso_scan* scan, lasso_search_result* result, char* why, size_t room) {
  return told([&] { lasso::mdat::find_pose(*target, *lasso::mdat::image_of(scan), *result); }, why, room);
}

const char* lasso_reason(int32_t reason) { return lasso::to_string(static_cast<lasso::PoseReason>(reason)); }
const char* lasso_outcome(int32_t outcome) { return lasso::to_string(static_cast<lasso::SearchOutcome>(outcome)); }
const char* lasso_search_reason(int32_t reason) { return lasso::to_string(static_cast<lasso::SearchReason>(reason)); }
