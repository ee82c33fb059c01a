// The reason why an operation was refused. Everything that comes from outside is validated and answered with one of these.
#pragma once

#include <cstdint>

namespace lasso {

enum class [[nodiscard]] Status : std::uint8_t{
    kOk = 0,
    kTruncated,     // fewer bytes than the format needs
    kBadMagic,      // not this format at all
    kBadVersion,    // this format, another version
    kBadLength,     // a length field contradicts the data
    kBadCrc,        // checksum does not match
    kBadIndex,      // an index points outside its table
    kBadValue,      // a value outside its declared range
    kNotFinite,     // NaN or infinity
    kOverCapacity,  // more than the flight component has room for
    kMissing,       // a required part is not there
    kBadOrder,      // called, or numbered, out of sequence
    kBusy,          // an earlier request still runs
    kTimeout,       // no answer within the configured time
    kNoData,        // nothing to work on
    kSingular,      // a factorisation or division has no meaning
    kOffPlan,       // a device does something else than it was told
    kNotSigned,     // it has no signature, and needs one
    kNotAuthentic,  // its signature is not right
};

// A short lower-case name for messages; never null.
const char* to_string(Status status);

}  // namespace lasso
