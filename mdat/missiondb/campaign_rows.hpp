// The plain values of [campaign.NAME] and of its criteria as rows. Inside of missiondb.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {

// scenario, cases, seed, ...; truth, mission, together and criteria are tables beside them.
const std::vector<ValueRow>& campaign_rows();

// Of [campaign.NAME.criteria.NAME].
const std::vector<ValueRow>& criterion_rows();

// Of [[campaign.NAME.together]], where `covariance` stands beside them.
const std::vector<ValueRow>& together_rows();

}  // namespace lasso::mdat
