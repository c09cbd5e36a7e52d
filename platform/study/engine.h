#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include <study/manifest.h>
#include <study/store.h>

namespace platform::study {

/// What a run found.
struct RunResult {
  Json result;                                       ///< as ResultDocument has it
  std::map<std::string, std::string> configuration;  ///< effective
};

/// Runs the platform, as if its process had run nothing before. Returns the exit code of `markervp
/// run`, and says on `err` what went wrong; may throw what that throws.
using RunPoint = std::function<int(const Setup& setup, RunResult& result, std::ostream& err)>;

/// How a sweep went; the shards of its folder have the outcomes.
struct Tally {
  std::uint64_t computed = 0;   ///< done now
  std::uint64_t abandoned = 0;  ///< begun, and broken off; nothing of them is kept
  bool interrupted = false;     ///< by a signal, or because the time was up
};

/// Whether the time for computing is up. Asked some times a second; may be empty.
using IsOver = std::function<bool()>;

/// Called when points were completed: how many of those asked for.
using OnProgress = std::function<void(std::uint64_t done)>;

/// Points that a process computes, one after another, before another takes its place. Each leaves
/// SystemC's old context behind, about 50 KiB (measured: 48 MiB after 1000): so a process holds
/// some 12 MiB of them, and shares what it costs to start and end it among 256 points.
constexpr std::uint32_t usual_points_a_process = 256;

struct LocalOptions {
  std::uint32_t jobs = 1;
  std::string name = "local";  ///< is in the shards
  std::uint32_t points_a_process = usual_points_a_process;
  /// Called with a sentence when a process dies; may be empty.
  std::function<void(const std::string& text)> warn = {};
  /// Points that are not finished by then are abandoned.
  IsOver is_over = {};
  bool keep_results = false;  ///< whole, as KeptResult
};

/// Computes the points at these positions of the manifest in `jobs` processes at a time, which take
/// them one after another. A process that crashes or is killed costs the one point that it was at,
/// which is tried once more in a process of its own; so does one whose run did not end well, since
/// what it left behind is not known. Points that have a result get another. Throws vp::HostError
/// if the machine fails, as when a result cannot be written: those written before are kept.
Tally run_local(const Store& store, const Manifest& manifest,
                const std::vector<std::size_t>& positions, const LocalOptions& options,
                const RunPoint& run, const OnProgress& progress);

struct SlurmOptions {
  std::uint32_t chunk = 0;           ///< points a task; 0: as many as take some seconds
  std::uint32_t at_once = 0;         ///< tasks that run at the same time; 0: as many as fit
  std::vector<std::string> options;  ///< more for sbatch
  std::string name;                  ///< of the sweep
  std::uint32_t points_a_process = usual_points_a_process;
  IsOver is_over = {};  ///< cancels the job
  bool keep_results = false;
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

/// A task of a submission.
struct SlurmTask {
  std::uint32_t submission = 0;
  std::uint32_t number = 0;
  std::uint32_t points_a_process = usual_points_a_process;
  bool keep_results = false;
};

/// What a task does: its share of the submission. `err` is its log, and gets what
/// LocalOptions::warn would. Returns the exit code.
int run_slurm_task(
    const Store& store, const SlurmTask& task,
    const std::function<void(const Manifest&, const std::vector<std::size_t>&)>& warm,
    const RunPoint& run, std::ostream& err);

/// Says on `err` what the tasks warned of in their logs in the folder, twenty warnings at most, and
/// which task each is of.
void tell_warnings(const std::string& folder, std::ostream& err);

}  // namespace platform::study
