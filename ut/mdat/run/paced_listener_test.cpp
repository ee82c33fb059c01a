#include "mdat/run/paced_listener.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

struct Heard final : RunListener {
  std::vector<TimeUs> boundaries;
  int frames = 0;
  void on_packets(TimeUs boundary_us, ConstBytes) override { boundaries.push_back(boundary_us); }
  void on_frame(const FlownFrame&) override { ++frames; }
};

double seconds_of(PacedListener& paced, TimeUs first_us, TimeUs period_us, int boundaries) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < boundaries; ++i) paced.on_packets(first_us + period_us * i, {});
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Never sooner than the clock; how much later a busy machine is, says nothing.
TEST(PacedListener, HoldsEachBoundaryBackUntilItsTime) {
  VERIFIES("LASSO-REC-040~1");
  Heard heard;
  PacedListener paced(heard, 10);
  EXPECT_GE(seconds_of(paced, 5'000'000, 200'000, 4), 0.06 - 1e-3) << "three periods of 0.2 s, ten times as fast";
  EXPECT_EQ(heard.boundaries, (std::vector<TimeUs>{5'000'000, 5'200'000, 5'400'000, 5'600'000}));
  const std::vector<RangeSample> none;
  const PoseTelemetry told{};
  const sim::TruthState truth{};
  paced.on_frame({told, truth, none});
  EXPECT_EQ(heard.frames, 1);
}

// An hour of the run passes at once.
TEST(PacedListener, WithoutAPaceNothingIsHeldBack) {
  VERIFIES("LASSO-REC-040~1");
  Heard heard;
  PacedListener paced(heard, 0);
  EXPECT_LT(seconds_of(paced, 0, 360'000'000, 11), 60);
  EXPECT_EQ(heard.boundaries.size(), 11U);
}

}  // namespace
}  // namespace lasso::mdat
