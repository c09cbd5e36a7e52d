#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include <sweep/engine.h>

namespace platform::sweep {

struct SlurmOptions {
  std::uint32_t chunk = 0;           ///< points a task; 0: as many as take some seconds
  std::uint32_t at_once = 0;         ///< tasks that run at the same time; 0: as many as fit
  std::vector<std::string> options;  ///< more for sbatch
  std::string name;                  ///< of the sweep
  std::uint32_t points_a_process = usual_points_a_process;
};

/// Tasks that one array may have. Throws vp::InputError if Slurm does not answer here.
std::uint32_t largest_array();

/// Computes the points at these positions on a cluster, through arrays of tasks that each compute
/// several points; the folder must be one that all nodes see. A job that an earlier call left in
/// the queue is waited for first. On Ctrl-C the job is cancelled. Points that no task completes, in
/// two rounds, are recorded as failed. `run` computes one point here, to see how long it takes.
Tally run_slurm(const Store& store, const Manifest& manifest,
                const std::vector<std::size_t>& positions, const SlurmOptions& options,
                const RunPoint& run, const OnProgress& progress, std::ostream& err);

/// What a task does: its share of submission number `submission`. Returns the exit code.
int run_slurm_task(
    const Store& store, std::uint32_t submission, std::uint32_t task,
    const std::function<void(const Manifest&, const std::vector<std::size_t>&)>& warm,
    const RunPoint& run, std::uint32_t points_a_process);

}  // namespace platform::sweep
