// The campaigns of a mission: what each varies, and what it asks.
#pragma once

#include <map>
#include <string>

#include "mdat/missiondb/campaign_source.hpp"

namespace lasso::mdat {

// For a terminal: a few lines each. Of no campaign: how to write one.
std::string campaign_list(const std::map<std::string, CampaignSource>& campaigns);

// As a Markdown table, a line each; empty of no campaign.
std::string campaign_table(const std::map<std::string, CampaignSource>& campaigns);

}  // namespace lasso::mdat
