// stage_bench MISSION [Google Benchmark's options]: the time of the whole estimate and of each of its stages on noisy scans of all ranges.
// Each stage works on what the stages before it leave; these run untimed. Times are processor time of the thread.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <exception>

#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/estimator/estimator.hpp"
#include "fsw/pose/registration/agreement.hpp"
#include "fsw/pose/registration/gauss_newton.hpp"
#include "fsw/pose/registration/registration.hpp"
#include "fsw/pose/scan/prepare.hpp"
#include "fsw/pose/silhouette/label_update.hpp"
#include "fsw/pose/silhouette/silhouette.hpp"
#include "ft/bench/scans.hpp"
#include "mdat/common/cpu_clock.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/source/mission_error.hpp"

namespace {

using namespace lasso;
using bench::Scan;

constexpr std::uint32_t kStride = 18;  // 20 of the paper's 360 frames in each range
constexpr std::size_t kRounds = 5;     // over all scans
constexpr int kLoads = 20;

// The scan that a stage works on, and what the stages before it made of it.
struct Bench {
  std::unique_ptr<mdat::LoadedImage> hits_image, silhouettes_image;
  std::vector<std::uint8_t> image;
  std::vector<Scan> scans;
  Estimator estimator;
  Workspace workspace;
  RangeImage range_image;
  StartPoint start;
  HitSolution hits;
  LabelSearch search;
  PoseBelief belief;
  std::size_t next = 0;

  const Mission& mission() const { return silhouettes_image->mission(); }
};

void next_scan(Bench& b) {
  const Scan& scan = b.scans[b.next++ % b.scans.size()];
  to_range_image(scan, b.range_image);
  b.start = {scan.start, Twist(), false};
}

void until_prepared(Bench& b) {
  next_scan(b);
  prepare_rays(b.mission(), b.range_image, b.start, b.workspace);
}

void until_registered(Bench& b) {
  until_prepared(b);
  b.hits = register_hits(b.mission(), inverse(b.start.T_sensor_target), b.workspace);
}

void until_search(Bench& b) {
  until_registered(b);
  const MissionParameters& p = b.mission().parameters;
  const double range_m = b.hits.T_target_sensor.p.norm();
  b.search.range_sigma_m = std::hypot(p.sigma0_m, p.sigma_k_per_m * range_m * range_m);
  b.search.band_m = p.silhouette_band_m;
  if (invert6(b.hits.H, b.search.covariance) != Status::kOk) throw mdat::RunError("a scan leaves a direction open");
}

void until_labelled(Bench& b) {
  until_search(b);
  find_labels(b.mission(), b.hits.T_target_sensor, b.search, b.workspace);
  b.belief.mean.setZero();
  b.belief.covariance = b.search.covariance;
}

void estimate_hits(Bench& b) { benchmark::DoNotOptimize(b.estimator.estimate(b.hits_image->mission(), b.range_image, b.start)); }
void estimate_silhouettes(Bench& b) { benchmark::DoNotOptimize(b.estimator.estimate(b.mission(), b.range_image, b.start)); }
void prepare_stage(Bench& b) { prepare_rays(b.mission(), b.range_image, b.start, b.workspace); }
void register_stage(Bench& b) { b.hits = register_hits(b.mission(), inverse(b.start.T_sensor_target), b.workspace); }
void labels_stage(Bench& b) { find_labels(b.mission(), b.hits.T_target_sensor, b.search, b.workspace); }
void apply_stage(Bench& b) { apply_labels(b.workspace.labels.span(), b.mission().parameters, b.belief); }

void agreement_stage(Bench& b) {
  const Expectation expectation(b.mission(), b.hits.T_target_sensor, {});
  benchmark::DoNotOptimize(agreement_of_rays(b.mission(), expectation, true, b.workspace));
}

// One pass over all points at the registered pose: every ray walks through the field, nothing is remembered from the pass before.
void walk_stage(Bench& b) {
  const MatchSettings<FlightNumber> settings = make_settings(b.mission().parameters, b.workspace);
  PassSums<FlightNumber> sums(b.mission().radius_m);
  Span<MatchPoint<FlightNumber>> points(b.workspace.points.begin(), b.workspace.points.size());
  match_points(b.mission().field, to_path<FlightNumber>(b.hits.T_target_sensor), settings, points, {1, Lookup::kWalk}, sums);
  benchmark::DoNotOptimize(sums);
}

using Step = void (*)(Bench&);

void time_stage(benchmark::State& state, Bench* bench, Step before, Step stage) {
  bench->next = 0;
  for (auto _ : state) {
    before(*bench);
    const double begin_us = mdat::thread_cpu_us();
    stage(*bench);
    state.SetIterationTime(1e-6 * (mdat::thread_cpu_us() - begin_us));
  }
}

// Validation of the whole image, and its conversion in place.
void time_load(benchmark::State& state, const Bench* bench) {
  for (auto _ : state) {
    std::vector<std::uint64_t> memory = mdat::aligned_copy(bench->image);
    Mission mission;
    const double begin_us = mdat::thread_cpu_us();
    const LoadFailure failure = load_image(mdat::view(memory, bench->image.size()), mission);
    state.SetIterationTime(1e-6 * (mdat::thread_cpu_us() - begin_us));
    if (failure.status != Status::kOk) state.SkipWithError("the image was refused");
  }
}

struct Stage {
  const char* name;
  Step before, stage;
};
constexpr Stage kStages[] = {{"estimate/hits", next_scan, estimate_hits},       {"estimate/silhouettes", next_scan, estimate_silhouettes},
                             {"prepare_rays", next_scan, prepare_stage},        {"register_hits", until_prepared, register_stage},
                             {"walk_all_points", until_registered, walk_stage}, {"find_labels", until_search, labels_stage},
                             {"apply_labels", until_labelled, apply_stage},     {"agreement_of_rays", until_registered, agreement_stage}};

std::unique_ptr<Bench> make_bench(const char* mission_file) {
  const mdat::CompiledMission mission = mdat::compile_mission(mission_file);
  auto bench = std::make_unique<Bench>();
  bench::ScanOptions options;
  options.stride = kStride;
  bench->hits_image = bench::make_image(mission, options.scenario, false);
  bench->silhouettes_image = bench::make_image(mission, options.scenario, true);
  bench->image = mdat::image_bytes(mission, bench->mission().parameters);
  bench->scans = bench::make_scans(mission, options);
  return bench;
}

void run(const char* mission_file) {
  const std::unique_ptr<Bench> bench = make_bench(mission_file);
  const auto rounds = static_cast<benchmark::IterationCount>(kRounds * bench->scans.size());
  const auto set_up = [](benchmark::internal::Benchmark* b, benchmark::IterationCount n) {
    b->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(n);
  };
  for (const Stage& s : kStages) set_up(benchmark::RegisterBenchmark(s.name, time_stage, bench.get(), s.before, s.stage), rounds);
  set_up(benchmark::RegisterBenchmark("load_image", time_load, bench.get()), kLoads);
  benchmark::RunSpecifiedBenchmarks();
}

int refuse(const std::exception& error, int exit_code) {
  std::fprintf(stderr, "stage_bench: %s\n", error.what());
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);  // takes its own options away
  if (argc != 2) {
    std::fprintf(stderr, "stage_bench: usage: stage_bench MISSION [--benchmark_...]\n");
    return mdat::kExitBadInput;
  }
  try {
    run(argv[1]);
    return mdat::kExitDone;
  } catch (const mdat::InputError& error) {
    return refuse(error, mdat::kExitBadInput);
  } catch (const mdat::MissionError& error) {
    return refuse(error, mdat::kExitBadInput);
  } catch (const std::exception& error) {
    return refuse(error, mdat::kExitFailed);
  }
}
