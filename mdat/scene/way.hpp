// A way through places at given times: at rest at each of them, and smooth between.
#pragma once

#include "mdat/scene/table_motion.hpp"

namespace lasso::mdat::scene {

// Between two rows the position is a + (b - a) u^2 (3 - 2 u), u the share of the time that has passed. Before the first row, and from the
// last one on, the node stays there. It keeps the parent's axes.
class Way final : public Motion {
 public:
  // Of the table its times and positions; throws MissionError as check_table says.
  explicit Way(MotionTable table, const Place& place = {});
  MotionState at(TimeUs t_us) const override;
  bool is_quick() const override { return true; }

 private:
  MotionTable table_;
};

}  // namespace lasso::mdat::scene
