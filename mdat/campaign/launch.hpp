// Files that start a campaign's chunks: job arrays of schedulers, lists of commands. No file system, no scheduler is needed to write them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lasso::mdat {

struct LaunchOptions {
  std::string program;  // mdat, as the machines find it
  std::string folder;   // of the campaign, as the machines find it; jobs write their logs into its launch/, which must be there
  std::uint32_t chunks = 1;
  double chunk_s = 900;  // how long a chunk probably takes; jobs ask for four times that, and not less than ten minutes
};

struct Launcher {
  const char* engine;  // "slurm"
  const char* file;    // "slurm.sbatch"
  const char* submit;  // "sbatch slurm.sbatch"
  std::string (*text)(const LaunchOptions& options);
};

// slurm, pbs, lsf, sge, htcondor, k8s, parallel, local
const std::vector<Launcher>& launchers();

// Throws InputError, which names those that there are.
const Launcher& launcher_of(const std::string& engine);

// The file of one of the engines. Each chunk that is ended early goes on when the same file is submitted again. Throws InputError: no such
// engine, or a folder whose name schedulers would cut up.
std::string launch_text(const std::string& engine, const LaunchOptions& options);

// Chunks of about a quarter of an hour, at most a thousand (the largest job array that Slurm takes as it is installed).
std::uint32_t chunks_for(std::uint32_t cases, double seconds_per_case);

}  // namespace lasso::mdat
