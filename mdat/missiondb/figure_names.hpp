// What a campaign keeps of a case, by the names that criteria use: those of case_figures() (mdat/campaign/figures.hpp), in their order.
#pragma once

namespace lasso::mdat {

constexpr const char* kFigureNames[] = {"frames",
                                        "valid",
                                        "invalid",
                                        "lost",
                                        "wrong",
                                        "first_wrong",
                                        "found_s",
                                        "rms_mm",
                                        "p95_mm",
                                        "worst_mm",
                                        "rms_deg",
                                        "p95_deg",
                                        "worst_deg",
                                        "last_mm",
                                        "last_deg",
                                        "nees",
                                        "settled_invalid",
                                        "settled_degps",
                                        "settled_mmps",
                                        "episodes",
                                        "censored",
                                        "time_to_alert_worst_s",
                                        "misleading",
                                        "misleading_share",
                                        "level_median_mm",
                                        "level_worst_mm",
                                        "level_median_deg",
                                        "level_worst_deg"};

}  // namespace lasso::mdat
