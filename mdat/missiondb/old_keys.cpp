#include "mdat/missiondb/old_keys.hpp"

namespace lasso::mdat {
namespace {

struct OldKey {
  const char* key;
  const char* now;
};
constexpr OldKey kReplaced[] = {
    {"tracking.normalized_residual_max",
     "is sensor.noise_tolerance now, 1.5 where nobody writes it: how many times the stated noise residuals may show"},
    {"start.twin_margin", "is no longer asked: tracking.agreement_min tells such starts; leave the line out"}};

// Numbers of a method, which a mission once could change (docs/decisions/parameters.md).
constexpr OldKey kConstants[] = {{"sensing.rest_frames", "50"},
                                 {"sensing.look_scans", "10"},
                                 {"estimation.stop_rotation_deg", "0.01"},
                                 {"estimation.label_error", "0.001"},
                                 {"start.gate", "25"},
                                 {"search.hits_min", "80"},
                                 {"search.disagreement_max", "0.2"},
                                 {"search.ratio_min", "1.3"},
                                 {"search.scans_max", "3"},
                                 {"search.work_max", "2500000"},
                                 {"short_range.disagreement_max", "6"},
                                 {"short_range.rest_frames", "25"}};

}  // namespace

std::string remedy_of_old_key(const std::string& key) {
  for (const OldKey& old : kReplaced) {
    if (key == old.key) return old.now;
  }
  for (const OldKey& old : kConstants) {
    if (key == old.key) return "is " + std::string(old.now) + " in every mission: leave it out";
  }
  return "";
}

}  // namespace lasso::mdat
