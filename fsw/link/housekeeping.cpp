#include "fsw/link/housekeeping.hpp"

#include "fsw/core/span.hpp"

namespace lasso {
namespace {

constexpr std::uint16_t kLongest = 0xFFFF;

bool exists(std::uint16_t structure) { return structure > 0 && structure < kStructures; }

}  // namespace

Housekeeping::Housekeeping() {
  for (std::size_t i = 0; i < kStructures; ++i) {
    states_[i].period = Span<const std::uint16_t>(kPresetPeriods)[i];
    states_[i].age = kLongest;
  }
  states_[kFilterStructureId].enabled = false;
}

bool Housekeeping::set_enabled(std::uint16_t structure, bool enabled) {
  if (!exists(structure)) return false;
  states_[structure].enabled = enabled;
  return true;
}

bool Housekeeping::set_period(std::uint16_t structure, std::uint16_t frames) {
  if (!exists(structure)) return false;
  states_[structure].period = frames;
  return true;
}

bool Housekeeping::ask(std::uint16_t structure) {
  if (!exists(structure)) return false;
  states_[structure].asked = true;
  return true;
}

bool Housekeeping::due(std::uint16_t structure, bool news) {
  State& state = Span<State>(states_)[structure];
  const bool its_time = state.period == 0 ? news : state.age >= state.period;
  const bool by_itself = state.enabled && its_time;
  if (!state.asked && !by_itself) return false;
  state.asked = false;
  state.age = 0;
  return true;
}

bool Housekeeping::asked(std::uint16_t structure) const { return Span<const State>(states_)[structure].asked; }

void Housekeeping::pass_boundary() {
  for (State& state : states_) {
    if (state.age < kLongest) ++state.age;
  }
}

}  // namespace lasso
