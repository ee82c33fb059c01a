// Registers recorded scans, one by one from given poses or in closed loop from the first one.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fsw/mission/mission.hpp"
#include "fsw/pose/scan/result.hpp"
#include "hal_sim/scan_file.hpp"
#include "mdat/replay/initial_poses.hpp"
#include "mdat/replay/pose_errors.hpp"
#include "mdat/replay/scan_notes.hpp"

namespace lasso::mdat {

struct ReplayOptions {
  std::filesystem::path scans;                    // folder
  std::shared_ptr<const sim::ScanSource> source;  // instead of it
  std::filesystem::path initial;                  // file of poses
  std::filesystem::path truth;                    // file of true poses; empty: none
  sim::ScanFrame frame;                           // of the scans' files
  sim::DepthCamera camera;                        // of depth images
  double unit_s = 0;                              // of their times; 0: as their headers and spans say
  bool closed_loop = false;                       // the first row starts the track; then the filter predicts, as in flight
  bool wide = false;                              // starts are rough: centroid, far field and slides come first
};

struct ReplayedScan {
  std::string scan;  // stem
  Registration registration;
  double estimate_us = 0;  // processor time of all that was done with the scan, its search as well
  KnownError errors;
};

// What a replay reads, checked before anything is compiled.
struct ReplayInput {
  std::vector<InitialPose> poses;  // none: of a search
  std::vector<InitialPose> truth;
  sim::RecordedScans scans;
  std::vector<sim::ScanFacts> facts;
};

// Reads the poses (unless they are the word search), and each scan once. Throws InputError and sim::ScanFileError: a file that is wrong,
// or, but in closed loop, a scan without a pose.
ReplayInput read_replay_input(const ReplayOptions& options);

// Says in which unit the scans' times are, for a mission whose scans take `duration_s`. What there is to know of the input, for the user.
Notes settle_times(const ReplayOptions& options, double duration_s, ReplayInput& input);

// In natural order. In closed loop the time between scans is that between their reference times where it is positive, and the mission's
// period otherwise (files without times). Throws InputError and sim::ScanFileError.
std::vector<ReplayedScan> replay(const Mission& mission, const ReplayOptions& options, const ReplayInput& input);

// Poses that count against the truth: the valid ones.
std::vector<FoundPose> judged(const std::vector<ReplayedScan>& scans);

// The file poses_out.csv; with the columns of errors where any is known.
std::string replay_csv(const std::vector<ReplayedScan>& scans);

// Valid scans, reasons of the others with their meanings, median time.
std::string replay_summary(const std::vector<ReplayedScan>& scans);

}  // namespace lasso::mdat
