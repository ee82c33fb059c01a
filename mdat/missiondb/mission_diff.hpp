// What differs between two missions, or flight images, by the values that hold.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/mission_text.hpp"

namespace lasso::mdat {

// A key whose value is another one in the two; empty where there is no such key.
struct ValueChange {
  std::string key, unit, first, second;
};

// In the order of the first, then what the second alone has. Values that in both follow another key's are not told again.
std::vector<ValueChange> changes_between(const std::vector<EffectiveValue>& first, const std::vector<EffectiveValue>& second);

// What a mission is told from others by, as effective values.
std::vector<EffectiveValue> identity_values(std::uint32_t id, std::uint32_t version);

// The flight parameters as effective values, as an image has them.
std::vector<EffectiveValue> values_of(const MissionParameters& parameters);

// What the scenarios say of flight parameters, under scenario.NAME.override.KEY.
std::vector<EffectiveValue> override_values(const MissionSource& source);

}  // namespace lasso::mdat
