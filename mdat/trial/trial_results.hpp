// What trials of single pairs say on the terminal, and leave for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "mdat/trial/pair_trial.hpp"

namespace lasso::mdat {

// Of the pairs of one light; means, of exposures and shares as well.
struct PairFigures {
  std::size_t pairs = 0;
  double exposure_s = 0, valid_share = 0, sky_share = 0, bias_px = 0, sigma_px = 0, wrong_interior = 0, wrong_edge = 0;
};
PairFigures pair_figures(const TrialResult& result, std::size_t light);

// Of the valid poses of one light; of none NaN.
struct PoseFigures {
  std::size_t scans = 0, valid = 0, wrong = 0;
  double median_mm = 0, rms_mm = 0, worst_mm = 0, median_deg = 0, rms_deg = 0, worst_deg = 0;
  double squared_position = 0, squared_attitude = 0, nees = 0;  // means
};
PoseFigures pose_figures(const std::vector<TrialPose>& poses);
std::vector<TrialPose> poses_in(const std::vector<TrialPose>& poses, std::size_t light);

// Figures of each light and of all: a table of poses, one that sets those of fitted errors beside those of rendered pairs, and one line a
// pose, in which `which` names view, draw and scan.
std::string pose_table(const std::string& title, const std::vector<TrialLight>& lights, const std::vector<TrialPose>& poses);
std::string fitted_table(const std::vector<TrialLight>& lights, const std::vector<TrialPose>& rendered,
                         const std::vector<TrialPose>& fitted);
nlohmann::ordered_json pose_json(const PoseFigures& figures);
std::string poses_csv(const std::vector<TrialLight>& lights, const std::vector<TrialPose>& rendered, const std::vector<TrialPose>& fitted,
                      const std::string& which);

std::string trial_text(const TrialResult& result);
std::string trial_json(const TrialResult& result);
std::string trial_pairs_csv(const TrialResult& result);  // a line for each pair
std::string trial_poses_csv(const TrialResult& result);  // a line for each scan, of pairs and of the fitted model

}  // namespace lasso::mdat
