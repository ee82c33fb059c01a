#include "fsw/mission/parameter_area.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <string>

#include "fsw/core/byte_codec.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/parameter_row.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::row_of;

TEST(ParameterArea, AChangeIsOverTheImagesValueUntilItIsReverted) {
  VERIFIES("LASSO-IMG-018~1");
  const MissionParameters image = preset_parameters();
  ParameterArea area;
  const std::size_t row = row_of("estimation.incidence_max_deg");
  EXPECT_EQ(area.changes(), 0u);
  ASSERT_EQ(area.set(row, 60, image), ParameterRefusal::kNone);
  MissionParameters applied = image;
  area.apply(applied);
  EXPECT_NEAR(applied.incidence_max_rad, 1.0471975511965976, 1e-15);
  EXPECT_TRUE(area.changed(row));
  EXPECT_FALSE(area.changed(row + 1));
  EXPECT_FALSE(area.changed(kMaxParameters));
  EXPECT_EQ(area.changes(), 1u);
  applied.incidence_max_rad = image.incidence_max_rad;
  EXPECT_EQ(std::memcmp(&applied, &image, sizeof image), 0) << "and nothing else";
  area.revert();
  area.apply(applied);
  EXPECT_EQ(std::memcmp(&applied, &image, sizeof image), 0);
  EXPECT_EQ(area.changes(), 0u);
}

TEST(ParameterArea, WhatIsRefusedChangesNothing) {
  VERIFIES("LASSO-IMG-018~1");
  const MissionParameters image = preset_parameters();
  ParameterArea area;
  const std::size_t coast = row_of("tracking.coast_frames");
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(area.set(parameter_rows().size(), 1, image), ParameterRefusal::kNoSuchParameter);
  for (const char* key : {"sensor.sigma0_m", "sensor.use_to_m", "scan.points", "scan.duration_s", "filter.period_s", "tracking.initial.qw"})
    EXPECT_EQ(area.set(row_of(key), parameter_rows()[row_of(key)].preset, image), ParameterRefusal::kFixed) << key;
  for (const double value : {-1.0, 1001.0, 2.5, not_a_number}) EXPECT_EQ(area.set(coast, value, image), ParameterRefusal::kOutOfLimits);
  EXPECT_EQ(area.set(row_of("short_range.enter_m"), 5, image), ParameterRefusal::kInconsistent);
  EXPECT_EQ(area.changes(), 0u);
  MissionParameters applied = image;
  EXPECT_EQ(area.set(row_of("short_range.leave_m"), 6, applied), ParameterRefusal::kNone);
  area.apply(applied);
  EXPECT_EQ(area.set(row_of("short_range.enter_m"), 5, applied), ParameterRefusal::kNone) << "in the right order";
  area.apply(applied);
  EXPECT_EQ(area.set(row_of("short_range.leave_m"), 5, applied), ParameterRefusal::kInconsistent);
}

TEST(ParameterArea, LimitsOfEveryRowAreKept) {
  VERIFIES("LASSO-IMG-018~1");
  const MissionParameters image = preset_parameters();
  std::size_t changeable = 0;
  for (std::size_t i = 0; i < parameter_rows().size(); ++i) {
    const ParameterRow& row = parameter_rows()[i];
    if (!is_changeable(i) || std::string(row.key).rfind("short_range", 0) == 0) continue;
    ++changeable;
    ParameterArea area;
    const double beyond = 1e-3 * (row.maximum - row.minimum) + 1;
    EXPECT_EQ(area.set(i, row.minimum, image), ParameterRefusal::kNone) << row.key;
    EXPECT_EQ(area.set(i, row.maximum, image), ParameterRefusal::kNone) << row.key;
    EXPECT_EQ(area.set(i, row.minimum - beyond, image), ParameterRefusal::kOutOfLimits) << row.key;
    EXPECT_EQ(area.set(i, row.maximum + beyond, image), ParameterRefusal::kOutOfLimits) << row.key;
  }
  EXPECT_GT(changeable, 40u);
  EXPECT_FALSE(is_changeable(parameter_rows().size()));
}

TEST(ParameterArea, WhatIsSavedIsTakenBackWholeOrNotAtAll) {
  VERIFIES("LASSO-IMG-019~1");
  const MissionParameters image = preset_parameters();
  ParameterArea area;
  ASSERT_EQ(area.set(row_of("tracking.coast_frames"), 33, image), ParameterRefusal::kNone);
  std::uint8_t saved[kSavedParameterBytes] = {};
  area.save(Bytes(saved));
  ParameterArea other;
  ASSERT_EQ(other.restore(ConstBytes(saved), image), ParameterRefusal::kNone);
  EXPECT_EQ(other.changes(), 1u);
  MissionParameters applied = image;
  other.apply(applied);
  EXPECT_EQ(applied.coast_frames, 33);
  const auto restored = [&](std::size_t row, double value) {
    std::uint8_t changed[kSavedParameterBytes] = {};
    std::copy(std::begin(saved), std::end(saved), changed);
    changed[4 + row / 32 * 4 + 3 - row % 32 / 8] |= static_cast<std::uint8_t>(1U << row % 8);
    ByteWriter writer(Bytes(changed).subspan(4 + kMaxParameters / 8 + 8 * row, 8));
    writer.f64(value);
    return other.restore(ConstBytes(changed), image);
  };
  EXPECT_EQ(restored(0, 1), ParameterRefusal::kFixed);
  EXPECT_EQ(restored(kMaxParameters - 1, 1), ParameterRefusal::kFixed);
  EXPECT_EQ(restored(row_of("tracking.coast_frames"), -7), ParameterRefusal::kOutOfLimits);
  EXPECT_EQ(restored(row_of("short_range.enter_m"), 5), ParameterRefusal::kInconsistent);
  saved[2] ^= 1U;
  EXPECT_EQ(other.restore(ConstBytes(saved), image), ParameterRefusal::kOtherTable);
  EXPECT_EQ(other.changes(), 1u) << "what was refused changes nothing";
}

// Every single bit of one copy; then one of each.
TEST(ParameterArea, EveryFlipInOneCopyIsRepairedFromTheOther) {
  VERIFIES("LASSO-IMG-018~1");
  const MissionParameters image = preset_parameters();
  ParameterArea area;
  ASSERT_EQ(area.set(row_of("tracking.coast_frames"), 33, image), ParameterRefusal::kNone);
  EXPECT_EQ(area.check(), AreaState::kRight);
  for (const std::size_t which : {std::size_t{0}, std::size_t{1}}) {
    for (std::size_t bit = 0; bit < 8 * area.copy(which).size(); bit += 7) {
      area.copy(which)[bit / 8] = static_cast<std::uint8_t>(area.copy(which)[bit / 8] ^ 1U << bit % 8);
      ASSERT_EQ(area.check(), AreaState::kRepaired) << bit;
      ASSERT_EQ(area.check(), AreaState::kRight);
    }
  }
  MissionParameters applied = image;
  area.apply(applied);
  EXPECT_EQ(applied.coast_frames, 33);
  area.copy(0)[3] ^= 1U;
  area.copy(1)[9] ^= 1U;
  EXPECT_EQ(area.check(), AreaState::kLost);
  EXPECT_EQ(area.changes(), 0u) << "the image's hold";
  EXPECT_EQ(area.check(), AreaState::kRight);
}

}  // namespace
}  // namespace lasso
