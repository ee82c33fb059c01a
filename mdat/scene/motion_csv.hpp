// The project's own table of a motion: CSV with a header (hal_sim/csv_table.hpp says what else a spreadsheet may write).
//
//   time_s                       since the scene's epoch, ascending
//   x_m, y_m, z_m                position of the node in its parent; all three or none
//   vx_mps, vy_mps, vz_mps       its derivative; all three or none
//   qx, qy, qz, qw               attitude q_parent_node: takes the node's coordinates to the parent's; all four or none
//   wx_radps, wy_radps, wz_radps angular velocity of the node, in the parent's axes; all three or none
//
// Positions or attitudes are needed. Other columns are not looked at, unless their names are next to one of these: that is another unit.
#pragma once

#include <filesystem>
#include <string>

#include "mdat/scene/table_motion.hpp"

namespace lasso::mdat::scene {

// Checked (check_table), with the lines of its rows. Throws MissionError with every problem of the file.
MotionTable read_motion_csv(const std::filesystem::path& file);
MotionTable parse_motion_csv(const std::string& text, const std::string& file);

}  // namespace lasso::mdat::scene
