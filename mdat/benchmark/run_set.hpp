// The component on a benchmark set, as `mdat replay --wide` registers single scans.
#pragma once

#include <filesystem>

#include "mdat/benchmark/program_poses.hpp"

namespace lasso::mdat {

// A row a scan, in the set's order, with covariance and processor time. Throws as read_protocol and check_files, and as a replay does.
ProgramPoses run_set(const std::filesystem::path& folder, bool cached);

}  // namespace lasso::mdat
