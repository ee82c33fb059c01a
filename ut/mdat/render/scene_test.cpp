#include "mdat/render/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/common/errors.hpp"
#include "ut/support/places.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

MissionInput shipped(const std::string& name, const std::vector<std::string>& settings = {}) {
  return load_mission_input(test::source_folder() / "cfg/missions" / name, settings, settings.empty() ? "" : "paper");
}

const MissionInput& tenth() {
  static const MissionInput mission = shipped("hubble_tenth.toml");
  return mission;
}

std::string error_of(const MissionInput& mission, const SceneRequest& request) {
  try {
    static_cast<void>(make_scene(mission, request));
  } catch (const InputError& error) {
    return error.what();
  } catch (const MissionError& error) {
    return error.what();
  }
  return "no error";
}

void expect_says(const std::string& error, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(error.find(word), std::string::npos) << "expected '" << word << "' in: " << error;
}

// The pose of the mission's first frame at 4 m is written in its file, [tracking.initial].
TEST(Scene, ShowsTheTruePoseOfTheScenario) {
  VERIFIES("LASSO-PIC-001~1");
  SceneRequest request;
  request.range_m = 4;
  const Scene scene = make_scene(tenth(), request);
  EXPECT_EQ(scene.scenario, "paper");
  EXPECT_LT((scene.T_sensor_target.p - Vec3(0.02, -0.01, 4)).norm(), 1e-12);
  const Quat written(0.730969826988, -0.088182217301, -0.096234003384, -0.669810439735);
  EXPECT_LT(scene.T_sensor_target.q.angularDistance(written), 1e-9);
  EXPECT_NEAR(scene.fov_half_x_rad, 15 * kRadPerDeg, 1e-12);
}

TEST(Scene, MovesWithTime) {
  VERIFIES("LASSO-PIC-001~1");
  SceneRequest request;
  request.scenario = "spin";
  const Quat before = make_scene(tenth(), request).T_sensor_target.q;
  request.time_s = 7;  // at 5 deg/s
  EXPECT_NEAR(make_scene(tenth(), request).T_sensor_target.q.angularDistance(before), 35 * kRadPerDeg, 1e-9);
}

// The inspector crosses the line of sight; its path and that of the chaser are closed forms.
TEST(Scene, ShowsAllBodiesInTheLightOfTheOrbit) {
  VERIFIES("LASSO-PIC-016~1");
  const MissionInput mission = shipped("rendezvous.toml");
  SceneRequest request;
  request.scenario = "approach";
  for (const auto& [time_s, share] : {std::pair{75.0, 0.5}, std::pair{110.0, 1.0}}) {  // of the inspector's way: u^2 (3 - 2 u)
    request.time_s = time_s;
    const Scene scene = make_scene(mission, request);
    const SceneRun& run = *scene.setup.scenario.scene;
    const Vec3 inspector = Vec3(-12, -22, 6) + share * Vec3(24, 0, -12);  // Hill frame
    const Pose T_sensor_root = run.tree.state(0, run.sensor, to_us(time_s)).T_a_b;
    const Vec3 middle = rotate(T_sensor_root.q, inspector) + T_sensor_root.p, way = middle.normalized();
    const Pose T_target_sensor = inverse(scene.T_sensor_target);
    SurfacePoint point;
    ASSERT_TRUE(scene.surface->find(T_target_sensor.p, rotate(T_target_sensor.q, way), point));
    EXPECT_EQ(point.body, 2U);
    EXPECT_EQ(scene.parts[point.part].substr(0, 10), "inspector.");
    EXPECT_NEAR(point.range_m, middle.norm(), 1.5);  // its bus is 1.2 to 2 m long
    // The Sun is 25 deg above the orbit's plane, and at noon in the direction of x.
    const double angle = (20 * kRadPerDeg) + time_s * std::sqrt(3.986004418e14 / std::pow(6371008.8 + 540e3, 3));
    const double beta = 25 * kRadPerDeg;
    const Vec3 sun_hill(std::cos(beta) * std::cos(angle), -std::cos(beta) * std::sin(angle), std::sin(beta));
    ASSERT_TRUE(scene.orbit_lights && scene.orbit_lights->sun);
    EXPECT_LT((*scene.orbit_lights->sun - rotate(T_sensor_root.q, sun_hill)).norm(), 1e-9);
    EXPECT_LT((*scene.orbit_lights->earth - rotate(T_sensor_root.q, Vec3(-1, 0, 0))).norm(), 1e-9);
  }
}

// Of the part of this name; what its material is checked for has to be there.
const Material& material_of_part(const Scene& scene, const std::string& part) {
  const auto found = std::find(scene.parts.begin(), scene.parts.end(), part);
  if (found == scene.parts.end()) throw std::runtime_error("no part " + part);
  return scene.materials.at(static_cast<std::size_t>(found - scene.parts.begin()));
}

TEST(Scene, TakesTheMissionsMaterials) {
  VERIFIES("LASSO-PIC-018~1");
  const MissionInput mission = shipped(
      "hubble_tenth.toml", {"material.wing.parts=[\"solar array*\"]", "material.wing.preset=\"mli\"", "material.wing.roughness=0.77",
                            "material.wing.tilt_deg=3", "material.wing.diffuse=[0.1,0.2,0.3]", "material.wing.specular=[0.4,0.5,0.6]",
                            "material.tube.parts=[\"body\"]", "material.tube.preset=\"white-paint\""});
  SceneRequest request;
  request.materials = {"solar array +y=regolith"};  // the command line has the last word
  const Scene scene = make_scene(mission, request);
  EXPECT_STREQ(material_of_part(scene, "solar array +y").name, "regolith");
  const Scene reported = scene_of_case(mission, scene.setup, scene.seed, "", 0);  // as the report of a run shows it
  EXPECT_STREQ(material_of_part(reported, "solar array +y").name, "mli");
  for (const Scene* const shown : {&scene, &reported}) {
    const Material &wing = material_of_part(*shown, "solar array -y"), &tube = material_of_part(*shown, "body");
    EXPECT_STREQ(wing.name, "mli");
    EXPECT_EQ(wing.reflection.roughness, 0.77);
    EXPECT_NEAR(wing.tilt_rad, 3 * kRadPerDeg, 1e-15);
    EXPECT_EQ(wing.reflection.diffuse.matrix(), Vec3(0.1, 0.2, 0.3));
    EXPECT_EQ(wing.reflection.specular.matrix(), Vec3(0.4, 0.5, 0.6));
    const Material& preset = *material_preset("white-paint");  // of which nothing differs
    EXPECT_STREQ(tube.name, "white-paint");
    EXPECT_EQ(tube.reflection.roughness, preset.reflection.roughness);
    EXPECT_EQ(tube.tilt_rad, preset.tilt_rad);
    EXPECT_EQ(tube.reflection.diffuse.matrix(), preset.reflection.diffuse.matrix());
  }
}

TEST(Scene, TakesTheMissionsMaterialsOfOtherNodes) {
  VERIFIES("LASSO-PIC-018~1");
  const std::vector<std::string> settings = {"material.other.parts=[\"inspector.bus\"]", "material.other.preset=\"regolith\""};
  const MissionInput mission = load_mission_input(test::source_folder() / "cfg/missions/rendezvous.toml", settings, "approach");
  SceneRequest request;
  request.scenario = "approach";
  const Scene scene = make_scene(mission, request);
  EXPECT_STREQ(material_of_part(scene, "inspector.bus").name, "regolith");
  EXPECT_STRNE(material_of_part(scene, "inspector.antenna").name, "regolith");
}

TEST(Scene, TakesTheSensorWhoseTurnItIs) {
  VERIFIES("LASSO-PIC-001~1");
  const MissionInput mission = shipped("hubble.toml");
  SceneRequest request;
  request.scenario = "approach";
  EXPECT_EQ(make_scene(mission, request).camera, "time_of_flight");  // at 60 m
  request.time_s = 150;
  const Scene near = make_scene(mission, request);
  EXPECT_EQ(near.camera, "laser_camera");
  EXPECT_NEAR(near.fov_half_x_rad, 25 * kRadPerDeg, 1e-12);
  request.camera = "time_of_flight";
  EXPECT_NEAR(make_scene(mission, request).fov_half_x_rad, 15 * kRadPerDeg, 1e-12);
}

TEST(Scene, PartsAreTheSolidsOfTheModelWithMaterialsByTheirNames) {
  VERIFIES("LASSO-PIC-007~1 LASSO-PIC-013~1");
  SceneRequest request;
  request.materials = {"solar array*=mli", "body=white-paint", "solar array +y=black-anodised"};
  const Scene scene = make_scene(tenth(), request);
  ASSERT_EQ(scene.parts.size(), scene.materials.size());
  const auto material = [&](const std::string& part) {
    const auto found = std::find(scene.parts.begin(), scene.parts.end(), part);
    return found == scene.parts.end() ? std::string() : scene.materials[static_cast<std::size_t>(found - scene.parts.begin())].name;
  };
  EXPECT_EQ(material("solar array -y"), "mli");
  EXPECT_EQ(material("solar array +y"), "black-anodised");  // the last one that fits
  EXPECT_EQ(material("body"), "white-paint");
  EXPECT_EQ(material("bay 3"), "mli");
}

// The array at +y: where the model has its middle, a ray along z meets it, unless it is gone.
TEST(Scene, ShowsTheTargetAsItIsSimulated) {
  VERIFIES("LASSO-PIC-014~1");
  const Vec3 from(0.2, 0.4, 2);
  SurfacePoint point;
  const Scene whole = make_scene(tenth(), {});
  ASSERT_TRUE(whole.surface->find(from, -Vec3::UnitZ(), point));
  EXPECT_EQ(whole.parts[point.part], "solar array +y");
  const MissionInput without = shipped("hubble_tenth.toml", {"scenario.paper.model_gone_box_m=[-0.35,0.2,-0.1,0.48,0.6,0.1]"});
  const Scene gone = make_scene(without, {});
  EXPECT_FALSE(gone.surface->find(from, -Vec3::UnitZ(), point));
  ASSERT_TRUE(gone.surface->find(Vec3(0.2, -0.4, 2), -Vec3::UnitZ(), point));
  EXPECT_EQ(gone.parts[point.part], "solar array -y");  // triangles keep their parts
}

TEST(Scene, WhatIsNotThereIsNamedWithWhatIs) {
  VERIFIES("LASSO-PIC-011~1");
  SceneRequest request;
  request.scenario = "papr";
  expect_says(error_of(tenth(), request), {"papr", "paper"});
  request = {};
  request.range_m = 4.5;
  expect_says(error_of(tenth(), request), {"--range 4.5", "paper", "2, 3, 4, 5, 6, 7 m"});
  request = {};
  request.camera = "laser_camra";
  expect_says(error_of(tenth(), request), {"--camera laser_camra", "laser_camera"});
  request = {};
  request.materials = {"body=gold"};
  expect_says(error_of(tenth(), request), {"--material body=gold", "silver-teflon"});
  request.materials = {"bodi=mli"};
  expect_says(error_of(tenth(), request), {"--material bodi=mli", "body"});
  request.materials = {"mli"};
  expect_says(error_of(tenth(), request), {"PART=MATERIAL"});
  request = {};
  request.scenario = "approach";
  request.range_m = 20;
  expect_says(error_of(shipped("hubble.toml"), request), {"--range", "--time"});
}

// On the chaser beside its sensors: by hand, from the poses of tree and target.
TEST(Scene, IsSeenFromACameraAtANode) {
  VERIFIES("LASSO-SCN-035~1");
  const MissionInput mission = load_mission_input(
      test::source_folder() / "cfg/missions/rendezvous.toml",
      {"node.bow={parent='chaser', position_m=[-0.4, 0.2, 0.9], quaternion=[0.6, 0, 0, 0.8], camera={fov_half_x_deg=30}}",
       "node.bulb={parent='chaser', lamp={intensity_Wpsr=0}}",
       "node.spot={parent='chaser', position_m=[0.1, 0, 1], lamp={intensity_Wpsr=59, half_angle_deg=20}}"},
      "approach");
  SceneRequest request;
  request.scenario = "approach";
  request.time_s = 42;
  const Scene plain = make_scene(mission, request);
  request.camera = "bow";
  const Scene scene = make_scene(mission, request);
  EXPECT_EQ(scene.camera, "bow");
  EXPECT_NEAR(scene.fov_half_x_rad, 30 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(scene.fov_half_y_rad, 20 * kRadPerDeg, 1e-12);
  const Vec3 head_m(0.3, 0.0, 0.5), bow_m(-0.4, 0.2, 0.9), spot_m(0.1, 0, 1);  // in the chaser, whose axes the head has
  const Quat q_bow_chaser = Quat(0.8, 0.6, 0, 0).conjugate();
  EXPECT_LT((scene.T_sensor_target.p - q_bow_chaser * (plain.T_sensor_target.p + head_m - bow_m)).norm(), 1e-9);
  EXPECT_LT((*scene.orbit_lights->sun - q_bow_chaser * *plain.orbit_lights->sun).norm(), 1e-9);
  EXPECT_LT((scene.T_camera_sensor.p - q_bow_chaser * (head_m - bow_m)).norm(), 1e-9);
  ASSERT_EQ(scene.lamps.size(), 1U) << "one is off";
  EXPECT_LT((scene.lamps[0].place_m - q_bow_chaser * (spot_m - bow_m)).norm(), 1e-9);
  EXPECT_LT((scene.lamps[0].axis - q_bow_chaser * Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(scene.lamps[0].intensity_Wpsr, 100, 1e-9) << "59 % of the Sun's light is in the band";
  EXPECT_LT((plain.lamps.at(0).place_m - (spot_m - head_m)).norm(), 1e-9);
  request.camera = "bwo";
  expect_says(error_of(mission, request), {"--camera bwo", "did you mean bow?"});
}

}  // namespace
}  // namespace lasso::mdat
