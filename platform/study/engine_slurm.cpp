#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <ostream>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <host/document.h>
#include <host/output_folder.h>
#include <host/process.h>
#include <study/engine.h>
#include <study/shard.h>
#include <study/shards.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform::study {

namespace {

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

namespace {

/// Hands the tasks to Slurm; one that loses its node is put back into the queue. Returns the job's
/// number. Throws vp::InputError with what sbatch said.
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
  std::string number = lines.back().substr(0, lines.back().find(';'));
  if (end.exit_code != 0 || number.empty() ||
      number.find_first_not_of("0123456789") != std::string::npos) {
    throw vp::InputError("sbatch does not take the sweep: " + one_line(end.out));
  }
  return number;
}

/// Whether tasks of the job wait or run. Slurm may be silent for a while; then the answer is yes.
/// Throws vp::InputError if it stays silent.
class JobWatch {
 public:
  explicit JobWatch(std::string job) : job_(std::move(job)) {}

  bool active() {
    const host::CommandEnd end =
        host::run_command({"squeue", "--noheader", "--jobs=" + job_, "--format=%T"});
    if (end.exit_code == 0) {
      silent_ = 0;
      return !vp::trim(end.out).empty();
    }
    if (end.out.find("Invalid job id") != std::string::npos) return false;
    if (++silent_ > most_silent)
      throw vp::InputError("Slurm does not answer any more: " + one_line(end.out) +
                           "; run the same sweep again when it does: job " + job_ + " continues");
    return true;
  }

 private:
  std::string job_;
  int silent_ = 0;
};

void cancel(const std::string& job) {
  host::run_command({"scancel", job});
}

namespace fs = std::filesystem;
using HostClock = std::chrono::steady_clock;

/// Slurm takes about half a second to start a task: one should last much longer.
constexpr double task_seconds = 8;
constexpr auto poll_period = std::chrono::milliseconds(500);
constexpr int most_rounds = 2;

std::string submission_folder(const Store& store, std::uint32_t number) {
  return store.path("slurm/" + std::to_string(number));
}

Json read_json(const std::string& path) {
  return host::read_json<Json>(path, "the sweep's own file", host::largest_result);
}

/// Of the positions, those of points without a result now.
std::vector<std::size_t> missing(Shards& shards, const Manifest& manifest,
                                 const std::vector<std::size_t>& positions) {
  shards.refresh();
  std::vector<std::size_t> result;
  std::copy_if(positions.begin(), positions.end(), std::back_inserter(result),
               [&](std::size_t position) { return !shards.has(manifest.points[position].key); });
  return result;
}

/// What a task needs of the manifest, with the points at these positions: a task does not read a
/// million points for a thousand of them.
Manifest part_of(const Manifest& whole, const std::vector<std::size_t>& positions) {
  Manifest part;
  part.name = whole.name;
  part.program = whole.program;
  part.tables = whole.tables;
  part.input = whole.input;
  std::map<std::size_t, std::size_t> families, input_sets;  // their numbers in the part
  for (const std::size_t position : positions) {
    Point& point = part.points.emplace_back(whole.points[position]);
    const auto [family, is_new_family] = families.emplace(point.family, part.families.size());
    if (is_new_family) part.families.push_back(whole.families[point.family]);
    point.family = family->second;
    const auto [inputs, are_new] = input_sets.emplace(point.input_set, part.input_sets.size());
    if (are_new) part.input_sets.push_back(whole.input_sets[point.input_set]);
    point.input_set = inputs->second;
  }
  return part;
}

constexpr const char* warning_mark = "markervp: warning: ";

/// For LocalOptions::warn.
std::function<void(const std::string&)> warns_on(std::ostream& err) {
  return [&err](const std::string& text) { err << warning_mark << text << std::endl; };
}

std::string task_file(const std::string& submission, std::size_t task) {
  return submission + "/task-" + std::to_string(task) + ".json";
}

class Cluster {
 public:
  Cluster(const Store& store, const Manifest& manifest, const SlurmOptions& options,
          const RunPoint& run, const OnProgress& progress, std::ostream& err)
      : store_(store),
        shards_(store),
        manifest_(manifest),
        options_(options),
        run_(run),
        progress_(progress),
        err_(err) {}

  Tally compute(const std::vector<std::size_t>& positions) {
    host::prepare_output_folder(store_.path("slurm"));
    total_ = positions.size();
    largest_ = largest_array();
    wait_for_earlier(positions);
    std::vector<std::size_t> wanted = missing(shards_, manifest_, positions);
    if (!wanted.empty() && !tally_.interrupted) measure(wanted);
    for (int round = 0; round < most_rounds && !tally_.interrupted; ++round) {
      wanted = missing(shards_, manifest_, positions);
      if (wanted.empty()) break;
      watch(submit_chunks(wanted), wanted);
      tell_warnings(logs_, err_);
    }
    if (!tally_.interrupted) give_up(missing(shards_, manifest_, positions));
    tally_.computed = total_ - missing(shards_, manifest_, positions).size();
    return tally_;
  }

 private:
  std::string job_file() const { return store_.path("slurm/job.json"); }

  /// An earlier call may have been killed, and its job be still in the queue.
  void wait_for_earlier(const std::vector<std::size_t>& positions) {
    std::error_code ignored;
    if (!fs::exists(job_file(), ignored)) return;
    const Json earlier = read_json(job_file());
    const std::string job = earlier.value("job", "");
    if (job.empty() || !JobWatch(job).active()) return;
    err_ << "markervp: job " << job << " of an earlier call is still in the queue: waiting for it"
         << std::endl;
    watch(job, positions);
    tell_warnings(submission_folder(store_, earlier.value("submission", 0U)), err_);
  }

  /// Runs one point here to see how many make a task.
  void measure(const std::vector<std::size_t>& wanted) {
    chunk_ = options_.chunk;
    if (chunk_ != 0) return;
    const HostClock::time_point begin = HostClock::now();
    const Tally tally = run_local(store_, manifest_, {wanted.front()},
                                  {1, "local", options_.points_a_process, warns_on(err_),
                                   options_.is_over, options_.keep_results},
                                  run_, nullptr);
    tally_.interrupted = tally.interrupted;
    const double seconds = std::chrono::duration<double>(HostClock::now() - begin).count();
    chunk_ = static_cast<std::uint32_t>(
        std::clamp(std::ceil(task_seconds / std::max(seconds, 1e-3)), 1.0, 100'000.0));
  }

  std::string submit_chunks(const std::vector<std::size_t>& wanted) {
    const std::size_t least = (wanted.size() + largest_ - 1) / largest_;
    const auto size = static_cast<std::ptrdiff_t>(std::max<std::size_t>(chunk_, least));
    std::uint32_t number = 1;
    std::error_code ignored;
    while (fs::exists(submission_folder(store_, number), ignored)) ++number;
    const std::string folder = submission_folder(store_, number);
    host::prepare_output_folder(folder);
    std::uint32_t tasks = 0;
    for (auto first = wanted.begin(); first != wanted.end(); ++tasks) {
      const auto last = first + std::min(size, wanted.end() - first);
      write_manifest(task_file(folder, tasks), part_of(manifest_, {first, last}));
      first = last;
    }
    const std::string executable = fs::read_symlink("/proc/self/exe").string();
    std::string job =
        submit({"markervp-" + options_.name, fs::current_path().string(),
                fs::absolute(folder).string() + "/task-%a.log", tasks, options_.at_once,
                "exec " + host::shell_quoted(executable) + " sweep-worker " +
                    host::shell_quoted(fs::absolute(store_.folder()).string()) + " " +
                    std::to_string(number) + " $SLURM_ARRAY_TASK_ID " +
                    std::to_string(options_.points_a_process) +
                    (options_.keep_results ? " --keep-results" : ""),
                options_.options});
    vp::write_file_durably(job_file(), Json{{"job", job}, {"submission", number}}.dump());
    err_ << "markervp: job " << job << ": " << tasks << " tasks of " << size << " points; logs in "
         << folder << std::endl;
    logs_ = folder;
    return job;
  }

  void watch(const std::string& job, const std::vector<std::size_t>& wanted) {
    JobWatch queue(job);
    for (;;) {
      const std::size_t left = missing(shards_, manifest_, wanted).size();
      if (progress_) progress_(total_ - left);
      if (left == 0) return;
      if (host::InterruptGuard::noted() || (options_.is_over && options_.is_over())) {
        tally_.interrupted = true;
        cancel(job);
        return;
      }
      const bool active = queue.active();
      // What was completed after we looked, and before the job ended, is seen by the next round.
      if (!active) return;
      std::this_thread::sleep_for(poll_period);
    }
  }

  void give_up(const std::vector<std::size_t>& positions) {
    Outcome outcome;
    outcome.failed = true;
    outcome.failure.message =
        "no task of Slurm completed the point: see the logs of its tasks in the folder 'slurm' of "
        "the sweep";
    outcome.date = std::time(nullptr);
    Shard shard(store_, manifest_, "slurm");
    for (const std::size_t position : positions) shard.add(manifest_.points[position], outcome);
  }

  const Store& store_;
  Shards shards_;
  const Manifest& manifest_;
  const SlurmOptions& options_;
  const RunPoint& run_;
  const OnProgress& progress_;
  std::ostream& err_;
  std::uint64_t total_ = 0;
  std::uint32_t largest_ = 0;
  std::uint32_t chunk_ = 0;
  std::string logs_;
  Tally tally_;
};

}  // namespace

Tally run_slurm(const Store& store, const Manifest& manifest,
                const std::vector<std::size_t>& positions, const SlurmOptions& options,
                const RunPoint& run, const OnProgress& progress, std::ostream& err) {
  return Cluster(store, manifest, options, run, progress, err).compute(positions);
}

void tell_warnings(const std::string& folder, std::ostream& err) {
  constexpr int most_told = 20;
  std::error_code ignored;
  std::set<fs::path> logs;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".log") logs.insert(entry.path());
  }
  int told = 0;
  for (const fs::path& log : logs) {
    std::ifstream lines(log);
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind(warning_mark, 0) != 0) continue;
      if (++told <= most_told) err << line << " (" << log.stem().string() << ")\n";
    }
  }
  if (told > most_told)
    err << warning_mark << told - most_told << " more in the logs in " << folder << "\n";
  err << std::flush;
}

int run_slurm_task(
    const Store& store, const SlurmTask& task,
    const std::function<void(const Manifest&, const std::vector<std::size_t>&)>& warm,
    const RunPoint& run, std::ostream& err) {
  const std::string file = task_file(submission_folder(store, task.submission), task.number);
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw vp::InputError("submission " + std::to_string(task.submission) + " has no task " +
                         std::to_string(task.number));
  const Manifest manifest = read_manifest(file);
  std::vector<std::size_t> positions(manifest.points.size());
  std::iota(positions.begin(), positions.end(), std::size_t{0});
  Shards shards(store);
  positions = missing(shards, manifest, positions);
  warm(manifest, positions);
  const LocalOptions options{1,  "slurm",          task.points_a_process, warns_on(err),
                             {}, task.keep_results};
  const Tally tally = run_local(store, manifest, positions, options, run, nullptr);
  return tally.interrupted ? host::interrupted : host::done;
}

}  // namespace platform::study
