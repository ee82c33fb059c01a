// The compression of PCD files of kind binary_compressed.
#pragma once

#include <string>
#include <string_view>

namespace lasso::sim {

// Bytes as LZF (Lehmann) packs them: a control byte below 32 says how many bytes follow as they are; any other how far back in the output,
// and for how long, they stand already. False where the data ends within a token, points before the output's begin, or does not give `size`
// bytes: `bytes` is then of no use.
bool unpack_lzf(std::string_view packed, std::size_t size, std::string& bytes);

}  // namespace lasso::sim
