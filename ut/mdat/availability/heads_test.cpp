#include "mdat/availability/heads.hpp"

#include <gtest/gtest.h>

#include "mdat/common/errors.hpp"
#include "mdat/stereo/stereo_maker.hpp"
#include "ut/support/places.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

HeadsMission shipped_mission(const std::string& name = "day_and_night.toml", const std::vector<std::string>& settings = {}) {
  return {(test::source_folder() / "cfg/missions" / name).string(), settings, true};
}

std::string refusal_of(const HeadsMission& mission, const std::string& scenario) {
  try {
    for (const Head& head : heads_of(mission)) static_cast<void>(input_of_head(mission, head, scenario));
  } catch (const InputError& error) {
    return error.what();
  } catch (const MissionError& error) {
    return error.what();
  }
  return "";
}

TEST(Heads, AreOneMissionWithThreeSensors) {
  VERIFIES("LASSO-AVA-001~1");
  const HeadsMission mission = shipped_mission("day_and_night.toml", {"stereo.lamp_Wpsr=40", "scan.points=512"});
  const std::vector<Head> heads = heads_of(mission);
  ASSERT_EQ(heads.size(), 3U);
  const SensorKind kinds[] = {SensorKind::kLaserCamera, SensorKind::kStereo, SensorKind::kStereo};
  const double lamps[] = {0, 0, 40};
  for (std::size_t i = 0; i < heads.size(); ++i) {
    const MissionSource source = input_of_head(mission, heads[i], "approach", {"orbit.beta_deg=10"}).source;
    EXPECT_EQ(source.sensor, kinds[i]) << heads[i].key;
    EXPECT_EQ(source.stereo.lamp_Wpsr, lamps[i]) << heads[i].key;
    EXPECT_EQ(source.parameters.points, 512) << heads[i].key;
    EXPECT_EQ(has_stereo_head(source), i > 0);
  }
  EXPECT_EQ(input_of_head(shipped_mission(), heads_of(shipped_mission("day_and_night.toml", {"stereo.lamp_Wpsr=0"}))[2], "approach")
                .source.stereo.lamp_Wpsr,
            26)
      << "a lamp is flown in any case";
}

TEST(Heads, NeedALightThatAnOrbitMakes) {
  VERIFIES("LASSO-AVA-002~1");
  EXPECT_EQ(refusal_of(shipped_mission(), "hold"), "");
  const std::string other = refusal_of(shipped_mission("hubble_tenth.toml"), "spin");
  EXPECT_NE(other.find("hubble_tenth.toml: scenario spin has no light of an orbit: expected nodes without ranges_m, and [orbit]"),
            std::string::npos)
      << other;
  EXPECT_NE(refusal_of(shipped_mission(), "no_such").find("no_such"), std::string::npos);
  const std::string kind = refusal_of(shipped_mission("day_and_night.toml", {"sensor.kind=flash_lidar"}), "hold");
  EXPECT_NE(kind.find("--set sensor.kind=flash_lidar: this command flies each kind"), std::string::npos) << kind;
}

}  // namespace
}  // namespace lasso::mdat
