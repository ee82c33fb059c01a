#include "fsw/mode/modes.hpp"

namespace lasso {
namespace {

using M = TrackingMode;
using E = ModeEvent;

// clang-format off
constexpr ModeTransition kTransitions[] = {
  {M::kStandby,  E::kStart,       M::kStarting, "a pose to start from"},
  {M::kStarting, E::kStart,       M::kStarting, "another pose to start from"},
  {M::kStarting, E::kStop,        M::kStandby,  "commanded"},
  {M::kStarting, E::kPoseValid,   M::kTracking, "a scan confirms the start"},
  {M::kStarting, E::kPoseInvalid, M::kStarting, "the next scan tries again"},
  {M::kStarting, E::kExhausted,   M::kLost,     "no scan confirmed the start"},
  {M::kTracking, E::kStart,       M::kStarting, "another pose to start from"},
  {M::kTracking, E::kStop,        M::kStandby,  "commanded"},
  {M::kTracking, E::kPoseValid,   M::kTracking, "the track holds"},
  {M::kTracking, E::kPoseInvalid, M::kCoasting, "the filter bridges a scan without a pose"},
  {M::kTracking, E::kExhausted,   M::kLost,     "no coasting is allowed"},
  {M::kCoasting, E::kStart,       M::kStarting, "another pose to start from"},
  {M::kCoasting, E::kStop,        M::kStandby,  "commanded"},
  {M::kCoasting, E::kPoseValid,   M::kTracking, "the track is taken up again"},
  {M::kCoasting, E::kPoseInvalid, M::kCoasting, "the filter bridges another scan"},
  {M::kCoasting, E::kExhausted,   M::kLost,     "too many scans without a pose"},
  {M::kLost,     E::kStart,       M::kStarting, "a pose to start from"},
  {M::kLost,     E::kStop,        M::kStandby,  "commanded"},
};

constexpr ModeProperties kProperties[] = {
  //              scans  says_lost wide
  {M::kStandby,  false, false,  false, "standby"},
  {M::kStarting, true,  false,  true,  "starting"},
  {M::kTracking, true,  false,  false, "tracking"},
  {M::kCoasting, true,  false,  false, "coasting"},
  {M::kLost,     false, true,   false, "lost"},
};
// clang-format on

}  // namespace

Span<const ModeTransition> mode_transitions() { return Span<const ModeTransition>(kTransitions); }

Span<const ModeProperties> mode_properties() { return Span<const ModeProperties>(kProperties); }

TrackingMode next_mode(TrackingMode from, ModeEvent event) {
  for (const ModeTransition& row : kTransitions) {
    if (row.from == from && row.event == event) return row.to;
  }
  return from;
}

const ModeProperties& properties(TrackingMode mode) { return mode_properties()[static_cast<std::size_t>(mode)]; }

const char* to_string(TrackingMode mode) { return properties(mode).name; }

}  // namespace lasso
