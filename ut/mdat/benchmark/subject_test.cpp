#include "mdat/benchmark/subject.hpp"

#include <gtest/gtest.h>

#include "mdat/benchmark/still_scans.hpp"
#include "mdat/missiondb/mesh_import.hpp"
#include "ut/mdat/benchmark/folder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

SubjectRequest request_of(const test::PassingFolder& folder, const std::string& model) {
  SubjectRequest request;
  request.seed = 52;
  request.mission = folder / "m.toml";
  request.model = folder / model;
  return request;
}

TEST(Subject, AMeshAndAParametricModelAreTheSameBody) {
  VERIFIES("LASSO-GND-120~1");
  const test::PassingFolder folder;
  const Subject drawn = make_subject(request_of(folder, "m_model.toml")), meshed = make_subject(request_of(folder, "m.stl"));
  EXPECT_EQ(drawn.truth.size_m, meshed.truth.size_m);
  EXPECT_EQ(drawn.nearest_m, meshed.nearest_m);
  EXPECT_EQ(drawn.noise.sigma0_m, meshed.noise.sigma0_m);
  const Mesh made = mesh_of(drawn.body), read = import_mesh(folder / "m.stl", 1);
  EXPECT_EQ(made.triangles.size(), read.triangles.size());
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : read.vertices) box.extend(v);
  EXPECT_LT((box.min() - meshed.truth.low_m).norm() + (box.max() - meshed.truth.high_m).norm(), 1e-6 * meshed.truth.size_m);
}

TEST(Subject, HasTheSensorSettingsAndNameThatAreAskedFor) {
  VERIFIES("LASSO-GND-120~1");
  const test::PassingFolder folder;
  SubjectRequest request = request_of(folder, "m.stl");
  request.name = "mine";
  request.settings = {"start.check=false"};
  for (const SensorKind sensor : {SensorKind::kLaserCamera, SensorKind::kTimeOfFlight}) {
    request.sensor = sensor;
    const Subject subject = make_subject(request);
    EXPECT_EQ(subject.mission.source.sensor, sensor);
    EXPECT_EQ(subject.mission.source.name, "mine");
    EXPECT_EQ(subject.mission.source.parameters.start_check, 0);
  }
}

TEST(Subject, ABodyThatCannotBeKnownDeterminesNothing) {
  VERIFIES("LASSO-GND-114~1");
  const test::PassingFolder folder;
  Subject subject = make_subject(request_of(folder, "m.stl"));
  StillScans scans(subject, ScanStream::kBenchmark);
  const Pose pose = scans.draw_pose();
  const RangeImage& scan = scans.scan(subject.target->surface(), pose, pose);
  const std::span<const RangeSample> samples(scan.samples.begin(), scan.samples.size());
  EXPECT_TRUE(is_determined(subject, pose, samples));
  subject.truth.symmetry.axis = Eigen::Vector3d::UnitX();
  EXPECT_FALSE(is_determined(subject, pose, samples));
}

}  // namespace
}  // namespace lasso::mdat
