// A sample's bytes, as docs/icd/lcs.md has them within a frame, for who puts samples elsewhere (head_memory.hpp).
#pragma once

#include "fsw/core/byte_codec.hpp"
#include "hal_lcs/messages.hpp"

namespace lasso::lcs {

constexpr std::size_t kSampleBytes = 12;

// Its time is written as that after base_us, at most kMaxSampleOffsetUs (an invariant).
void write_sample(ByteWriter& out, const RawSample& sample, std::uint32_t base_us);
// kBadValue: a kind that is not defined; the kind is then as it was.
Status read_sample(ByteReader& in, std::uint32_t base_us, RawSample& sample);

}  // namespace lasso::lcs
