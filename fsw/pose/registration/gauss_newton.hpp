// One Gauss-Newton pass over the points: match, sum, solve, step. Shared by the registration and the wide start.
#pragma once

#include "fsw/pose/registration/match.hpp"
#include "fsw/pose/registration/registration.hpp"

namespace lasso {

struct Pass {
  explicit Pass(const Mission& mission) : sums(mission.radius_m) {}

  PassSums<FlightNumber> sums;
  Mat6 H = Mat6::Zero();
  Vec6 x = Vec6::Zero();            // the damped solution; the step taken unless that was cut
  Status status = Status::kNoData;  // kOk, kNoData (too few points), kSingular, kNotFinite: no step
};

// How far a step goes at the model's radius, m: its translation and its rotation together.
double length_of(const Vec6& x, double radius_m);
constexpr double kAnyStep = 1e9;

// The steps of successive passes. One that turns back from the one before, measured by the information, shows that the least cost lies
// between: it and all that follow are halved, as points that change sides there would be followed to and fro for ever.
struct Descent {
  double longest_step_m = kAnyStep;
  double damping = 1;
  Vec6 last = Vec6::Zero();
};

MatchSettings<FlightNumber> make_settings(const MissionParameters& parameters, const Workspace& workspace);
void set_gate(double gate_m, MatchSettings<FlightNumber>& settings);

// The sums of the points as the pose stands: neither solved nor a step.
Pass match_pass(const Mission& mission, const MatchSettings<FlightNumber>& settings, const PassKind& kind, const Pose& T_target_sensor,
                Workspace& workspace);

// Solves the sums of `pass` and, where that succeeds, steps the pose by the damped solution, cut to the longest step.
void solve_pass(const Mission& mission, const MatchSettings<FlightNumber>& settings, Descent& descent, Pass& pass, Pose& T_target_sensor);

// A pass from the pose, which takes the step; without a descent, the whole one.
Pass take_pass(const Mission& mission, const MatchSettings<FlightNumber>& settings, const PassKind& kind, Descent& descent,
               Workspace& workspace, Pose& T_target_sensor);
Pass take_pass(const Mission& mission, const MatchSettings<FlightNumber>& settings, const PassKind& kind, Workspace& workspace,
               Pose& T_target_sensor);

// No step goes farther than the start is believed to be off, or than the noise reaches, m at the model's radius: points that met the wrong
// surface can ask for steps along directions that hardly any other point observes, past the minimum that the start lies in.
double longest_step_m(const MissionParameters& parameters, const MatchSettings<FlightNumber>& settings);

// A whole pass over all points with one axis held: its step has no part along `axis`, but for a 1000th of what the hits would ask for.
// `axis` is a unit vector over (rotation * radius, translation), target axes. Without enough points, or a solution, the pose stays. kLast
// is for a pass right after one near by.
void take_held_pass(const Mission& mission, const Vec6& axis, Lookup lookup, Workspace& workspace, Pose& T_target_sensor);

}  // namespace lasso
