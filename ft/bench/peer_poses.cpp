// peer_poses FOLDER --out DIR: what others use, on a benchmark set (docs/benchmark-protocol.md). Writes DIR/METHOD.csv for each peer.
// Exit codes as mdat's.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ft/bench/peer_pose.hpp"
#include "ft/bench/sampling.hpp"
#include "hal_sim/scan_file.hpp"
#include "mdat/benchmark/program_poses.hpp"
#include "mdat/common/cpu_clock.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/replay/initial_poses.hpp"

namespace {

using namespace lasso;
using namespace lasso::bench;
namespace fs = std::filesystem;

constexpr std::size_t kModelPoints = 81000;  // as in peer_bench
constexpr double kSpacings = 4.0 / 3;        // of the model's points: the least gate of a sampled mesh
constexpr double kSigmas = 3;
constexpr double kLeastGate_m = 0.001;
constexpr const char* kNames[] = {"embree_closest_point", "nanoflann_point_to_plane", "pcl_icp_with_normals"};

struct Options {
  std::string folder, out;
  double share_min = 0.95;
  int iterations_max = 20;
};

struct PeerScan {
  std::string name;
  Pose start;
  std::vector<Triple> points_m;
  std::vector<double> gates_m;  // of each point: farthest surface that it can lie on
};

struct PeerBody {
  const mdat::ProtocolBody& about;
  mdat::Mesh mesh;
  std::vector<PeerScan> scans;
};

double sigma_m(const mdat::KnowableNoise& noise, double depth_m) {
  return std::hypot(noise.sigma0_m, noise.sigma_k_per_m * depth_m * depth_m, noise.surface_sigma_m);
}

PeerScan scan_of(const RangeImage& image, const std::string& name, const Pose& start, const mdat::KnowableNoise& noise) {
  PeerScan scan{name, start, {}, {}};
  for (const RangeSample& sample : image.samples) {
    if (sample.state != RayState::kHit) continue;
    const Vec3 p = double{sample.range_m} * to_vec3(sample.direction);
    scan.points_m.push_back({p[0], p[1], p[2]});
    scan.gates_m.push_back(kSigmas * sigma_m(noise, p[2]));
  }
  return scan;
}

PeerBody read_body(const fs::path& folder, const mdat::ProtocolBody& about) {
  PeerBody body{about, mdat::import_mesh(folder / about.name / mdat::kMeshFile, 1), {}};
  const fs::path starts = folder / about.name / mdat::kStartsFile;
  const std::vector<mdat::InitialPose> poses = mdat::read_initial_poses(starts);
  const sim::RecordedScans scans(folder / about.name / mdat::kScansFolder);
  for (std::size_t i = 0; i < scans.size(); ++i)
    body.scans.push_back(scan_of(scans.read(i), scans.stem(i), mdat::pose_of(poses, scans.stem(i), starts), about.noise));
  return body;
}

PeerSettings settings_of(const PeerBody& body, const mdat::SetPlan& plan, const Options& options) {
  double farthest_m = 0;
  for (const PeerScan& scan : body.scans) farthest_m = std::max(farthest_m, scan.start.p.norm());
  PeerSettings settings;
  settings.gate_max_m = (plan.start_share() + 0.5 * plan.start_deg * kRadPerDeg) * body.about.size_m;
  settings.gate_min_m = std::max(kLeastGate_m, kSigmas * sigma_m(body.about.noise, farthest_m));
  settings.sampled_gate_min_m = std::max(settings.gate_min_m, kSpacings * spacing_m(body.mesh, kModelPoints));
  settings.iterations_max = options.iterations_max;
  settings.coarse_to_fine = true;
  return settings;
}

std::vector<std::unique_ptr<Peer>> make_peers(const PeerBody& body, const PeerSettings& settings) {
  const PeerCloud cloud = sample_evenly(body.mesh, kModelPoints);
  std::vector<std::unique_ptr<Peer>> peers;
  peers.push_back(make_embree_peer(to_peer_mesh(body.mesh), settings));
  peers.push_back(make_nanoflann_peer(cloud, settings));
  peers.push_back(make_pcl_peer(cloud, settings));
  return peers;
}

mdat::ProgramPose align(Peer& peer, const SurfaceCheck& check, const PeerBody& body, const PeerScan& scan, double share_min) {
  mdat::ProgramPose row;
  row.body = body.about.name;
  row.scan = scan.name;
  peer.set_scan(scan.points_m);
  const PeerPose start = to_peer_pose(scan.start);
  const double begin_us = mdat::thread_cpu_us();
  const PeerResult result = peer.align(start);
  row.time_s = 1e-6 * (mdat::thread_cpu_us() - begin_us);
  row.T_sensor_target = from_peer_pose(result.T_sensor_target);
  const std::size_t near = check.count_near(scan.points_m, scan.gates_m, result.T_sensor_target);
  row.valid = result.converged && static_cast<double>(near) >= share_min * static_cast<double>(scan.points_m.size());
  return row;
}

void run(const Options& options) {
  const mdat::Protocol protocol = mdat::read_protocol(options.folder);
  mdat::check_files(options.folder, protocol);
  mdat::OutputFolder out(options.out);
  std::vector<mdat::ProgramPoses> programs;
  for (const char* name : kNames) programs.push_back({name, false, {}});
  mdat::ProgressBar bar("peers", protocol.bodies.size(), "bodies");
  for (std::size_t i = 0; i < protocol.bodies.size(); ++i) {
    const PeerBody body = read_body(options.folder, protocol.bodies[i]);
    const auto check = make_surface_check(to_peer_mesh(body.mesh));
    const auto peers = make_peers(body, settings_of(body, protocol.plan, options));
    for (std::size_t k = 0; k < peers.size(); ++k) {
      for (const PeerScan& scan : body.scans) programs[k].rows.push_back(align(*peers[k], *check, body, scan, options.share_min));
    }
    bar.show(i + 1);
  }
  bar.finish();
  for (const mdat::ProgramPoses& poses : programs) out.write(poses.program + ".csv", program_poses_csv(poses));
  out.commit();
  for (const char* name : kNames) std::printf("%s/%s.csv: written\n", options.out.c_str(), name);
}

int refuse(const std::exception& error, int exit_code) {
  std::fprintf(stderr, "peer_poses: %s\n", error.what());
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    CLI::App app("registers a benchmark set's scans by what others use", "peer_poses");
    app.add_option("FOLDER", options.folder, "folder of the set")->required();
    app.add_option("-o,--out", options.out, "folder to write the tables of poses into")->required();
    app.add_option("--share", options.share_min, "of a scan's returns that have to lie on the surface for a pose to be valid")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--iterations", options.iterations_max, "at most so many; PCL's of each of its gates")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? mdat::kExitDone : mdat::kExitBadInput;
    }
    run(options);
    return mdat::kExitDone;
  } catch (const mdat::InputError& error) {
    return refuse(error, mdat::kExitBadInput);
  } catch (const sim::ScanFileError& error) {
    return refuse(error, mdat::kExitBadInput);
  } catch (const mdat::MeshError& error) {
    return refuse(error, mdat::kExitBadInput);
  } catch (const std::exception& error) {
    return refuse(error, mdat::kExitFailed);
  }
}
