// search_replay IMAGE SCANS [NUMBER...]: searches each recorded scan (ft/search/recording.hpp), or those of these numbers in ascending
// order, from 0, step by step, and says what came of it. On the emulated 603e an instruction counter (ft/ppc603e) counts each step. Exit
// codes: 0 done, 2 usage or unreadable files.
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "fsw/pose/search.hpp"
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

// One line for each: look-ups of adding the scan (none) and of each step, then the result.
void search_scan(const Mission& mission, const RangeImage& scan, Search& search, Workspace& workspace) {
  search.begin(SearchLimits());
  lasso_estimate_begins();
  const Status status = search.add_scan(mission, scan, workspace);
  lasso_estimate_ends();
  std::printf("step 0\n");
  for (bool done = status != Status::kOk; !done;) {
    const std::uint32_t before = search.result().work;
    lasso_estimate_begins();
    done = search.advance(mission, workspace, 1);
    lasso_estimate_ends();
    std::printf("step %lu\n", 0UL + search.result().work - before);
  }
  const SearchResult& r = search.result();
  std::printf("search %s %s, %lu look-ups, ratio %.17g, pose %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", to_string(r.outcome),
              to_string(r.reason), 0UL + r.work, r.ratio, r.T_sensor_target.q.x(), r.T_sensor_target.q.y(), r.T_sensor_target.q.z(),
              r.T_sensor_target.q.w(), r.T_sensor_target.p[0], r.T_sensor_target.p[1], r.T_sensor_target.p[2]);
}

// The scans that are asked for: all, or those of the numbers, ascending.
class Choice {
 public:
  Choice(int count, char** numbers) : count_(count), numbers_(numbers) {}
  bool has(unsigned long scan) {
    if (count_ == 0) return true;
    if (next_ >= count_ || std::strtoul(numbers_[next_], nullptr, 10) != scan) return false;
    ++next_;
    return true;
  }

 private:
  int count_, next_ = 0;
  char** numbers_;
};

int replay(const char* image_name, const char* scans_name, Choice choice) {
  golden::File image, scans;
  if (!golden::read_file(image_name, image)) return fail("the image cannot be read");
  if (!golden::read_file(scans_name, scans)) return fail("the scans cannot be read");
  const auto mission = std::make_unique<Mission>();
  if (load_image(image.bytes(), *mission).status != Status::kOk) return fail("the image cannot be loaded");
  const auto search = std::make_unique<Search>();
  const auto workspace = std::make_unique<Workspace>();
  const auto scan = std::make_unique<RangeImage>();
  ByteReader in(scans.bytes());
  for (unsigned long number = 0; in.remaining() > 0; ++number) {
    if (!read_scan(in, *scan)) return fail("the scans end early");
    if (choice.has(number)) search_scan(*mission, *scan, *search, *workspace);
  }
  return 0;
}

}  // namespace
}  // namespace lasso::search

int main(int argc, char** argv) {
  if (argc < 3) return lasso::search::fail("usage: search_replay IMAGE SCANS [NUMBER...]");
  return lasso::search::replay(argv[1], argv[2], {argc - 3, argv + 3});
}
