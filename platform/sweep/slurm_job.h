#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform::sweep {

/// An array of tasks to hand to Slurm.
struct ArrayJob {
  std::string name;
  std::string folder;  ///< where the tasks start
  std::string log;     ///< of each task: %a is its number
  std::uint32_t tasks = 1;
  std::uint32_t at_once = 0;         ///< tasks that run at the same time; 0: as many as fit
  std::string command;               ///< for the shell; SLURM_ARRAY_TASK_ID is the task's number
  std::vector<std::string> options;  ///< more for sbatch: "--partition=dse"
};

/// Tasks that one array may have. Throws vp::InputError if there is no Slurm here.
std::uint32_t largest_array();

/// Hands the tasks to Slurm; one that loses its node is put back into the queue. Returns the job's
/// number. Throws vp::InputError with what sbatch said.
std::string submit(const ArrayJob& job);

/// Whether tasks of the job wait or run. Slurm may be silent for a while; then the answer is yes.
/// Throws vp::InputError if it stays silent.
class JobWatch {
 public:
  explicit JobWatch(std::string job);
  bool active();

 private:
  std::string job_;
  int silent_ = 0;
};

void cancel(const std::string& job);

}  // namespace platform::sweep
