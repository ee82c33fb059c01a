#include "mdat/campaign/run_junit.hpp"

#include <gtest/gtest.h>

#include "mdat/common/errors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// Two runs of three frames, by their ranges: in the second the last valid pose is wrong.
SimulationResult two_runs() {
  SimulationResult result;
  result.mission = "tenth & more";
  result.scenario = "spin";
  result.frames = 3;
  TableResult table;
  table.scenario.ranges_m = {2, 4};
  VariantResult variant;
  variant.variant.name = "noisy";
  variant.cases.resize(2);
  for (CaseResult& run : variant.cases) {
    for (std::uint32_t number = 0; number < 3; ++number) {
      FrameError frame;
      frame.frame = number;
      frame.t_s = 0.2 * number;
      frame.range_m = 4;
      frame.reported = frame.valid = true;
      frame.registration.translation_m = Vec3(0.003, 0.004, 0);
      run.frames.push_back(frame);
    }
  }
  FrameError& last = variant.cases[1].frames.back();
  last.wrong = true;
  last.registration.translation_m = Vec3(0.024, 0, -0.007);
  last.registration.rotation_rad = 0.5 * kRadPerDeg;
  table.variants.push_back(variant);
  result.tables.push_back(table);
  return result;
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(RunJunit, FailsARunWithAWrongPoseAndSaysWhere) {
  VERIFIES("LASSO-GND-140~1");
  const std::string text = run_junit_xml(two_runs(), {});
  expect_part(text, "<testsuite name=\"tenth &amp; more\" tests=\"2\" failures=\"1\" errors=\"0\" time=\"0\" skipped=\"0\">");
  expect_part(text, "<testcase classname=\"run.spin.noisy\" name=\"2 m: no_wrong_pose\" time=\"0\"/>");
  expect_part(text,
              "<failure type=\"failed\" message=\"wrong &lt;= 0: it is 1\">The first wrong pose is that of frame 2, 0.400 s after the "
              "start at 4.000 m: off by 25.000 mm and 0.5000 deg.</failure>");
}

TEST(RunJunit, HasACaseForEachRequirementOfTheCommandLine) {
  VERIFIES("LASSO-GND-140~1");
  const std::string text = run_junit_xml(two_runs(), {required_criterion("worst_mm <= 5.5"), required_criterion("valid >= 3")});
  expect_part(text, "tests=\"6\" failures=\"2\"");
  expect_part(text, "name=\"2 m: worst_mm &lt;= 5.5\" time=\"0\"/>");
  expect_part(text, "message=\"worst_mm &lt;= 5.5: it is 25\"");
  expect_part(text, "name=\"4 m: valid &gt;= 3\" time=\"0\"/>");
}

TEST(RunJunit, AFigureThatIsNotThereFails) {
  VERIFIES("LASSO-GND-140~1");
  SimulationResult result = two_runs();
  for (FrameError& frame : result.tables[0].variants[0].cases[0].frames) frame.valid = false;
  expect_part(run_junit_xml(result, {required_criterion("rms_mm <= 100")}),
              "message=\"rms_mm &lt;= 100: there is no valid pose to tell it\"");
}

TEST(RunJunit, TellsWhatARequirementHasToSay) {
  VERIFIES("LASSO-GND-140~1");
  for (const char* text : {"", "worst_mm", "worst_mm < 5", "worst_mm <= many", "worst_mm <= 5 mm", "worst_mm <= inf", "width_mm <= 5"}) {
    try {
      (void)required_criterion(text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      expect_part(error.what(), "--require '" + std::string(text) + "': ");
    }
  }
}

}  // namespace
}  // namespace lasso::mdat
