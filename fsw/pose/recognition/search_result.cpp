#include "fsw/pose/recognition/search_result.hpp"

namespace lasso {

const char* to_string(SearchOutcome outcome) {
  switch (outcome) {
    case SearchOutcome::kNone:
      return "none";
    case SearchOutcome::kAccepted:
      return "accepted";
    case SearchOutcome::kAmbiguous:
      return "ambiguous";
    case SearchOutcome::kRejected:
      return "rejected";
  }
  return "unknown";
}

const char* to_string(SearchReason reason) {
  switch (reason) {
    case SearchReason::kNotDone:
      return "not_done";
    case SearchReason::kDistinct:
      return "distinct";
    case SearchReason::kCompetitor:
      return "competitor";
    case SearchReason::kTooFewReturns:
      return "too_few_returns";
    case SearchReason::kUnexplained:
      return "unexplained";
    case SearchReason::kNotRegistered:
      return "not_registered";
    case SearchReason::kUnfinished:
      return "unfinished";
  }
  return "unknown";
}

}  // namespace lasso
