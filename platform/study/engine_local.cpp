#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <deque>
#include <list>
#include <system_error>
#include <utility>

#include <host/process.h>
#include <study/engine.h>
#include <study/shard.h>
#include <study/worker.h>
#include <vp/file.h>

namespace platform::study {

namespace {

using HostClock = std::chrono::steady_clock;

/// A run that ends by itself always says why; a process that does not is tried once more.
constexpr int most_attempts = 2;
/// Processes that may end before they begin a point, one after another.
constexpr int most_useless = 5;
/// What a power failure may cost: finished points go to the disk together.
constexpr auto flush_period = std::chrono::seconds(10);

/// A run that is asked to end does so within a second; what has not by then is killed.
constexpr auto abandon_period = std::chrono::seconds(3);

/// To be woken for every point costs as much as to note it.
constexpr int listen_period_ms = 20;

/// From here on the process keeps memory that it frees, for what it allocates next: point after
/// point builds and destroys the same objects, and each page would be mapped anew.
void keep_freed_memory() {
  constexpr int most_pieces = 32 << 20, most_free = 256 << 20, step = 1 << 20;  // bytes
  ::mallopt(M_MMAP_THRESHOLD, most_pieces);
  ::mallopt(M_TRIM_THRESHOLD, most_free);
  ::mallopt(M_TOP_PAD, step);
}

/// A pipe into which nothing is written: its end tells that a process ended.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "no pipe for a sweep's process");
  }
  ~Pipe() {
    close_writing();
    ::close(ends_[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reading() const { return ends_[0]; }
  void close_writing() {
    if (ends_[1] >= 0) ::close(std::exchange(ends_[1], -1));
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

/// The processes, and what they are at.
class Pool {
 public:
  Pool(const Store& store, const Manifest& manifest, const std::vector<std::size_t>& positions,
       const LocalOptions& options, const RunPoint& run, const OnProgress& progress)
      : list_{store, manifest, positions, run, options},
        options_(options),
        progress_(progress),
        queue_(positions.size(), options.jobs),
        attempts_(positions.size(), 1),
        shard_(store, manifest, options.name) {
    for (std::uint32_t slot = options.jobs; slot-- > 0;) free_slots_.push_back(slot);
  }

  Tally run() {
    for (;;) {
      if (host::InterruptGuard::noted()) stop();
      if (options_.is_over && !abandoned_at_ && options_.is_over()) abandon();
      while (running_.size() < options_.jobs && has_work()) start();
      if (running_.empty() && !find_lost()) break;
      if (running_.empty()) continue;
      listen();
      if (abandoned_at_ && HostClock::now() - *abandoned_at_ > abandon_period) kill_all();
      if (HostClock::now() - flushed_ > flush_period) flush();
    }
    flush();
    show();
    tally_.computed = queue_.finished();
    return tally_;
  }

 private:
  struct Running {
    std::uint32_t slot;
    std::optional<std::size_t> only;  ///< the item that it was started for
    Pipe pipe;
    std::optional<host::Child> child;
  };

  void stop() {
    tally_.interrupted = true;
    queue_.stop();
    again_.clear();
  }

  /// Asks the processes to break off what they are at.
  void abandon() {
    abandoned_at_ = HostClock::now();
    stop();
    for (const Running& running : running_) ::kill(running.child->pid(), SIGTERM);
  }

  void kill_all() {
    for (Running& running : running_) ::kill(running.child->pid(), SIGKILL);
  }

  bool has_work() const { return !tally_.interrupted && (!again_.empty() || !queue_.empty()); }

  void start() {
    Running& running = running_.emplace_back();
    running.slot = free_slots_.back();
    free_slots_.pop_back();
    if (!again_.empty()) {
      running.only = again_.front();
      again_.pop_front();
    }
    running.child.emplace([&](std::ostream&, std::ostream& err) {
      list_.store.leave_lock_to_parent();
      keep_freed_memory();
      // What PS programs print is of no use here.
      const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
      if (nowhere >= 0) ::dup2(nowhere, STDOUT_FILENO);
      PointWorker worker(list_, queue_, running.slot);
      return running.only ? worker.work_on(*running.only, attempts_[*running.only], err)
                          : worker.work(options_.points_a_process, err);
    });
    running.pipe.close_writing();
  }

  /// Sleeps a while, or until a process ends or a signal comes, and sees what was done.
  void listen() {
    std::vector<pollfd> pipes;
    for (const Running& running : running_) pipes.push_back({running.pipe.reading(), 0, 0});
    const bool waited = ::poll(pipes.data(), pipes.size(), listen_period_ms) >= 0;
    show();
    if (!waited) return;
    auto pipe = pipes.begin();
    for (auto running = running_.begin(); running != running_.end(); ++pipe) {
      const auto next = std::next(running);
      // What a PS program starts may hold its pipe open.
      if ((pipe->revents & POLLHUP) != 0 || running->child->ended()) {
        ended(*running);
        running_.erase(running);
      }
      running = next;
    }
  }

  void show() {
    if (progress_ && queue_.finished() != shown_) progress_(shown_ = queue_.finished());
  }

  /// A process that was killed, or ended itself, loses the point that it was at.
  void ended(Running& running) {
    const host::ChildEnd end = running.child->wait();
    free_slots_.push_back(running.slot);
    if (queue_.told() == WorkQueue::Stop::no_host && end.exit_code != host::done)
      throw vp::HostError(last_line(end.err));
    if (queue_.told() == WorkQueue::Stop::interrupted) stop();
    if (std::exchange(before_, queue_.finished()) != queue_.finished()) useless_ = 0;
    std::optional<std::size_t> item = queue_.held(running.slot);
    if (!item) item = running.only;
    queue_.release(running.slot);
    if (item && !queue_.is_finished(*item)) {
      if (tally_.interrupted) {
        ++tally_.abandoned;
        return;
      }
      const Failure failure = failure_of(end);
      tell_of_death(*item, failure);
      again_or_failed(*item, failure);
    } else if (end.exit_code != host::done && ++useless_ == most_useless) {
      throw std::runtime_error("the processes of the sweep end before they begin: " +
                               failure_of(end).message);
    }
  }

  void tell_of_death(std::size_t item, const Failure& failure) const {
    if (!options_.warn) return;
    const std::string& key = list_.manifest.points[list_.positions[item]].key;
    std::string text = failure.message + ", at point " + key + ": ";
    text += attempts_[item] < most_attempts
                ? "it is computed once more, and nothing else is lost"
                : "for the second time, so the point has failed ('--retry-failed' tries it again)";
    if (failure.signal == SIGKILL) text += "; if memory was short, take fewer processes (--jobs)";
    options_.warn(text);
  }

  void again_or_failed(std::size_t item, const Failure& failure) {
    if (attempts_[item] < most_attempts) {
      ++attempts_[item];
      again_.push_back(item);
      return;
    }
    Outcome outcome;
    outcome.failed = true;
    outcome.failure = failure;
    outcome.date = std::time(nullptr);
    outcome.attempt = attempts_[item];
    shard_.add(list_.manifest.points[list_.positions[item]], outcome);
    queue_.finish(item);
    useless_ = 0;
  }

  /// Points that a process took and lost before it said so. False: there are none.
  bool find_lost() {
    if (tally_.interrupted) return false;
    for (std::size_t item = 0; item < list_.positions.size(); ++item) {
      if (!queue_.is_finished(item)) again_.push_back(item);
    }
    return !again_.empty();
  }

  static Failure failure_of(const host::ChildEnd& end) {
    if (end.signal != 0) {
      return {-1, end.signal,
              std::string("the process was ended by a signal: ") + ::strsignal(end.signal)};
    }
    const std::string said = last_line(end.err);
    return {end.exit_code, 0, said.empty() ? "the process ended without a result" : said};
  }

  void flush() {
    flushed_ = HostClock::now();
    if (queue_.finished() != in_flush_) list_.store.flush();
    in_flush_ = queue_.finished();
  }

  PointList list_;
  const LocalOptions& options_;
  const OnProgress& progress_;
  WorkQueue queue_;
  std::vector<int> attempts_;  ///< by item
  Shard shard_;                ///< of points that no process finishes
  std::deque<std::size_t> again_;
  std::vector<std::uint32_t> free_slots_;
  std::list<Running> running_;
  std::uint64_t shown_ = 0;   ///< finished points that were told
  std::uint64_t before_ = 0;  ///< finished when the last process ended
  int useless_ = 0;
  HostClock::time_point flushed_ = HostClock::now();
  std::optional<HostClock::time_point> abandoned_at_;
  std::uint64_t in_flush_ = 0;  ///< points finished when it was
  Tally tally_;
};

}  // namespace

Tally run_local(const Store& store, const Manifest& manifest,
                const std::vector<std::size_t>& positions, const LocalOptions& options,
                const RunPoint& run, const OnProgress& progress) {
  return Pool(store, manifest, positions, options, run, progress).run();
}

}  // namespace platform::study
