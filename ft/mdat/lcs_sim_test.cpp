// The camera in a program of its own: mdat lcs-sim, and mdat run over a line of this machine, in real time.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

// A shell that keeps the camera running, waits until it (and not one before it) says that it listens, runs `run` against $line, and ends
// the camera by its own number.
std::string with_camera(const std::string& listen, const std::string& device, const std::string& run) {
  return "--version; rm -f camera.txt; '" + mdat_program() + "' lcs-sim missions/test.toml --device " + device + " --listen " + listen +
         " >camera.txt 2>&1 & camera=$!; "
         "for i in $(seq 300); do grep -qs 'listens on' camera.txt && break; sleep 0.1; done; "
         "line=$(sed -n 's/^the camera listens on //p' camera.txt); " +
         run + " >run.txt 2>&1; code=$?; kill $camera; wait $camera; exit $code";
}

struct LineHead {
  const char *name, *listen, *device, *sensor;
};
class LcsSim : public ::testing::TestWithParam<LineHead> {};

TEST_P(LcsSim, IsTrackedOverALineOfThisMachine) {
  VERIFIES("LASSO-SIM-031~1 LASSO-GND-024~1 LASSO-LCS-017~1");
  const WorkFolder folder;
  const std::string run = "'" + mdat_program() +
                          "' run missions/test.toml --scenario spin --frames 12 --no-report --force --out run --sensor " +
                          std::string(GetParam().sensor) + ":$line";
  // A machine with other work is late at times, and such a track may end: one of three runs has to hold it, and none may be wrong.
  int lost = 12;
  for (int attempt = 0; attempt < 3 && lost > 0; ++attempt) {
    const Answer answer = folder.mdat(with_camera(GetParam().listen, GetParam().device, run));
    ASSERT_EQ(answer.exit_code, 0) << folder.read("run.txt") << folder.read("camera.txt");
    const Json results = Json::parse(folder.read("run/results.json")).at("noisy");
    ASSERT_EQ(results.at("frames"), 12);
    EXPECT_EQ(results.at("wrong"), 0);
    EXPECT_NE(folder.read("camera.txt").find("the client has gone"), std::string::npos);
    lost = std::min(lost, results.at("lost").get<int>());
    if (lost == 0) {
      EXPECT_LT(results.at("rms_mm").get<double>(), 2);
    }
  }
  EXPECT_EQ(lost, 0) << folder.read("run.txt");
}
INSTANTIATE_TEST_SUITE_P(All, LcsSim,
                         ::testing::Values(LineHead{"tcp", "tcp://127.0.0.1:0", "laser-camera", "lcs-wire"},
                                           LineHead{"unix", "unix:line", "laser-camera", "lcs-wire"},
                                           LineHead{"unix_tridar", "unix:line", "tridar", "tridar-wire"},
                                           LineHead{"pty", "pty", "laser-camera", "lcs-wire"}),
                         [](const auto& one) { return std::string(one.param.name); });

// Every number is another one.
constexpr char kOptics[] =
    "serial = 7\nfocal_length_m = 0.0817\nbaseline_m = 0.2031\nhalf_width_m = 0.08125\nangle_x_offset_rad = 0.004\n"
    "angle_y_offset_rad = -0.003\nfocal_length_per_K = 3e-5\nbaseline_per_K = 2e-5\npeak_per_K = 1e-5\nreference_degC = 21\n"
    "angle_max_rad = 0.31\ndepth_min_m = 0.6\ndepth_max_m = 11\ntemperature_min_degC = -15\ntemperature_max_degC = 45\n"
    "outside_sigma_factor = 4\nresidual = [0.001, -0.002, 0.0011, 0.003, 0.0021, -0.001, 0.0015, 0.0012, -0.0023, 0.0016]\n";

// Read, served again and read again: the same file.
TEST(CameraTable, IsReadFromTheCamera) {
  VERIFIES("LASSO-LCS-019~1");
  const WorkFolder folder;
  folder.write("optics.toml", kOptics);
  for (const auto& [optics, out] : {std::pair{"optics.toml", "first.toml"}, std::pair{"first.toml", "second.toml"}}) {
    const std::string read = "'" + mdat_program() + "' calibrate --read $line -o " + std::string(out);
    const Answer answer = folder.mdat(with_camera("tcp://127.0.0.1:0", "tridar --camera-optics " + std::string(optics), read));
    ASSERT_EQ(answer.exit_code, 0) << folder.read("run.txt") << folder.read("camera.txt");
    EXPECT_NE(folder.read("run.txt").find("calibration of camera 7 written to"), std::string::npos) << folder.read("run.txt");
  }
  const std::string table = folder.read("first.toml");
  EXPECT_EQ(table, folder.read("second.toml"));
  for (const char* number : {"0.0817", "0.2031", "0.08125", "-0.003", "21", "0.31", "0.6", "11", "-15", "45", "-0.0023", "0.0016"})
    EXPECT_NE(table.find(number), std::string::npos) << number << " in\n" << table;
}

TEST(CameraTable, AHeadWithoutOneIsNamed) {
  VERIFIES("LASSO-LCS-019~1");
  const WorkFolder folder;
  const Answer answer = folder.mdat(with_camera("unix:line", "lidar", "'" + mdat_program() + "' calibrate --read $line -o none.toml"));
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_NE(folder.read("run.txt").find("unix:line: the head has no table of a laser camera"), std::string::npos) << folder.read("run.txt");
  EXPECT_EQ(folder.read("none.toml"), "");
}

TEST(LcsSimRefusals, SayWhichLineAndWhy) {
  VERIFIES("LASSO-LCS-017~1");
  const WorkFolder folder;
  const std::pair<const char*, const char*> cases[] = {
      {"run missions/test.toml --scenario spin --sensor lcs-wire:./none", "./none: not there"},
      {"run missions/test.toml --scenario spin --sensor lcs-wire:unix:none", "unix:none: not there"},
      {"run missions/test.toml --scenario spin --sensor lcs-wire:tcp://192.0.2.1:9", "--remote"},
      {"run missions/test.toml --scenario spin --sensor lcs-wire:", "--sensor"},
      {"run missions/test.toml --sensor lcs-wire:unix:none", "a scenario of one range"},
      {"lcs-sim missions/test.toml --listen tcp://0.0.0.0:0", "--remote"},
      {"lcs-sim missions/test.toml --listen somewhere", "expected pty, tcp://127.0.0.1:PORT or unix:PATH"},
      {"lcs-sim missions/test.toml --device radar", "--device"},
      {"lcs-sim missions/none.toml", "none.toml"},
      {"calibrate --read unix:none -o camera.toml", "unix:none: not there"},
      {"calibrate --read tcp://192.0.2.1:9 -o camera.toml", "--remote"},
  };
  for (const auto& [command, why] : cases) {
    const Answer answer = folder.mdat(command);
    EXPECT_EQ(answer.exit_code, 2) << command;
    EXPECT_NE(answer.err.find(why), std::string::npos) << answer.err;
  }
}

}  // namespace
}  // namespace lasso::ft
