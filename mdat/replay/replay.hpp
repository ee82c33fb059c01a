// Registers recorded scans, one by one from given poses or in closed loop from the first one.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fsw/mission/mission.hpp"
#include "fsw/pose/result.hpp"
#include "hal_sim/scan_file.hpp"
#include "mdat/replay/initial_poses.hpp"

namespace lasso::mdat {

struct ReplayOptions {
  std::filesystem::path scans;    // folder
  std::filesystem::path initial;  // file of poses
  bool closed_loop = false;       // the first row starts the track; then the filter predicts, as in flight
  bool wide = false;              // starts are rough: centroid, far field and slides come first
};

struct ReplayedScan {
  std::string scan;  // stem
  Registration registration;
  double estimate_us = 0;  // processor time of the whole estimate
};

// What a replay reads, checked before anything is compiled.
struct ReplayInput {
  std::vector<InitialPose> poses;
  sim::RecordedScans scans;
};

// Reads the poses, and each scan once. Throws InputError and sim::ScanFileError: a file that is wrong, or, but in closed loop, a scan
// without a pose.
ReplayInput read_replay_input(const ReplayOptions& options);

// In name order. In closed loop the time between scans is that between their reference times where it is positive, and the mission's period
// otherwise (files without times). Throws InputError and sim::ScanFileError.
std::vector<ReplayedScan> replay(const Mission& mission, const ReplayOptions& options, const ReplayInput& input);

// The file poses_out.csv.
std::string replay_csv(const std::vector<ReplayedScan>& scans);

// Valid scans, reasons of the others, median time.
std::string replay_summary(const std::vector<ReplayedScan>& scans);

}  // namespace lasso::mdat
