#include "mdat/run/relative_poses.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/so3.hpp"
#include "fsw/link/space_packet.hpp"
#include "fsw/pose/scan/result.hpp"
#include "mdat/run/case.hpp"

namespace lasso::mdat {
namespace {

constexpr double kMillimetres = 1e3, kDegrees = 1 / kRadPerDeg;

scene::MotionState still(const Pose& pose) { return {pose, Twist{}}; }

// What is known without error: where `of` is in the target, and how the sensors stand and turn in `in`, or in its origin with other axes.
struct Places {
  Places(const SceneRun& run, const RelativePair& pair, TimeUs t_us)
      : target_of(still(run.tree.state(pair.of, run.target, 0).T_a_b)), in_sensor(still(run.tree.state(run.sensor, pair.in, 0).T_a_b)) {
    scene::MotionState truth_in = run.tree.state(pair.of, pair.in, t_us);
    if (pair.axes) {
      scene::MotionState turn = run.tree.state(pair.in, *pair.axes, t_us);
      turn.T_a_b.p = turn.rates.v_mps = Vec3::Zero();
      in_sensor = turn * in_sensor;
      truth_in = turn * truth_in;
    }
    truth = truth_in;
  }

  scene::MotionState moved(const scene::MotionState& sensor_target) const { return in_sensor * sensor_target * target_of; }
  Mat6 moved(const Mat6& covariance, const Pose& T_sensor_target) const {
    return scene::covariance_in_frame(scene::covariance_of_point(covariance, T_sensor_target, target_of.T_a_b), in_sensor.T_a_b);
  }

  scene::MotionState target_of, in_sensor, truth;
};

RelativePose relative_pose(const PoseTelemetry& packet, const SceneRun& run, const RelativePair& pair) {
  const TimeUs t_us = packet.t_measurement_us - kEpochUs;
  const Places places(run, pair, t_us);
  const Pose T_sensor_target = registration_pose(packet);
  const Twist rates{Vec3(packet.filter_omega_radps), Vec3(packet.filter_v_mps)};
  const scene::MotionState filtered = places.moved({filtered_pose(packet), rates});
  RelativePose pose;
  pose.t_s = to_seconds(t_us);
  pose.valid = packet.valid != 0;
  pose.T_in_of = places.moved(still(T_sensor_target)).T_a_b;
  pose.T_in_of_filtered = filtered.T_a_b;
  pose.rates = filtered.rates;
  pose.covariance = places.moved(registration_covariance(packet), T_sensor_target);
  pose.truth = places.truth.T_a_b;
  pose.true_rates = places.truth.rates;
  return pose;
}

// Of scans that were registered.
std::vector<PoseTelemetry> registrations(const std::vector<std::uint8_t>& telemetry) {
  std::vector<PoseTelemetry> packets;
  ConstBytes stream(telemetry.data(), telemetry.size());
  while (const std::size_t size = packet_size(stream)) {
    PacketHeader header;
    PoseTelemetry pose;
    const ConstBytes packet = stream.first(std::min(size, stream.size()));
    const bool is_pose = decode_pose(packet, header, pose, read_primary_header(packet).apid) == PacketFault::kNone;
    if (is_pose && static_cast<StopReason>(pose.stop) != StopReason::kNotRun) packets.push_back(pose);
    stream = stream.subspan(std::min(size, stream.size()), stream.size() - std::min(size, stream.size()));
  }
  return packets;
}

}  // namespace

std::vector<RelativeRun> relative_runs(const SceneRun& scene, const std::vector<std::uint8_t>& telemetry) {
  std::vector<RelativeRun> runs;
  if (scene.relative.empty()) return runs;
  const std::vector<PoseTelemetry> packets = registrations(telemetry);
  for (const RelativePair& pair : scene.relative) {
    runs.push_back({pair.name, {}});
    for (const PoseTelemetry& packet : packets) runs.back().poses.push_back(relative_pose(packet, scene, pair));
  }
  return runs;
}

RelativeFigures relative_figures(const RelativeRun& run) {
  RelativeFigures figures;
  figures.poses = run.poses.size();
  for (const RelativePose& pose : run.poses) {
    if (!pose.valid) continue;
    ++figures.valid;
    const PoseError error = pose_error(pose.T_in_of, pose.truth), filtered = pose_error(pose.T_in_of_filtered, pose.truth);
    figures.rms_mm += error.translation_m.squaredNorm();
    figures.rms_deg += error.rotation_rad * error.rotation_rad;
    figures.filtered_rms_mm += filtered.translation_m.squaredNorm();
    figures.filtered_rms_deg += filtered.rotation_rad * filtered.rotation_rad;
    figures.nees += nees(pose.T_in_of, pose.truth, pose.covariance);
  }
  const auto n = static_cast<double>(figures.valid);  // 0: nothing is known, and nothing is a number
  for (double* mm : {&figures.rms_mm, &figures.filtered_rms_mm}) *mm = kMillimetres * std::sqrt(*mm / n);
  for (double* deg : {&figures.rms_deg, &figures.filtered_rms_deg}) *deg = kDegrees * std::sqrt(*deg / n);
  figures.nees /= n;
  return figures;
}

}  // namespace lasso::mdat
