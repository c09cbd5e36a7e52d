#include <sweep/slurm_job.h>

#include <algorithm>
#include <utility>

#include <host/command.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::sweep {

namespace {

/// Questions without an answer, one a second or two, before we give up.
constexpr int most_silent = 60;

std::string one_line(const std::string& text) {
  std::string line(vp::trim(text));
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

}  // namespace

std::uint32_t largest_array() {
  const host::CommandEnd end = host::run_command({"scontrol", "show", "config"});
  if (end.exit_code == host::no_such_command)
    throw vp::InputError(
        "--engine slurm: there is no Slurm here (sbatch is not found): run where "
        "jobs are submitted, or leave out --engine");
  if (end.exit_code != 0)
    throw vp::InputError("--engine slurm: Slurm does not answer: " + one_line(end.out));
  const std::string name = "MaxArraySize";
  const std::size_t at = end.out.find(name);
  const std::size_t digits = at == std::string::npos ? at : end.out.find_first_of("0123456789", at);
  if (digits == std::string::npos) return 1000;
  // The largest number of a task is one less.
  return static_cast<std::uint32_t>(std::max(2L, std::strtol(&end.out[digits], nullptr, 10)) - 1);
}

std::string submit(const ArrayJob& job) {
  std::string array = "--array=0-" + std::to_string(job.tasks - 1);
  if (job.at_once != 0) array += "%" + std::to_string(job.at_once);
  std::vector<std::string> arguments{"sbatch",
                                     "--parsable",
                                     "--requeue",
                                     "--open-mode=append",
                                     "--job-name=" + job.name,
                                     "--chdir=" + job.folder,
                                     "--output=" + job.log,
                                     array};
  arguments.insert(arguments.end(), job.options.begin(), job.options.end());
  arguments.push_back("--wrap=" + job.command);
  const host::CommandEnd end = host::run_command(arguments);
  // "12" or "12;cluster", perhaps below warnings.
  const std::vector<std::string> lines = vp::split(vp::trim(end.out), '\n');
  const std::string number = lines.back().substr(0, lines.back().find(';'));
  if (end.exit_code != 0 || number.empty() ||
      number.find_first_not_of("0123456789") != std::string::npos) {
    throw vp::InputError("sbatch does not take the sweep: " + one_line(end.out));
  }
  return number;
}

JobWatch::JobWatch(std::string job) : job_(std::move(job)) {}

bool JobWatch::active() {
  const host::CommandEnd end =
      host::run_command({"squeue", "--noheader", "--jobs=" + job_, "--format=%T"});
  if (end.exit_code == 0) {
    silent_ = 0;
    return !vp::trim(end.out).empty();
  }
  if (end.out.find("Invalid job id") != std::string::npos) return false;
  if (++silent_ > most_silent)
    throw vp::InputError("Slurm does not answer any more: " + one_line(end.out) +
                         "; run the same sweep again when it does: job " + job_ + " goes on");
  return true;
}

void cancel(const std::string& job) {
  host::run_command({"scancel", job});
}

}  // namespace platform::sweep
