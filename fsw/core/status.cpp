#include "fsw/core/status.hpp"

namespace lasso {

const char* to_string(Status status) {
  switch (status) {
    case Status::kOk:
      return "ok";
    case Status::kTruncated:
      return "truncated";
    case Status::kBadMagic:
      return "bad magic";
    case Status::kBadVersion:
      return "bad version";
    case Status::kBadLength:
      return "bad length";
    case Status::kBadCrc:
      return "bad crc";
    case Status::kBadIndex:
      return "bad index";
    case Status::kBadValue:
      return "bad value";
    case Status::kNotFinite:
      return "not finite";
    case Status::kOverCapacity:
      return "over capacity";
    case Status::kMissing:
      return "missing";
    case Status::kBadOrder:
      return "bad order";
    case Status::kBusy:
      return "busy";
    case Status::kTimeout:
      return "timeout";
    case Status::kNoData:
      return "no data";
    case Status::kSingular:
      return "singular";
    case Status::kOffPlan:
      return "off plan";
    case Status::kNotSigned:
      return "not signed";
    case Status::kNotAuthentic:
      return "not authentic";
  }
  return "unknown";  // a value that no enumerator has, for example from a corrupt byte
}

}  // namespace lasso
