// Searches for the target without any prior attitude: random attitudes and ranges, the laser camera's scans, and what the search makes of
// them. A pose is right within 2 deg and 1.5 % of the model's size (2 cm for the tenth-scale Hubble).
//
// usage: search MISSION [CASE = all] [STARTS = 1000] [SEED = 1] [SCANS = 3] [SCALE = 1] [FOLDER]
// With a FOLDER nothing is searched: image.3dli and scans.bin, SCANS of each start, are written there for search_replay.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "fsw/pose/estimator/estimator.hpp"
#include "fsw/pose/recognition/pose_search.hpp"
#include "fsw/sense/pattern.hpp"
#include "ft/search/cases.hpp"
#include "ft/search/recording.hpp"
#include "hal_sim/scanner.hpp"
#include "mdat/common/count.hpp"
#include "mdat/common/cpu_clock.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/run/simulation.hpp"

namespace {

using namespace lasso;
using search::Case;
using search::Setting;
using Target = Case::Target;

constexpr double kRight_rad = 2 * kRadPerDeg;
constexpr double kRightShare = 0.015;         // of the model's size
constexpr double kNear_rad = 7 * kRadPerDeg;  // the right one of all poses, but not within what is asked
constexpr DurationUs kBetweenScans_us = 2'000'000;
constexpr std::uint32_t kSlice = 160'000;  // units of work, as in the component

double normal(sim::Random& random) { return random.gaussian(); }

Vec3 draw_vector(sim::Random& random) {
  const double x = normal(random), y = normal(random);
  return {x, y, normal(random)};
}

Quat draw_attitude(sim::Random& random) {
  const Vec3 v = draw_vector(random);
  return normalized(Quat(normal(random), v.x(), v.y(), v.z()));
}

class Moving final : public sim::Trajectory {
 public:
  sim::TruthState at(TimeUs t_us) const override { return {propagate(start, rates, to_seconds(t_us)), rates}; }
  Pose start;
  Twist rates;
};

struct Tally {
  int right_first = 0, right = 0, near = 0, wrong = 0, ambiguous = 0, rejected = 0, both = 0, tracked = 0;
  double worst_rad = 0, worst_m = 0, sum_rad = 0;
  std::vector<double> times_ms;
  double work = 0;              // of the first scans
  std::uint32_t most_work = 0;  // of a search, all its scans
  std::uint32_t slices = 0;
};

class Campaign {
 public:
  Campaign(const Case& c, Setting setting, double scale, std::uint64_t seed, std::uint32_t scans)
      : case_(c),
        setting_(std::move(setting)),
        scale_(scale),
        image_("model", setting_.image),
        target_(mdat::make_target(setting_.in_view)),
        seed_(seed),
        scans_(scans),
        random_(seed) {}

  // Scans are recorded instead of searched where there is a recording.
  void run(int starts, search::Recording* recording) {
    recording_ = recording;
    for (int i = 0; i < starts; ++i) {
      draw(i);
      if (recording_ != nullptr) {
        record();
      } else {
        one(i);
      }
      if ((i + 1) % (starts / 10 + 1) == 0) std::fprintf(stderr, "%d of %d starts\n", i + 1, starts);
    }
  }
  const Tally& tally() const { return tally_; }
  const std::vector<std::uint8_t>& image() const { return setting_.image; }
  double size() const { return static_cast<double>(image_.mission().search.size_m); }

 private:
  void draw(int i) {
    motion_.start.q = draw_attitude(random_);
    range_m_ = scale_ * random_.uniform(case_.range_low_m, case_.range_high_m);
    const Vec3 middle(0.02 * range_m_ * normal(random_), 0.02 * range_m_ * normal(random_), range_m_);
    motion_.start.p = middle - rotate(motion_.start.q, image_.mission().center_m);
    const Vec3 axis = draw_vector(random_).normalized();
    motion_.rates = Twist();
    motion_.rates.omega_radps = case_.spin_radps * axis;
    scan_id_ = static_cast<std::uint32_t>(i) * 4;
  }

  sim::ScannerModel camera() const {
    sim::ScannerModel model;
    const MissionParameters& p = setting_.parameters;
    if (case_.noise) {
      model.sigma0_m = p.sigma0_m;
      model.sigma_k_per_m = p.sigma_k_per_m;
    }
    model.fov_half_x_rad = p.fov_half_x_rad;
    model.fov_half_y_rad = p.fov_half_y_rad;
    model.range_min_m = p.range_min_m;
    model.range_max_m = p.range_max_m;
    model.dropout_probability = case_.dropouts;
    model.outlier_probability = case_.outliers;
    return model;
  }

  // The pattern covers the ball around the model, as far as the field of view allows.
  void scan(std::uint32_t k) {
    const Mission& mission = image_.mission();
    const Vec3 aim = motion_.start * mission.center_m;
    ScanPlan plan;
    plan.scan_id = scan_id_ + k;
    plan.points = case_.rays;
    plan.phase_turns = 0.381966 * k;
    const double full = std::tan(0.999 * setting_.parameters.fov_half_x_rad);
    const double half = std::min(full, 0.55 * size() / std::max(range_m_ - 0.3 * size(), 0.1));
    plan.half_x = plan.half_y = half;
    plan.center_x = std::clamp(aim.x() / aim.z(), half - full, full - half);
    plan.center_y = std::clamp(aim.y() / aim.z(), half - full, full - half);
    const sim::RaySimulator rays(*target_, motion_, camera(), seed_);
    const TimeUs start_us = 1000000 + k * kBetweenScans_us;
    image_scan_->scan_id = plan.scan_id;
    image_scan_->samples.clear();
    for (std::uint16_t ray = 0; ray < plan.points; ++ray) {
      RangeSample sample = rays.measure(plan.scan_id, ray, pattern_direction(plan, ray), start_us + pattern_time_us(plan, ray));
      if (case_.target == Target::kAbsent && sample.state == RayState::kHit && random_.uniform() > 0.5) sample.state = RayState::kMiss;
      if (case_.hits_only && (sample.state != RayState::kHit || image_scan_->samples.size() == 512)) continue;
      (void)image_scan_->samples.push_back(sample);
    }
    image_scan_->misses_known = !case_.hits_only;
    if (case_.target == Target::kAbsent) {  // background alone: whatever returns is chance
      for (RangeSample& sample : image_scan_->samples) {
        if (sample.state == RayState::kHit) sample.range_m = static_cast<float>(range_m_ * (0.5 + random_.uniform()));
      }
    }
  }

  void record() {
    for (std::uint32_t k = 0; k < scans_; ++k) {
      scan(k);
      recording_->add(*image_scan_);
    }
  }

  void one(int i) {
    SearchLimits limits;
    limits.scans_max = scans_;
    search_->begin(limits);
    double time_us = 0;
    for (std::uint32_t k = 0; k < scans_; ++k) {
      scan(k);
      if (!search_->joins()) search_->begin(limits);
      const double begin_us = mdat::thread_cpu_us();
      if (search_->add_scan(image_.mission(), *image_scan_, *workspace_) != Status::kOk) break;
      do ++tally_.slices;
      while (!search_->advance(image_.mission(), *workspace_, kSlice));
      time_us = mdat::thread_cpu_us() - begin_us;
      if (k == 0) tally_.work += search_->result().work;
      tally_.most_work = std::max(tally_.most_work, search_->result().work);
      tally_.times_ms.push_back(1e-3 * time_us);
      const bool accepted = search_->result().outcome == SearchOutcome::kAccepted;
      if (k == 0 && accepted && is_right()) ++tally_.right_first;
      if (accepted) break;
    }
    judge(i);
  }

  Vec6 error_of(const Pose& pose) const { return pose_difference(pose, motion_.at(search_->result().t_us).T_sensor_target); }
  bool is_right() const {
    const Vec6 e = error_of(search_->result().T_sensor_target);
    return e.head<3>().norm() < kRight_rad && e.tail<3>().norm() < kRightShare * size();
  }

  void show(int i) const {
    const SearchResult& r = search_->result();
    const Vec6 e = error_of(r.T_sensor_target);
    std::fprintf(stderr, "%d: %s %s range %.2f scans %u returns %u dis %.3f ratio %.2f off %.2f deg %.1f mm work %u candidates %zu\n", i,
                 to_string(r.outcome), to_string(r.reason), range_m_, r.scans, r.returns, r.disagreement, r.ratio,
                 e.head<3>().norm() / kRadPerDeg, 1e3 * e.tail<3>().norm(), r.work, r.candidates.size());
  }

  void judge(int i) {
    const SearchResult& r = search_->result();
    const Vec6 e = error_of(r.T_sensor_target);
    if (r.outcome == SearchOutcome::kAmbiguous) {
      ++tally_.ambiguous;
      for (const SearchCandidate& candidate : r.candidates) {
        if (error_of(candidate.T_sensor_target).head<3>().norm() < kRight_rad && r.candidates.size() >= 2) {
          ++tally_.both;
          break;
        }
      }
    }
    if (r.outcome == SearchOutcome::kRejected || r.outcome == SearchOutcome::kNone) ++tally_.rejected;
    if (r.outcome != SearchOutcome::kAccepted || !case_.may_accept() || !is_right()) {
      if (case_.may_accept() || r.outcome == SearchOutcome::kAccepted) show(i);
      if (r.outcome != SearchOutcome::kAccepted) return;
      const bool near = case_.may_accept() && e.head<3>().norm() < kNear_rad;
      ++(near ? tally_.near : tally_.wrong);
      return;
    }
    ++tally_.right;
    tally_.worst_rad = std::max(tally_.worst_rad, e.head<3>().norm());
    tally_.worst_m = std::max(tally_.worst_m, e.tail<3>().norm());
    tally_.sum_rad += e.head<3>().norm();
    const Registration next = estimator_->estimate(image_.mission(), *image_scan_, {r.T_sensor_target, r.rates, false});
    const Vec6 after = error_of(next.T_sensor_target);
    if (next.valid() && after.head<3>().norm() < kRight_rad && after.tail<3>().norm() < kRightShare * size()) ++tally_.tracked;
  }

  const Case& case_;
  Setting setting_;
  double scale_;
  mdat::LoadedImage image_;
  std::unique_ptr<sim::RayCaster> target_;
  std::uint64_t seed_;
  std::uint32_t scans_;
  sim::Random random_;
  Moving motion_;
  double range_m_ = 0;
  std::uint32_t scan_id_ = 0;
  std::unique_ptr<PoseSearch> search_ = std::make_unique<PoseSearch>();
  std::unique_ptr<Workspace> workspace_ = std::make_unique<Workspace>();
  std::unique_ptr<Estimator> estimator_ = std::make_unique<Estimator>();
  std::unique_ptr<RangeImage> image_scan_ = std::make_unique<RangeImage>();
  search::Recording* recording_ = nullptr;
  Tally tally_;
};

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void print_head() {
  std::printf("%-9s %6s %9s %6s %7s %5s %6s %9s %5s %8s %6s %8s %8s %8s %7s %8s %8s %7s\n", "case", "starts", "one scan", "right",
              "tracked", "near", "wrong", "ambiguous", "both", "rejected", "deg", "mean deg", "worst mm", "ms", "max ms", "work", "most",
              "slices");
}

void print_row(const Case& c, int starts, const Tally& t) {
  std::printf("%-9s %6d %9d %6d %7d %5d %6d %9d %5d %8d %6.2f %8.3f %8.1f %8.0f %7.0f %7.2fM %7.2fM %7.1f\n", c.name.c_str(), starts,
              t.right_first, t.right, t.tracked, t.near, t.wrong, t.ambiguous, t.both, t.rejected, t.worst_rad / kRadPerDeg,
              t.sum_rad / std::max(t.right, 1) / kRadPerDeg, 1e3 * t.worst_m, quantile(t.times_ms, 0.5), quantile(t.times_ms, 1),
              1e-6 * t.work / starts, 1e-6 * t.most_work,
              static_cast<double>(t.slices) / static_cast<double>(std::max<std::size_t>(t.times_ms.size(), 1)));
}

int run(int argc, char** argv) {
  const std::string name = argc > 2 ? argv[2] : "all";
  const int starts = argc > 3 ? mdat::count_of<int>("STARTS", argv[3], 1) : 1000;
  const std::uint64_t seed = argc > 4 ? mdat::count_of<std::uint64_t>("SEED", argv[4]) : 1;
  const int scans = argc > 5 ? mdat::count_of<int>("SCANS", argv[5], 1) : 3;
  const double scale = argc > 6 ? std::atof(argv[6]) : 1;
  const std::string folder = argc > 7 ? argv[7] : "";
  if (argc < 2 || scans > static_cast<int>(kMaxSearchScans) || !(scale > 0)) {
    std::fprintf(stderr, "usage: search MISSION [CASE = all] [STARTS = 1000] [SEED = 1] [SCANS = 3, 1 to 3] [SCALE = 1] [FOLDER]\n");
    return 2;
  }
  int wrong = 0, ran = 0;
  for (const Case& c : search::all_cases()) {
    if (name != "all" && name != c.name) continue;
    if (name == "all" && (c.name == "exact512" || (c.array_deg != 0 && !search::has_arrays(argv[1])))) continue;
    Campaign campaign(c, search::make_setting(argv[1], c, scale), scale, seed, static_cast<std::uint32_t>(scans));
    search::Recording recording;
    campaign.run(starts, folder.empty() ? nullptr : &recording);
    if (!folder.empty()) {
      recording.write(folder, campaign.image());
      return 0;
    }
    if (ran++ == 0) print_head();
    print_row(c, starts, campaign.tally());
    wrong += campaign.tally().wrong;
  }
  if (ran == 0)
    throw mdat::InputError(name +
                           ": no such case; there are clean, outliers, dropouts, clip, arrays, spin, twofold, cylinder, "
                           "sphere, panels, absent, exact512 and all");
  return wrong == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "search: %s\n", error.what());
    return 2;
  }
}
