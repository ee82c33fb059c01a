// What tells a component from another one on the same bus, or in the same program. Its host says it, and not the mission's image: a
// component speaks before it has one, and two may fly the same.
#pragma once

#include <cstdint>

namespace lasso {

constexpr std::uint16_t kApid = 0x3D1;                         // the preset
constexpr std::uint16_t kLeastApid = 1, kLargestApid = 0x7FE;  // 0 is time (PUS-C), 0x7FF is idle packets (CCSDS 133.0-B-2)

struct Identity {
  std::uint16_t apid = kApid;  // application process: of its telemetry, and of the commands that it takes
  void* context = nullptr;     // the host's own: given back where an invariant of this component fails
};

constexpr bool is_valid(const Identity& identity) { return identity.apid >= kLeastApid && identity.apid <= kLargestApid; }

}  // namespace lasso
