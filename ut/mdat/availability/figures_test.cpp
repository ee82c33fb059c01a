#include "mdat/availability/figures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/mdat/availability/frames.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(AvailabilityFigures, CountWhatIsValidAndNotWrong) {
  VERIFIES("LASSO-AVA-001~1");
  const std::vector<SeenFrame> frames = {pose_in(kDayLight, 3, 0.4), pose_in(kDayLight, 4, 0.3), wrong_in(kDayLight),
                                         nothing_in(kDayLight)};
  const FrameFigures figures = figures_of(frames);
  EXPECT_EQ(figures.frames, 4U);
  EXPECT_EQ(figures.available, 2U);
  EXPECT_EQ(figures.wrong, 1U);
  EXPECT_EQ(figures.share(), 0.5);
  EXPECT_NEAR(figures.rms_mm, std::sqrt(12.5), 1e-12);
  EXPECT_NEAR(figures.rms_deg, std::sqrt(0.125), 1e-12);
  EXPECT_NEAR(figures.median_mm, 3, 1e-12) << "the lower one of two";
  EXPECT_NEAR(figures.worst_mm, 4, 1e-12);
  EXPECT_NEAR(figures.median_deg, 0.3, 1e-12);
  EXPECT_NEAR(figures.worst_deg, 0.4, 1e-12);
  EXPECT_NEAR(figures.nees, 3.5, 1e-12);
  EXPECT_NEAR(figures.limits().lower, 0.0676, 1e-4) << "Clopper and Pearson of 2 in 4";
  EXPECT_NEAR(figures.limits().upper, 0.9324, 1e-4);
}

TEST(AvailabilityFigures, OfNothingAreNoNumbers) {
  VERIFIES("LASSO-AVA-001~1");
  const FrameFigures none = figures_of({nothing_in(kNightLight)});
  EXPECT_EQ(none.share(), 0);
  for (const double value : {none.median_mm, none.rms_mm, none.worst_mm, none.median_deg, none.rms_deg, none.worst_deg, none.nees})
    EXPECT_TRUE(std::isnan(value));
  EXPECT_EQ(figures_of({}).share(), 0);
}

TEST(AvailabilityFigures, TellLightsAndOrbitsApart) {
  VERIFIES("LASSO-AVA-001~1");
  const std::vector<SeenFrame> frames = {pose_in(kDayLight, 1, 1), pose_in(kDuskLight, 2, 1), nothing_in(kDuskLight),
                                         nothing_in(kNightLight)};
  EXPECT_EQ(figures_in(frames, LightPhase::kDay).frames, 1U);
  EXPECT_EQ(figures_in(frames, LightPhase::kTerminator).frames, 2U);
  EXPECT_EQ(figures_in(frames, LightPhase::kTerminator).available, 1U);
  EXPECT_EQ(figures_in(frames, LightPhase::kEclipse).available, 0U);
  const std::vector<OrbitSample> samples = {{0.5, 0, frames[0]}, {0.5, 1, frames[3]}, {0.1, 0, frames[1]}};
  EXPECT_EQ(betas_of(samples), (std::vector<double>{0.5, 0.1}));
  EXPECT_EQ(figures_of(frames_at(samples, 0.5)).frames, 2U);
  EXPECT_EQ(figures_of(frames_of(samples)).available, 2U);
}

}  // namespace
}  // namespace lasso::mdat
