#include "fsw/sense/pattern.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "cfg/capacities.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr double kTwoPi = 6.283185307179586;

ScanPlan generic_plan(PatternKind kind) {
  ScanPlan plan;
  plan.kind = kind;
  plan.phase_turns = 0.3819660112501051;
  plan.center_x = -0.07;
  plan.center_y = 0.11;
  plan.half_x = 0.21;
  plan.half_y = 0.13;
  return plan;
}

// The point of the square from which a direction comes: the inverse of the layout, by the definition of the tangent plane.
std::array<double, 2> square_of(const ScanPlan& plan, const Vec3& direction) {
  return {(direction.x() / direction.z() - plan.center_x) / plan.half_x, (direction.y() / direction.z() - plan.center_y) / plan.half_y};
}

double inner_share(PatternKind kind, double limit, bool round) {
  const ScanPlan plan = generic_plan(kind);
  int inside = 0;
  for (std::uint16_t i = 0; i < plan.points; ++i) {
    const auto [x, y] = square_of(plan, pattern_direction(plan, i));
    inside += round ? std::hypot(x, y) < limit : std::max(std::fabs(x), std::fabs(y)) < limit;
  }
  return inside / static_cast<double>(plan.points);
}

TEST(Pattern, RosetteFollowsItsEquation) {
  VERIFIES("LASSO-SNS-001~1");
  const ScanPlan plan = generic_plan(PatternKind::kRosette);
  for (std::uint16_t i = 0; i < plan.points; ++i) {
    const double s = i / static_cast<double>(plan.points);
    const double a = kTwoPi * (plan.cycles_a * s + plan.phase_turns);
    const double b = kTwoPi * plan.cycles_b * s;
    const Vec3 ray = pattern_direction(plan, i);
    ASSERT_NEAR(ray.norm(), 1, 1e-15);
    const auto [x, y] = square_of(plan, ray);
    ASSERT_NEAR(x, 0.5 * (std::cos(a) + std::cos(b)), 1e-12);
    ASSERT_NEAR(y, 0.5 * (std::sin(a) - std::sin(b)), 1e-12);
  }
}

TEST(Pattern, LissajousFollowsItsEquation) {
  VERIFIES("LASSO-SNS-001~1");
  const ScanPlan plan = generic_plan(PatternKind::kLissajous);
  for (std::uint16_t i = 0; i < plan.points; ++i) {
    const double s = i / static_cast<double>(plan.points);
    const auto [x, y] = square_of(plan, pattern_direction(plan, i));
    ASSERT_NEAR(x, std::sin(kTwoPi * (plan.cycles_a * s + plan.phase_turns)), 1e-12);
    ASSERT_NEAR(y, std::sin(kTwoPi * plan.cycles_b * s), 1e-12);
  }
}

TEST(Pattern, RosetteLooksAtItsMiddleMoreThanLissajous) {
  VERIFIES("LASSO-SNS-001~1");
  EXPECT_NEAR(inner_share(PatternKind::kRosette, 0.5, true), 1.0 / 3, 0.01);     // arcsine law of the radius: 2 asin(1/2) / pi
  EXPECT_NEAR(inner_share(PatternKind::kLissajous, 0.5, false), 1.0 / 9, 0.01);  // the same law on each axis
}

TEST(Pattern, RasterIsSerpentineAndFillsTheSquareEvenly) {
  VERIFIES("LASSO-SNS-002~1");
  ScanPlan plan = generic_plan(PatternKind::kRaster);
  plan.cycles_a = 32;
  plan.phase_turns = 0.5;
  for (std::uint16_t i = 0; i < plan.points; ++i) {
    const auto [x, y] = square_of(plan, pattern_direction(plan, i));
    const int line = i / 32, column = line % 2 == 0 ? i % 32 : 31 - i % 32;
    ASSERT_NEAR(x, (column + 0.5) / 16 - 1, 1e-12);
    ASSERT_NEAR(y, (line + 0.5) / 16 - 1, 1e-12);
  }
}

TEST(Pattern, RasterStaysInsideForAnyPhaseAndUnevenLines) {
  VERIFIES("LASSO-SNS-002~1");
  ScanPlan plan = generic_plan(PatternKind::kRaster);
  plan.points = 1000;
  plan.cycles_a = 37;
  for (const double phase : {0.0, 0.3, std::nextafter(1.0, 0.0)}) {
    plan.phase_turns = phase;
    double last_y = -1;
    for (std::uint16_t i = 0; i < plan.points; ++i) {
      const auto [x, y] = square_of(plan, pattern_direction(plan, i));
      ASSERT_LE(std::fabs(x), 1 + 1e-12);
      ASSERT_LE(std::fabs(y), 1);
      ASSERT_GE(y, last_y - 1e-12);
      last_y = y;
    }
    EXPECT_NEAR(last_y, 1 - 1.0 / 37, 1e-12);
  }
}

TEST(Pattern, PhaseTurnsTheRosette) {
  VERIFIES("LASSO-SNS-003~1");
  ScanPlan plan = generic_plan(PatternKind::kRosette);
  // With a phase of (a + b) / points turns, ray i - 1 is ray i of the figure without phase, turned by phase * b / (a + b) turns.
  plan.phase_turns = 0;
  ScanPlan turned = plan;
  turned.phase_turns = static_cast<double>(plan.cycles_a + plan.cycles_b) / plan.points;
  const double angle = kTwoPi * turned.phase_turns * plan.cycles_b / (plan.cycles_a + plan.cycles_b);
  for (std::uint16_t i = 1; i < plan.points; ++i) {
    const auto [x, y] = square_of(plan, pattern_direction(plan, i));
    const auto [u, v] = square_of(plan, pattern_direction(turned, static_cast<std::uint16_t>(i - 1)));
    ASSERT_NEAR(u, x * std::cos(angle) - y * std::sin(angle), 1e-12) << i;
    ASSERT_NEAR(v, x * std::sin(angle) + y * std::cos(angle), 1e-12) << i;
  }
}

TEST(Pattern, TimesAreEvenMonotoneAndEndAtTheDuration) {
  VERIFIES("LASSO-SNS-004~1");
  const ScanPlan plan = generic_plan(PatternKind::kRosette);
  EXPECT_EQ(pattern_time_us(plan, 0), 0);
  EXPECT_EQ(pattern_time_us(plan, static_cast<std::uint16_t>(plan.points - 1)), plan.duration_us);
  for (std::uint16_t i = 1; i < plan.points; ++i) {
    const double exact_us = static_cast<double>(plan.duration_us) * i / (plan.points - 1.0);
    ASSERT_EQ(pattern_time_us(plan, i), static_cast<DurationUs>(std::floor(exact_us + 1e-9)));
    ASSERT_GT(pattern_time_us(plan, i), pattern_time_us(plan, static_cast<std::uint16_t>(i - 1)));
  }
}

TEST(Pattern, TimesAreExactForAnyDurationAndAnyNumberOfPoints) {
  VERIFIES("LASSO-SNS-004~1");
  test::Generator generator(17);
  ScanPlan plan;
  for (int round = 0; round < 20000; ++round) {
    plan.points = static_cast<std::uint16_t>(2 + generator.below(0xFFFE));
    plan.duration_us =
        round == 0 ? kMaxScanDurationUs : static_cast<DurationUs>(1 + generator.below(static_cast<std::uint64_t>(kMaxScanDurationUs)));
    const auto index = static_cast<std::uint16_t>(round == 0 ? plan.points - 1 : generator.below(plan.points));
    ASSERT_EQ(pattern_time_us(plan, index), plan.duration_us * index / (plan.points - 1)) << plan.points << ' ' << plan.duration_us;
  }
}

TEST(Pattern, GeneratorAgreesWithTheClosedForm) {
  VERIFIES("LASSO-SNS-005~1");
  for (const PatternKind kind : {PatternKind::kRosette, PatternKind::kLissajous, PatternKind::kRaster}) {
    ScanPlan plan = generic_plan(kind);
    plan.points = kMaxRays;
    PatternGenerator generator(plan);
    double worst = 0;
    std::uint16_t i = 0;
    for (; !generator.done(); ++i) {
      ASSERT_EQ(generator.index(), i);
      worst = std::max(worst, (generator.next() - pattern_direction(plan, i)).norm());
    }
    EXPECT_EQ(i, plan.points);
    EXPECT_LT(worst, 1e-11);
  }
}

TEST(PatternDeathTest, RaysBeyondThePlanAreABug) {
  VERIFIES("LASSO-SNS-005~1");
  const ScanPlan plan = generic_plan(PatternKind::kRosette);
  EXPECT_DEATH((void)pattern_direction(plan, plan.points), "pattern index");
  EXPECT_DEATH((void)pattern_time_us(plan, plan.points), "pattern index");
  EXPECT_DEATH(
      {
        PatternGenerator generator(plan);
        for (int i = 0; i <= plan.points; ++i) (void)generator.next();
      },
      "no more rays");
}

TEST(PatternValidation, AcceptsExactlyTheCoprimeUnequalCycleCounts) {
  VERIFIES("LASSO-SNS-006~1");
  for (const PatternKind kind : {PatternKind::kRosette, PatternKind::kLissajous}) {
    ScanPlan plan = generic_plan(kind);
    plan.points = 64;
    for (std::uint16_t a = 0; a < 40; ++a) {
      for (std::uint16_t b = 0; b < 40; ++b) {
        plan.cycles_a = a;
        plan.cycles_b = b;
        const bool good = a >= 1 && b >= 1 && a <= 32 && b <= 32 && a != b && std::gcd(a, b) == 1;
        ASSERT_EQ(validate(plan), good ? Status::kOk : Status::kBadValue) << a << " " << b;
      }
    }
  }
}

TEST(PatternValidation, RefusesEachNumberThatIsNotFinite) {
  VERIFIES("LASSO-SNS-006~1");
  for (double ScanPlan::*member :
       {&ScanPlan::phase_turns, &ScanPlan::center_x, &ScanPlan::center_y, &ScanPlan::half_x, &ScanPlan::half_y}) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      ScanPlan plan = generic_plan(PatternKind::kRosette);
      ASSERT_EQ(validate(plan), Status::kOk);
      plan.*member = bad;
      EXPECT_EQ(validate(plan), Status::kNotFinite);
    }
  }
}

template <class T>
Status with(T ScanPlan::*member, T value, PatternKind kind = PatternKind::kRosette) {
  ScanPlan plan = generic_plan(kind);
  plan.*member = value;
  return validate(plan);
}

TEST(PatternValidation, RefusesWhatIsOutOfRange) {
  VERIFIES("LASSO-SNS-006~1");
  EXPECT_EQ(with(&ScanPlan::points, static_cast<std::uint16_t>(kMinPatternPoints - 1)), Status::kBadValue);
  EXPECT_EQ(with(&ScanPlan::points, static_cast<std::uint16_t>(kMaxRays)), Status::kOk);
  EXPECT_EQ(with(&ScanPlan::points, static_cast<std::uint16_t>(kMaxRays + 1)), Status::kBadValue);
  EXPECT_EQ(with(&ScanPlan::duration_us, DurationUs{0}), Status::kBadValue);
  EXPECT_EQ(with(&ScanPlan::duration_us, kMaxScanDurationUs + 1), Status::kBadValue);
  EXPECT_EQ(with(&ScanPlan::phase_turns, 1.0), Status::kBadValue);
  EXPECT_EQ(with(&ScanPlan::phase_turns, -1e-9), Status::kBadValue);
  EXPECT_EQ(with(&ScanPlan::half_x, 0.0), Status::kBadValue);
  EXPECT_EQ(with(&ScanPlan::half_y, -0.1), Status::kBadValue);
  EXPECT_EQ(with(&ScanPlan::center_x, -1.9), Status::kBadValue);
  EXPECT_EQ(with(&ScanPlan::center_y, 1.9), Status::kBadValue);
  EXPECT_EQ(with(&ScanPlan::kind, static_cast<PatternKind>(3)), Status::kBadValue);
  EXPECT_EQ(with(&ScanPlan::cycles_b, std::uint16_t{0}, PatternKind::kRaster), Status::kOk);
  EXPECT_EQ(with(&ScanPlan::cycles_a, std::uint16_t{0}, PatternKind::kRaster), Status::kBadValue);
  EXPECT_EQ(with(&ScanPlan::cycles_a, std::uint16_t{513}, PatternKind::kRaster), Status::kBadValue);
}

constexpr AimedRay kAimed[] = {{0.125F, -0.25F}, {-0.5F, 0.375F}, {0, 0}};

// Plans of each kind with aimed rays in the middle, and the same patterns by themselves.
struct AimedPlan {
  explicit AimedPlan(PatternKind kind) : with(generic_plan(kind)), pattern(with) {
    with.aimed = Span<const AimedRay>(kAimed);
    pattern.points = static_cast<std::uint16_t>(with.points - 3);
  }
  ScanPlan with, pattern;
};

TEST(Pattern, AimedRaysComeInTheMiddleAndThePatternAroundThem) {
  VERIFIES("LASSO-SNS-007~1");
  for (const PatternKind kind : {PatternKind::kRosette, PatternKind::kLissajous, PatternKind::kRaster}) {
    const AimedPlan plan(kind);
    ASSERT_EQ(validate(plan.with), Status::kOk);
    EXPECT_EQ(pattern_points(plan.with), 1021);
    PatternGenerator generator(plan.with);
    for (std::uint16_t i = 0; i < 1024; ++i) {
      const Vec3 ray = pattern_direction(plan.with, i);
      ASSERT_LT((generator.next() - ray).norm(), 1e-11);
      if (i < 510 || i > 512) {
        EXPECT_EQ(ray, pattern_direction(plan.pattern, static_cast<std::uint16_t>(i < 510 ? i : i - 3)));
        continue;
      }
      ASSERT_NEAR(ray.norm(), 1, 1e-15);
      EXPECT_NEAR(ray.x() / ray.z(), static_cast<double>(kAimed[i - 510].x), 1e-15);
      EXPECT_NEAR(ray.y() / ray.z(), static_cast<double>(kAimed[i - 510].y), 1e-15);
    }
    EXPECT_TRUE(generator.done());
  }
}

TEST(Pattern, AimedRaysOutsideTheLimitsAreRefused) {
  VERIFIES("LASSO-SNS-006~1");
  ScanPlan plan = generic_plan(PatternKind::kRosette);
  plan.cycles_a = 3;
  plan.cycles_b = 2;
  AimedRay rays[kMaxAimedRays + 1] = {};
  plan.aimed = Span<const AimedRay>(rays, kMaxAimedRays);
  EXPECT_EQ(validate(plan), Status::kOk);
  plan.aimed = Span<const AimedRay>(rays, kMaxAimedRays + 1);
  EXPECT_EQ(validate(plan), Status::kBadValue);
  plan.aimed = Span<const AimedRay>(rays, 100);
  plan.points = 100 + kMinPatternPoints;
  EXPECT_EQ(validate(plan), Status::kOk);
  plan.points = 100 + kMinPatternPoints - 1;
  EXPECT_EQ(validate(plan), Status::kBadValue);
  plan.points = 1024;
  for (float AimedRay::*member : {&AimedRay::x, &AimedRay::y}) {
    for (const float bad : {2.01F, -2.01F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
      rays[99] = AimedRay{};
      rays[99].*member = bad;
      EXPECT_EQ(validate(plan), Status::kBadValue);
    }
  }
}

}  // namespace
}  // namespace lasso
