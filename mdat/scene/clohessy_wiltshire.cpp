#include "mdat/scene/clohessy_wiltshire.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <string>

#include "fsw/geometry/portable_math.hpp"
#include "hal_sim/scan_text.hpp"

namespace lasso::mdat::scene {
namespace {

// A transfer is refused where its impulse would be a thousand times that of a short transfer over the same way in the same time.
constexpr double kLeastReach = 1e-3;

// Where the free drift ends is linear in where it begins: p = of_p p0 + of_v v0.
struct Transition {
  Mat3 p_of_p, p_of_v, v_of_p, v_of_v;
};

Transition transition(double n, double t_s) {
  const double angle = n * t_s;
  const SinCos half = sin_cos(0.5 * std::remainder(angle, 2 * kPi));
  const double s = 2 * half.sin * half.cos, versed = 2 * half.sin * half.sin, c = 1 - versed;
  Transition result;
  result.p_of_p << 1 + 3 * versed, 0, 0, 6 * (s - angle), 1, 0, 0, 0, c;
  result.p_of_v << s / n, 2 * versed / n, 0, -2 * versed / n, (4 * s - 3 * angle) / n, 0, 0, 0, s / n;
  result.v_of_p << 3 * n * s, 0, 0, -6 * n * versed, 0, 0, 0, 0, -n * s;
  result.v_of_v << c, 2 * s, 0, -2 * s, 1 - 4 * versed, 0, 0, 0, c;
  return result;
}

// The velocity at the begin of a free drift that ends at to_m; none where no velocity, or an absurd one, does.
std::optional<Vec3> transfer_velocity(const Vec3& from_m, const Vec3& to_m, double n, double duration_s) {
  const Transition t = transition(n, duration_s);
  const Vec3 way_m = to_m - t.p_of_p * from_m;
  const double across = t.p_of_v(2, 2) / duration_s;  // 0 at each half revolution
  const Mat3& m = t.p_of_v;
  const double determinant = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);  // 0 at each revolution, and once between each two of them
  if (std::fabs(determinant) < kLeastReach * duration_s * duration_s) return std::nullopt;
  if (std::fabs(across) < kLeastReach && std::fabs(way_m.z()) > 1e-9) return std::nullopt;
  return Vec3((m(1, 1) * way_m.x() - m(0, 1) * way_m.y()) / determinant, (m(0, 0) * way_m.y() - m(1, 0) * way_m.x()) / determinant,
              std::fabs(across) < kLeastReach ? 0 : way_m.z() / m(2, 2));
}

}  // namespace

RelativeState drift(const RelativeState& begin, double mean_motion_radps, double t_s) {
  const Transition t = transition(mean_motion_radps, t_s);
  return {t.p_of_p * begin.p_m + t.p_of_v * begin.v_mps, t.v_of_p * begin.p_m + t.v_of_v * begin.v_mps};
}

ClohessyWiltshire::ClohessyWiltshire(const Setup& setup, const Place& place)
    : mean_motion_radps_(setup.mean_motion_radps), end_m_(setup.start_m) {
  Problems problems(place);
  problems.require(setup.mean_motion_radps > 0 && std::isfinite(setup.mean_motion_radps), "mean motion",
                   sim::text_of(setup.mean_motion_radps) + " rad/s", "expected more than 0 rad/s");
  problems.require(setup.start_m.allFinite(), "start", "", "expected finite numbers");
  pieces_.push_back({-std::numeric_limits<double>::infinity(), 0, {setup.start_m, Vec3::Zero()}, false});
  for (std::size_t i = 0; i < setup.legs.size(); ++i) add_leg(setup.legs[i], "leg " + std::to_string(i + 1), problems);
  problems.throw_if_any();
  if (!setup.legs.empty() && setup.legs.front().kind == LegKind::kDrift) pieces_[1].from_s = pieces_[0].from_s;
  if (!setup.legs.empty() && setup.legs.back().kind == LegKind::kTransfer)
    pieces_.push_back({end_s_, end_s_, {end_m_, Vec3::Zero()}, false});
}

void ClohessyWiltshire::add_leg(const Leg& leg, const std::string& name, Problems& problems) {
  const bool lasts = leg.duration_s > 0 && std::isfinite(leg.duration_s);
  problems.require(lasts, name + ", duration", sim::text_of(leg.duration_s) + " s", "expected more than 0 s");
  problems.require(leg.vector.allFinite(), name, "", "expected finite numbers");
  Piece piece{end_s_, end_s_, {end_m_, Vec3::Zero()}, leg.kind != LegKind::kHold};
  if (leg.kind == LegKind::kDrift) {
    piece.state.v_mps = leg.vector;
    end_m_ = drift(piece.state, mean_motion_radps_, leg.duration_s).p_m;
  } else if (leg.kind == LegKind::kTransfer) {
    const auto velocity = transfer_velocity(end_m_, leg.vector, mean_motion_radps_, leg.duration_s);
    piece.state.v_mps = velocity.value_or(Vec3::Zero());
    problems.require(velocity.has_value() || !lasts, name + ", duration",
                     sim::text_of(leg.duration_s * mean_motion_radps_ / (2 * kPi)) + " revolutions",
                     "no two impulses reach the way point in this time: choose another duration, such as a third of a revolution");
    end_m_ = leg.vector;
  }
  end_s_ += leg.duration_s;
  pieces_.push_back(piece);
}

MotionState ClohessyWiltshire::at(TimeUs t_us) const {
  const double t_s = to_seconds(t_us);
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), t_s, [](double t, const Piece& piece) { return t < piece.from_s; });
  const Piece& piece = *std::prev(after);
  const RelativeState now = piece.free ? drift(piece.state, mean_motion_radps_, t_s - piece.epoch_s) : piece.state;
  MotionState state;
  state.T_a_b.p = now.p_m;
  state.rates.v_mps = now.v_mps;
  return state;
}

}  // namespace lasso::mdat::scene
