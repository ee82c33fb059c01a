// search_replay IMAGE SCANS EACH [NUMBER...]: searches recorded scans (ft/search/recording.hpp), EACH of them in a row showing one target,
// or the targets of these numbers in ascending order, from 0. A scan is worked on step by step in slices of frame_work units, the
// first one with its adding, as the component does; one that is not accepted is joined by the next, or a new search begins there. On the
// emulated 603e an instruction counter (ft/ppc603e) counts each step. Exit codes: 0 done, 2 usage or unreadable files.
//
// Says "step STAGE UNITS" of each pass that is counted, "slice" after the steps of a slice, "scan RESULT" after those of a scan,
// "search" after the scans of a search, and "target" after the searches of a target.
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "fsw/mode/searcher.hpp"
#include "ft/golden/files.hpp"
#include "ft/golden/trace.hpp"

// Where the counter begins and ends to count: addresses to find in the executable.
extern "C" {
[[gnu::noinline]] void lasso_estimate_begins() { asm volatile(""); }
[[gnu::noinline]] void lasso_estimate_ends() { asm volatile("" ::: "memory"); }
}

namespace lasso::search {
namespace {

int fail(const char* what) {
  std::fprintf(stderr, "search_replay: %s\n", what);
  return 2;
}

// False where the bytes end early or do not fit.
bool read_scan(ByteReader& in, RangeImage& scan) {
  scan.samples.clear();
  SensorPoll poll;
  while (!poll.complete) {
    RangeSample samples[kMaxSamplesPerPoll];
    if (!golden::get_answer(in, poll, Span<RangeSample>(samples))) return false;
    for (std::size_t i = 0; i < poll.count; ++i) {
      if (!scan.samples.push_back(samples[i])) return false;
    }
  }
  return true;
}

// By PoseSearch::Stage.
constexpr const char* kStages[] = {"none",   "subset",      "view_matching", "align_on_distances", "align_on_rays", "fast_refine",
                                   "refine", "line_search", "robust_refine", "symmetry_test",      "acceptance"};

// The work of one counted pass.
template <class Act>
std::uint32_t count(const char* stage, const PoseSearch& search, Act act) {
  const std::uint32_t before = search.result().work;
  lasso_estimate_begins();
  act();
  lasso_estimate_ends();
  const std::uint32_t work = search.result().work - before;
  std::printf("step %s %lu\n", stage, 0UL + work);
  return work;
}

void tell(const SearchResult& r) {
  std::printf("scan %s %s, %lu units of work, ratio %.17g, pose %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", to_string(r.outcome),
              to_string(r.reason), 0UL + r.work, r.ratio, r.T_sensor_target.q.x(), r.T_sensor_target.q.y(), r.T_sensor_target.q.z(),
              r.T_sensor_target.q.w(), r.T_sensor_target.p[0], r.T_sensor_target.p[1], r.T_sensor_target.p[2]);
}

void search_scan(const Mission& mission, const RangeImage& scan, PoseSearch& search, Workspace& workspace) {
  std::uint32_t used = count("adding", search, [&] { static_cast<void>(search.add_scan(mission, scan, workspace)); });
  while (search.busy()) {
    while (search.busy() && used < frame_work(mission.parameters)) {
      const char* stage = kStages[static_cast<std::size_t>(search.stage())];
      used += count(stage, search, [&] { static_cast<void>(search.advance(mission, workspace, 1)); });
    }
    std::printf("slice\n");
    used = 0;
  }
  tell(search.result());
}

// The scan joins the search, or begins another one.
void join(const Mission& mission, const RangeImage& scan, PoseSearch& search, Workspace& workspace) {
  if (!search.joins()) {
    std::printf("search\n");
    search.begin(SearchLimits());
  }
  search_scan(mission, scan, search, workspace);
}

// The targets that are asked for: all, or those of the numbers, ascending.
class Choice {
 public:
  Choice(int count, char** numbers) : count_(count), numbers_(numbers) {}
  bool has(unsigned long target) {
    if (count_ == 0) return true;
    if (next_ >= count_ || std::strtoul(numbers_[next_], nullptr, 10) != target) return false;
    ++next_;
    return true;
  }

 private:
  int count_, next_ = 0;
  char** numbers_;
};

int replay(const char* image_name, const char* scans_name, unsigned long each, Choice choice) {
  golden::File image, scans;
  if (!golden::read_file(image_name, image)) return fail("the image cannot be read");
  if (!golden::read_file(scans_name, scans)) return fail("the scans cannot be read");
  const auto mission = std::make_unique<Mission>();
  if (load_image(image.bytes(), *mission).status != Status::kOk) return fail("the image cannot be loaded");
  const auto search = std::make_unique<PoseSearch>();
  const auto workspace = std::make_unique<Workspace>();
  const auto scan = std::make_unique<RangeImage>();
  ByteReader in(scans.bytes());
  for (unsigned long number = 0; in.remaining() > 0; ++number) {
    const bool wanted = choice.has(number);
    search->begin(SearchLimits());
    for (unsigned long k = 0; k < each; ++k) {
      if (!read_scan(in, *scan)) return fail("the scans end early");
      if (wanted && search->result().outcome != SearchOutcome::kAccepted) join(*mission, *scan, *search, *workspace);
    }
    if (wanted) std::printf("search\ntarget\n");
  }
  return 0;
}

}  // namespace
}  // namespace lasso::search

int main(int argc, char** argv) {
  const unsigned long each = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 0;
  if (each == 0) return lasso::search::fail("usage: search_replay IMAGE SCANS EACH [NUMBER...]");
  return lasso::search::replay(argv[1], argv[2], each, {argc - 4, argv + 4});
}
