#include "mdat/availability/pictures.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/availability/frames.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(AvailabilityPictures, AreInTheMiddleOfEachLight) {
  VERIFIES("LASSO-AVA-001~1");
  std::vector<SeenFrame> frames(5, nothing_in(kDayLight));
  frames.insert(frames.end(), 2, nothing_in(kDuskLight));
  frames.insert(frames.end(), 3, nothing_in(kNightLight));
  EXPECT_EQ(shown_times(frames), (std::vector<std::size_t>{2, 5, 8}));
  EXPECT_EQ(shown_times({nothing_in(kNightLight)}), (std::vector<std::size_t>{0}));
  std::vector<SeenFrame> many;
  for (int i = 0; i < 20; ++i) many.push_back(nothing_in(i % 2 == 0 ? kDayLight : kNightLight));
  EXPECT_EQ(shown_times(many).size(), 6U);
}

}  // namespace
}  // namespace lasso::mdat
