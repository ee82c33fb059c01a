#include "mdat/paper/laboratory.hpp"

#include <cmath>
#include <limits>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr auto kPlaceOfZ = static_cast<std::size_t>(LaboratoryFigure::kZ);

StandResult stand_with(double z_m) {
  StandResult stand;
  stand.errors.fill(kNone);
  stand.errors[kPlaceOfZ] = z_m;
  return stand;
}

std::array<Variances, kLaboratoryFigures> budget_with(double noise_m2, double mock_up_m2) {
  std::array<Variances, kLaboratoryFigures> budget{};
  budget[kPlaceOfZ] = {noise_m2, 0, 0, mock_up_m2};
  return budget;
}

// Two ranges, two stands, two mock-ups; one stand of the second range has no estimate.
LaboratoryResult two_ranges() {
  LaboratoryResult result;
  result.stands = 2;
  result.mock_ups = 2;
  result.ranges.push_back(
      {"near", 2, {stand_with(1), stand_with(-2), stand_with(3), stand_with(-4)}, {budget_with(1, 3), budget_with(2, 4)}});
  result.ranges.push_back(
      {"far", 7, {stand_with(5), stand_with(kNone), stand_with(-1), stand_with(2)}, {budget_with(9, 16), budget_with(100, 0)}});
  return result;
}

TEST(Laboratory, ErrorsAndBudgetAreOfTheSameStands) {
  VERIFIES("LASSO-MDT-121~1 LASSO-MDT-122~1");
  const LaboratoryResult result = two_ranges();
  const FigureErrors near = figure_errors(result, LaboratoryFigure::kZ, 0);
  EXPECT_EQ(near.count, 4U);
  EXPECT_DOUBLE_EQ(near.mean_abs, 2.5);
  EXPECT_DOUBLE_EQ(near.std_abs, std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(near.rms, std::sqrt(30.0 / 4));
  EXPECT_DOUBLE_EQ(near.budget, std::sqrt((4 + 6 + 4 + 6) / 4.0));
  EXPECT_DOUBLE_EQ(near.budget_by_source[0], std::sqrt(1.5));
  EXPECT_DOUBLE_EQ(near.budget_by_source[3], std::sqrt(3.5));
  const FigureErrors far = figure_errors(result, LaboratoryFigure::kZ, 1);
  EXPECT_EQ(far.count, 3U) << "a stand without an estimate counts on neither side";
  EXPECT_DOUBLE_EQ(far.rms, std::sqrt(30.0 / 3));
  EXPECT_DOUBLE_EQ(far.budget, std::sqrt((25 + 25 + 100) / 3.0));
  const FigureErrors all = figure_errors(result, LaboratoryFigure::kZ);
  EXPECT_EQ(all.count, 7U);
  EXPECT_DOUBLE_EQ(all.rms, std::sqrt(60.0 / 7));
  EXPECT_DOUBLE_EQ(all.budget, std::sqrt(170.0 / 7));
  EXPECT_DOUBLE_EQ(all.ratio(), std::sqrt(60.0 / 170));
}

TEST(Laboratory, ABudgetIsHeldUpToATenthMore) {
  VERIFIES("LASSO-MDT-123~1");
  FigureErrors errors;
  errors.budget = 2;
  errors.rms = 2.19;
  EXPECT_TRUE(errors.held());
  errors.rms = 2.21;
  EXPECT_FALSE(errors.held());
  errors.rms = kNone;
  EXPECT_FALSE(errors.held()) << "no stand, no budget that is held";
}

}  // namespace
}  // namespace lasso::mdat
