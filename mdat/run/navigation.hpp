// The navigation system of a simulated approach: offers the component poses to start from, as uncertain as the scenario says.
#pragma once

#include "fsw/exec/component.hpp"
#include "hal_sim/random.hpp"
#include "hal_sim/trajectory.hpp"
#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

class NavigationSystem {
 public:
  // Keeps references: both outlive it. The seed is the run's.
  NavigationSystem(const Scenario& scenario, const sim::Trajectory& truth, std::uint64_t seed);

  // Offers what is due at `now_us`. A refusal is the component's affair: its telemetry reports it.
  void offer(TimeUs now_us, Component& component);

 private:
  StartOffer measure(TimeUs t_us);
  Vec3 draw(double sigma);

  const Scenario& scenario_;
  const sim::Trajectory& truth_;
  sim::Random random_;
  TimeUs next_us_;
};

}  // namespace lasso::mdat
