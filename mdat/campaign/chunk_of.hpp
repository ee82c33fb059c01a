// Which chunk of a campaign a command flies: as written, or as the scheduler's job array says.
#pragma once

#include <functional>
#include <string>

#include "mdat/campaign/chunk.hpp"

namespace lasso::mdat {

struct ChosenChunk {
  Chunk chunk;
  std::string from;  // for a person: "SLURM_ARRAY_TASK_ID=3, which counts from 1, of 10 (SLURM_ARRAY_TASK_COUNT)"; empty if it was written
};

// The value of a variable of the environment; nullptr if there is none.
using Environment = std::function<const char*(const char* name)>;

// Of "3/10" (the third of ten chunks), "auto" or "auto/10" (ten chunks, the index from the first of the known variables that is set; "auto"
// alone where the scheduler also says how many elements the array has). Throws InputError.
ChosenChunk chunk_of(const std::string& text, const Environment& environment);

}  // namespace lasso::mdat
