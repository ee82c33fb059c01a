#include "mdat/campaign/launch.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

constexpr double kChunkSeconds = 900;
constexpr std::uint32_t kMostChunks = 1000;
constexpr unsigned kEndMinutes = 1;  // between the last case and the job's end

unsigned minutes_of(const LaunchOptions& options) { return std::max(10U, static_cast<unsigned>(std::ceil(4 * options.chunk_s / 60))); }

std::string clock_of(unsigned minutes) { return format("%02u:%02u:00", minutes / 60, minutes % 60); }

std::string log_folder(const LaunchOptions& options) { return options.folder + "/launch"; }

// One chunk is no array: PBS refuses one of a single element.
std::string array_line(const LaunchOptions& options, const std::string& line) {
  return options.chunks > 1 ? line + std::to_string(options.chunks) + "\n" : "";
}

std::string chunk_word(const LaunchOptions& options) { return options.chunks > 1 ? "auto/" + std::to_string(options.chunks) : "1/1"; }

std::string chunk_command(const LaunchOptions& options, const std::string& chunk) {
  return shell_word(options.program) + " campaign run " + shell_word(options.folder) + " --chunk " + chunk + " --jobs 1";
}

// exec: the scheduler's SIGTERM reaches mdat, which writes down what it has.
std::string job_command(const LaunchOptions& options) {
  return "exec " + chunk_command(options, chunk_word(options)) + format(" --time-limit %u\n", 60 * (minutes_of(options) - kEndMinutes));
}

std::string slurm_text(const LaunchOptions& options) {
  return "#!/bin/sh\n#SBATCH --job-name=campaign\n" + array_line(options, "#SBATCH --array=1-") +
         "#SBATCH --ntasks=1\n#SBATCH --time=" + clock_of(minutes_of(options)) +
         "\n#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --signal=B:TERM@30\n#SBATCH --output=" + log_folder(options) +
         (options.chunks > 1 ? "/slurm-%A_%a.log\n" : "/slurm-%j.log\n") + job_command(options);
}

std::string pbs_text(const LaunchOptions& options) {
  return "#!/bin/sh\n#PBS -N campaign\n" + array_line(options, "#PBS -J 1-") +
         "#PBS -l select=1:ncpus=1\n#PBS -l walltime=" + clock_of(minutes_of(options)) + "\n#PBS -r y\n#PBS -j oe\n#PBS -o " +
         log_folder(options) + "/\n" + job_command(options);
}

std::string lsf_text(const LaunchOptions& options) {
  const std::string name = options.chunks > 1 ? "campaign[1-" + std::to_string(options.chunks) + "]" : "campaign";
  return "#!/bin/sh\n#BSUB -J " + name + "\n#BSUB -n 1\n" + format("#BSUB -W %u\n", minutes_of(options)) + "#BSUB -r\n#BSUB -o " +
         log_folder(options) + (options.chunks > 1 ? "/lsf-%J_%I.log\n" : "/lsf-%J.log\n") + job_command(options);
}

std::string sge_text(const LaunchOptions& options) {
  return "#!/bin/sh\n#$ -S /bin/sh\n#$ -N campaign\n" + array_line(options, "#$ -t 1-") + "#$ -l h_rt=" + clock_of(minutes_of(options)) +
         "\n#$ -r y\n#$ -j y\n#$ -o " + log_folder(options) + "/\n" + job_command(options);
}

// Exit code 75 puts a job back into the queue.
std::string htcondor_text(const LaunchOptions& options) {
  const std::string log = log_folder(options) + "/htcondor-$(Cluster)_$(Process)";
  return "# $(Process) counts from 0, chunks from 1\nexecutable = " + options.program +
         "\nchunk = $(Process) + 1\narguments = campaign run " + options.folder + " --chunk $INT(chunk)/" + std::to_string(options.chunks) +
         " --jobs 1\nrequest_cpus = 1\nshould_transfer_files = NO\nkill_sig = SIGTERM\n"
         "on_exit_remove = (ExitBySignal == False) && (ExitCode =!= 75)\n"
         "output = " +
         log + ".out\nerror = " + log + ".err\nlog = " + log + ".log\nqueue " + std::to_string(options.chunks) + "\n";
}

std::string k8s_text(const LaunchOptions& options) {
  const std::string chunks = std::to_string(options.chunks);
  return "apiVersion: batch/v1\nkind: Job\nmetadata: {name: campaign}\nspec:\n  completionMode: Indexed\n  completions: " + chunks +
         "\n  parallelism: " + chunks + "\n  backoffLimit: 1000\n  template:\n    spec:\n      restartPolicy: OnFailure\n" +
         "      containers:\n      - name: mdat\n        image: IMAGE  # yours, with mdat\n        command: [\"" + options.program +
         "\", campaign, run, \"" + options.folder + "\", --chunk, \"auto/" + chunks + "\", --jobs, \"1\"]\n" +
         "        volumeMounts: [{name: campaign, mountPath: \"" + options.folder +
         "\"}]\n      volumes: [{name: campaign, persistentVolumeClaim: {claimName: CLAIM}}]  # yours, ReadWriteMany, with the folder\n";
}

std::string parallel_text(const LaunchOptions& options) {
  std::string text;
  for (std::uint32_t i = 1; i <= options.chunks; ++i)
    text += chunk_command(options, std::to_string(i) + "/" + std::to_string(options.chunks)) + "\n";
  return text;
}

std::string local_text(const LaunchOptions& options) {
  return "#!/bin/sh\nexec " + shell_word(options.program) + " campaign run " + shell_word(options.folder) + "\n";
}

bool takes_any_name(const std::string& engine) { return engine == "parallel" || engine == "local"; }

}  // namespace

const std::vector<Launcher>& launchers() {
  static const std::vector<Launcher> all = {
      {"slurm", "slurm.sbatch", "sbatch slurm.sbatch", slurm_text},
      {"pbs", "pbs.sh", "qsub pbs.sh", pbs_text},
      {"lsf", "lsf.sh", "bsub < lsf.sh", lsf_text},
      {"sge", "sge.sh", "qsub sge.sh", sge_text},
      {"htcondor", "htcondor.sub", "condor_submit htcondor.sub", htcondor_text},
      {"k8s", "k8s-job.yaml", "kubectl apply -f k8s-job.yaml", k8s_text},
      {"parallel", "parallel.txt", "parallel < parallel.txt", parallel_text},
      {"local", "local.sh", "sh local.sh", local_text},
  };
  return all;
}

const Launcher& launcher_of(const std::string& engine) {
  std::vector<std::string> names;
  for (const Launcher& launcher : launchers()) {
    if (engine == launcher.engine) return launcher;
    names.emplace_back(launcher.engine);
  }
  std::string known;
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  throw InputError("--engine " + engine + ": not known" + did_you_mean(engine, names) + "; known are " + known);
}

std::string launch_text(const std::string& engine, const LaunchOptions& options) {
  const Launcher& launcher = launcher_of(engine);
  for (const std::string& name : {options.folder, options.program}) {
    if (!takes_any_name(engine) && shell_word(name) != name)
      throw InputError(name + ": " + engine + " does not take a name with spaces or signs in its job files: move it, or link to it");
  }
  return launcher.text(options);
}

std::uint32_t chunks_for(std::uint32_t cases, double seconds_per_case) {
  const double chunks = std::ceil(cases * seconds_per_case / kChunkSeconds);
  return static_cast<std::uint32_t>(std::clamp(chunks, 1.0, static_cast<double>(std::clamp(cases, 1U, kMostChunks))));
}

}  // namespace lasso::mdat
