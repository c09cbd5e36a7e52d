#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <list>
#include <sstream>
#include <utility>

#include <cli/interrupt.h>
#include <cli/program.h>
#include <cli/run_child.h>
#include <sweep/durable_file.h>
#include <sweep/engine.h>
#include <sweep/run_log.h>
#include <sweep/scratch.h>

namespace platform::sweep {

namespace {

namespace fs = std::filesystem;
using HostClock = std::chrono::steady_clock;

/// Exit codes of a child, beside those of the program.
constexpr int storage_failed = 74;  // EX_IOERR of sysexits.h

/// A process that ends by itself always says why; one that does not is tried once more.
constexpr int most_attempts = 2;

/// What `markervp run` said last.
std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const std::size_t start = text.rfind('\n', end);
  std::string line = text.substr(start == std::string::npos ? 0 : start + 1,
                                 end - (start == std::string::npos ? 0 : start + 1) + 1);
  const std::string name = "markervp: ";
  return line.rfind(name, 0) == 0 ? line.substr(name.size()) : line;
}

double cpu_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Json read_result(const std::string& folder) {
  std::ifstream file(fs::path(folder) / "result.json", std::ios::binary);
  return Json::parse(std::string{std::istreambuf_iterator<char>(file), {}});
}

/// What the last frame warns of first, as the end of a message.
std::string last_warning(const Json& result) {
  const Json frames = result.value("frames", Json::array());
  if (frames.empty() || !frames.back().contains("warnings")) return "";
  return ": " + frames.back()["warnings"].at(0).get<std::string>();
}

/// The values that the platform had, if they are not those that the point is named after.
std::string difference(const std::map<std::string, std::string>& planned, const Json& result) {
  const auto actual = result.at("configuration").get<std::map<std::string, std::string>>();
  for (const auto& [path, value] : actual) {
    const auto found = planned.find(path);
    if (found == planned.end() || found->second != value) return path;
  }
  return actual.size() == planned.size() ? "" : "a parameter is missing";
}

/// The child: runs the point and writes its file. Returns the exit code.
int compute(const Store& store, const Manifest& manifest, const PlannedPoint& point,
            const std::string& folder, const RunPoint& run, std::ostream& out, std::ostream& err) {
  const double start = cpu_seconds();
  const PointRun asked = run_of(manifest, point);
  std::ostringstream said;
  const int code = cli::exit_code_of([&] { return run(asked, folder, said); }, said);
  // On a line of its own: the PS program may print, too.
  out << "\n" << cpu_seconds() - start;
  const std::string message = last_line(said.str());
  if (code == cli::interrupted) return code;
  if (code != cli::done && is_storage_problem(message)) throw StorageError(message);
  if (code == cli::run_failed) {
    // The program ended by itself: what it found until then says why.
    const Json result = read_result(folder);
    store.write(failed_record(manifest, point, {code, 0, message + last_warning(result)}, result));
    return cli::done;
  }
  if (code != cli::done) {
    store.write(failed_record(manifest, point, {code, 0, message}));
    return cli::done;
  }
  Json result = read_result(folder);
  const std::string changed = difference(manifest.configuration(point), result);
  if (!changed.empty()) {
    err << "the platform was built with another value than planned: " << changed;
    return cli::run_failed;
  }
  store.write(done_record(manifest, point, std::move(result)));
  return cli::done;
}

/// The pool of processes.
class Pool {
 public:
  Pool(const Store& store, const Manifest& manifest, const LocalOptions& options,
       const RunPoint& run, const OnProgress& progress)
      : store_(store),
        manifest_(manifest),
        options_(options),
        run_(run),
        progress_(progress),
        log_(store, options.name),
        scratch_(options.jobs) {}

  Tally run(const std::vector<std::size_t>& positions) {
    for (const std::size_t position : positions) waiting_.push_back({position, 1});
    while (!waiting_.empty() || !running_.empty()) {
      if (cli::InterruptGuard::interrupted()) {
        tally_.interrupted = true;
        waiting_.clear();
      }
      while (!waiting_.empty() && running_.size() < options_.jobs) start();
      if (running_.empty()) break;
      wait_for_one();
      collect();
    }
    return tally_;
  }

 private:
  struct Wanted {
    std::size_t position;
    int attempt;
  };

  struct Running {
    Running(const Pool& pool, Wanted asked, FileLock&& lock, std::string scratch)
        : wanted(asked),
          claim(std::move(lock)),
          folder(std::move(scratch)),
          begin(HostClock::now()),
          child([this, &pool](std::ostream& out, std::ostream& err) {
            return pool.compute_in_child(*this, out, err);
          }) {}

    Wanted wanted;
    FileLock claim;
    std::string folder;  ///< of its own
    HostClock::time_point begin;
    cli::RunChild child;
  };

  int compute_in_child(const Running& running, std::ostream& out, std::ostream& err) const {
    try {
      return compute(store_, manifest_, manifest_.points[running.wanted.position], running.folder,
                     run_, out, err);
    } catch (const StorageError& error) {
      err << error.what();
      return storage_failed;
    }
  }

  void start() {
    const Wanted wanted = waiting_.front();
    waiting_.pop_front();
    const PlannedPoint& point = manifest_.points[wanted.position];
    FileLock claim = store_.claim(point.key);
    if (store_.has(point.key)) return step();
    running_.emplace_back(*this, wanted, std::move(claim), scratch_.take());
  }

  /// Sleeps until a child ends, or a signal comes.
  static void wait_for_one() {
    siginfo_t info{};
    ::waitid(P_ALL, 0, &info, WEXITED | WNOWAIT);
  }

  void collect() {
    for (auto running = running_.begin(); running != running_.end();) {
      if (!running->child.ended()) {
        ++running;
        continue;
      }
      const cli::ChildEnd end = running->child.wait();
      scratch_.give_back(running->folder);
      finish(*running, end);
      running = running_.erase(running);
    }
  }

  void finish(const Running& running, const cli::ChildEnd& end) {
    const PlannedPoint& point = manifest_.points[running.wanted.position];
    const double wall = std::chrono::duration<double>(HostClock::now() - running.begin).count();
    if (end.exit_code == storage_failed) throw StorageError(last_line(end.err));
    if (end.exit_code == cli::interrupted) {
      tally_.interrupted = true;
      waiting_.clear();
      return;
    }
    if (end.exit_code != cli::done) {
      if (running.wanted.attempt < most_attempts && !tally_.interrupted) {
        waiting_.push_back({running.wanted.position, running.wanted.attempt + 1});
        return;
      }
      store_.write(failed_record(manifest_, point, failure_of(end)));
    }
    const double cpu = std::strtod(end.out.substr(end.out.rfind('\n') + 1).c_str(), nullptr);
    log_.add(point.key, wall, cpu, running.wanted.attempt);
    ++tally_.computed;
    step();
  }

  static Failure failure_of(const cli::ChildEnd& end) {
    if (end.signal != 0) {
      return {-1, end.signal,
              std::string("the process was ended by a signal: ") + ::strsignal(end.signal)};
    }
    return {end.exit_code, 0, last_line(end.err)};
  }

  void step() {
    ++done_;
    if (progress_) progress_(done_);
  }

  const Store& store_;
  const Manifest& manifest_;
  const LocalOptions& options_;
  const RunPoint& run_;
  const OnProgress& progress_;
  RunLog log_;
  Scratch scratch_;
  std::deque<Wanted> waiting_;
  std::list<Running> running_;
  std::uint64_t done_ = 0;
  Tally tally_;
};

}  // namespace

PointRun run_of(const Manifest& manifest, const PlannedPoint& point) {
  return {manifest.families[point.family].program, manifest.input_sets[point.input_set].inputs,
          manifest.settings(point), manifest.input};
}

Tally run_local(const Store& store, const Manifest& manifest,
                const std::vector<std::size_t>& positions, const LocalOptions& options,
                const RunPoint& run, const OnProgress& progress) {
  return Pool(store, manifest, options, run, progress).run(positions);
}

}  // namespace platform::sweep
