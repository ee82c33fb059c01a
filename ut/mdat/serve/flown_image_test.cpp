#include "mdat/serve/flown_image.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mdat/run/case.hpp"
#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

const ValidityGate& gate(const std::vector<ValidityGate>& gates, const std::string& name) {
  for (const ValidityGate& row : gates) {
    if (row.name == name) return row;
  }
  throw std::out_of_range(name);
}

TEST(FlownImage, GatesAreThoseOfTheImage) {
  VERIFIES("LASSO-WEB-010~1");
  MissionParameters parameters = preset_parameters();
  parameters.inliers_min = 40;
  parameters.inlier_share_min = 0.6;
  const std::vector<ValidityGate> passed = validity_gates(SmallRecording{}.told(1), parameters);
  for (const ValidityGate& row : passed) EXPECT_TRUE(row.pass) << row.name;
  EXPECT_EQ(gate(passed, "inliers").value, 291);
  EXPECT_EQ(gate(passed, "inliers").limit, 40);
  EXPECT_EQ(gate(passed, "inlier share").limit, 0.6);
  const std::vector<ValidityGate> refused = validity_gates(SmallRecording{}.told(2), parameters);
  for (const ValidityGate& row : refused) EXPECT_EQ(row.pass, row.name != "inliers") << row.name;
  EXPECT_TRUE(validity_gates(SmallRecording{}.told(4), parameters).empty());  // no registration ran
}

// A mode may ask for more than the limit: what the component refused is not shown as passed.
TEST(FlownImage, TheReasonsGateIsNeverShownAsPassed) {
  VERIFIES("LASSO-WEB-010~1");
  PoseTelemetry told = SmallRecording{}.told(1);
  told.valid = 0;
  told.reason = static_cast<std::uint8_t>(PoseReason::kLowInlierShare);
  EXPECT_FALSE(gate(validity_gates(told, preset_parameters()), "inlier share").pass);
  told.reason = static_cast<std::uint8_t>(PoseReason::kHighResidual);
  told.normalized_residual = 9;
  EXPECT_FALSE(gate(validity_gates(told, preset_parameters()), "normalised residual").pass);
}

TEST(FlownImage, WhySaysReasonFiguresAndRemedy) {
  VERIFIES("LASSO-WEB-010~1");
  const PoseTelemetry told = SmallRecording{}.told(2);
  const std::string why = why_text(told, validity_gates(told, preset_parameters()));
  EXPECT_NE(why.find("too_few_inliers: too few returns lie on the model"), std::string::npos) << why;
  EXPECT_NE(why.find("(inliers 7, at least"), std::string::npos) << why;
  EXPECT_NE(why.find("What helps: start anew from a better pose"), std::string::npos) << why;
  EXPECT_EQ(why_text(SmallRecording{}.told(1), {}).rfind("valid: ", 0), 0U);
  PoseTelemetry safe = told;
  safe.mode = static_cast<std::uint8_t>(TrackingMode::kSafe);
  EXPECT_EQ(why_text(safe, {}), "not valid: the component is in mode safe: no scans, the laser inhibited; left by command alone");
  PoseTelemetry unknown;
  unknown.reason = 200;
  EXPECT_NE(why_text(unknown, {}).find("200"), std::string::npos);
}

// A covariance with one loose direction by construction.
TEST(FlownImage, WeakDirectionsAreTheLooseOnes) {
  VERIFIES("LASSO-WEB-010~1");
  const TestFolder folder;
  const Recording recording(SmallRecording{}.write(folder.path() / "a.mcap"));
  ASSERT_NE(recording.image(), nullptr);
  const MissionParameters& p = recording.image()->mission().parameters;
  Mat6 covariance = Mat6::Identity() * 1e-12;
  EXPECT_TRUE(weak_directions(covariance, *recording.image()).empty());
  const double sigma_m = 3 * std::max(p.sigma_position_max_m, p.sigma_attitude_max_rad * recording.image()->mission().radius_m);
  covariance(4, 4) = sigma_m * sigma_m;  // translation y
  const std::vector<WeakDirection> weak = weak_directions(covariance, *recording.image());
  ASSERT_EQ(weak.size(), 1U);
  EXPECT_NEAR(weak[0].sigma_m, sigma_m, 1e-9);
  EXPECT_NEAR(std::abs(weak[0].direction[1]), 1, 1e-6);  // translation first
}

}  // namespace
}  // namespace lasso::mdat::serve
