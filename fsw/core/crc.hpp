// Cyclic redundancy checks.
#pragma once

#include <cstdint>

#include "fsw/core/span.hpp"

namespace lasso {

// CRC-16/CCITT-FALSE (CCSDS packet error control): polynomial 0x1021, initial 0xFFFF; "123456789" gives 0x29B1.
std::uint16_t crc16_ccitt(ConstBytes data, std::uint16_t seed = 0xFFFF);

// CRC-32C (Castagnoli), reflected; "123456789" gives 0xE3069283. Chain calls by passing the last result as `seed`.
std::uint32_t crc32c(ConstBytes data, std::uint32_t seed = 0);

}  // namespace lasso
