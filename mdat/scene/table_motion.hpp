// Motion by a table of times, positions and attitudes, as simulators and flights write it.
//
// Between rows the position is a polynomial, and the attitude a cubic of the rotation vector from the row before (interpolation.hpp).
// Where rows state no velocities or angular velocities, those of parabolas through three rows stand in: pose and rates are then without a
// jump, and the error goes with the third power of the time between rows. Before the first row, and from the
// last one on, the node stays there.
#pragma once

#include <vector>

#include "mdat/scene/interpolation.hpp"
#include "mdat/scene/motion.hpp"

namespace lasso::mdat::scene {

enum class Interpolation : std::uint8_t {
  kHermite,   // through positions and velocities of (degree + 1) / 2 rows, rounded up
  kLagrange,  // through positions of degree + 1 rows; velocities are not used
};

struct MotionTable {
  std::vector<double> times_s;       // since the scene's epoch, ascending; a row for each
  std::vector<Vec3> positions_m;     // of the node in its parent; none: at the parent's origin
  std::vector<Vec3> velocities_mps;  // none: from the positions
  std::vector<Quat> attitudes;       // q_parent_node, unit length within 1e-3; q and -q are the same; none: the parent's axes
  std::vector<Vec3> omegas_radps;    // of the node, in the parent's axes; none: from the attitudes
  Interpolation interpolation = Interpolation::kHermite;  // of positions
  int degree = 3;                                         // 1 to 15; without velocities Hermite's is 3
  std::vector<int> lines;                                 // of the rows in their file; none: there is no file
};

// All that keeps a table from being a motion: no row, times that do not ascend, numbers that are not finite, quaternions not of unit
// length, rows that are half a turn or more apart by their angular velocities, a degree that needs more rows.
void check_table(const MotionTable& table, const Place& place, Problems& problems);

class TableMotion final : public Motion {
 public:
  explicit TableMotion(MotionTable table, const Place& place = {});
  MotionState at(TimeUs t_us) const override;
  double begin_s() const { return table_.times_s.front(); }
  double end_s() const { return table_.times_s.back(); }

 private:
  void add_velocities();
  void add_attitudes();
  Sample position_at(std::size_t row, double t_s) const;

  MotionTable table_;
  std::vector<Turning> turnings_;  // of the rows, with angular velocities in the node's axes
};

}  // namespace lasso::mdat::scene
