#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <deque>
#include <list>
#include <system_error>
#include <utility>

#include <host/process.h>
#include <study/engine.h>
#include <study/run_log.h>
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

/// A pipe whose ends are closed with it. Reading does not wait.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0 || ::fcntl(ends_[0], F_SETFL, O_NONBLOCK) != 0)
      throw std::system_error(errno, std::generic_category(), "no pipe for a sweep's process");
  }
  ~Pipe() {
    close_writing();
    close_reading();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reading() const { return ends_[0]; }
  int writing() const { return ends_[1]; }
  void close_writing() { close(ends_[1]); }
  void close_reading() { close(ends_[0]); }

 private:
  static void close(int& end) {
    if (end >= 0) ::close(std::exchange(end, -1));
  }

  std::array<int, 2> ends_{-1, -1};
};

/// The processes, and what they are at.
class Pool {
 public:
  Pool(const Store& store, const Manifest& manifest, const std::vector<std::size_t>& positions,
       const LocalOptions& options, const RunPoint& run, const OnProgress& progress)
      : list_{store, manifest, positions, run},
        options_(options),
        progress_(progress),
        queue_(positions.size(), options.jobs),
        told_(positions.size()),
        attempts_(positions.size(), 1),
        log_(store, options.name) {
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
    return tally_;
  }

 private:
  struct Running {
    std::uint32_t slot;
    std::optional<std::size_t> only;  ///< the item that it was started for
    Pipe pipe;
    MessageReader reader;
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
    running.reader = MessageReader(names_);
    running.slot = free_slots_.back();
    free_slots_.pop_back();
    if (!again_.empty()) {
      running.only = again_.front();
      again_.pop_front();
    }
    running.child.emplace([&](std::ostream&, std::ostream&) {
      list_.store.leave_lock_to_parent();
      // Else a process whose parent was killed waits for ever in the middle of a message.
      for (Running& other : running_) other.pipe.close_reading();
      // What PS programs print is of no use here.
      const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
      if (nowhere >= 0) ::dup2(nowhere, STDOUT_FILENO);
      PointWorker worker(list_, queue_, running.slot, running.pipe.writing());
      running.only ? worker.work_on(*running.only) : worker.work(options_.points_a_process);
      return host::done;
    });
    running.pipe.close_writing();
  }

  /// Sleeps a while, or until a process ends or a signal comes, and takes what they told.
  void listen() {
    std::vector<pollfd> pipes;
    for (const Running& running : running_) pipes.push_back({running.pipe.reading(), 0, 0});
    if (::poll(pipes.data(), pipes.size(), listen_period_ms) < 0) return;
    for (auto running = running_.begin(); running != running_.end();) {
      const auto next = std::next(running);
      if (!read(*running)) {
        ended(*running);
        running_.erase(running);
      }
      running = next;
    }
  }

  /// What the process told. False: there is nothing more to come.
  bool read(Running& running) {
    std::array<char, 1 << 16> block;
    ssize_t size = 0;
    while ((size = ::read(running.pipe.reading(), block.data(), block.size())) > 0) {
      running.reader.add({block.data(), static_cast<std::size_t>(size)});
      while (const std::optional<PointMessage> message = running.reader.next()) take(*message);
    }
    return size < 0 && (errno == EINTR || errno == EAGAIN);
  }

  void take(const PointMessage& message) {
    switch (message.kind) {
      case PointMessage::Kind::no_host:
        throw vp::HostError(message.failure.message);
      case PointMessage::Kind::interrupted:
        ++tally_.abandoned;
        stop();
        break;
      case PointMessage::Kind::fault:
        again_or_failed(message.item, message.failure);
        break;
      case PointMessage::Kind::there:
        // Of a process of ours, which was killed before it could say so.
        if (attempts_[message.item] > 1) ++tally_.computed;
        step(message.item);
        break;
      case PointMessage::Kind::computed:
        done(message);
        break;
    }
    useless_ = 0;
  }

  void done(const PointMessage& message) {
    const std::size_t position = list_.positions[message.item];
    log_.add(list_.manifest.points[position].key, message.wall_s, message.cpu_s,
             attempts_[message.item], message);
    names_ = message.metrics;
    ++tally_.computed;
    step(message.item);
  }

  void step(std::size_t item) {
    told_[item] = true;
    ++done_;
    if (progress_) progress_(done_);
  }

  /// A process that was killed, or ended itself, loses the point that it was at.
  void ended(Running& running) {
    const host::ChildEnd end = running.child->wait();
    free_slots_.push_back(running.slot);
    std::optional<std::size_t> item = queue_.held(running.slot);
    if (!item) item = running.only;
    queue_.release(running.slot);
    if (item && !told_[*item]) {
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
    const PlannedPoint& point = list_.manifest.points[list_.positions[item]];
    const PointRecord record = failed_record(list_.manifest, point, failure);
    list_.store.write(record);
    PointMessage message;
    message.item = item;
    message.failed = true;
    message.failure = failure;
    done(message);
  }

  /// Points that a process took and lost before it said so. False: there are none.
  bool find_lost() {
    if (tally_.interrupted) return false;
    for (std::size_t item = 0; item < told_.size(); ++item) {
      if (!told_[item]) again_.push_back(item);
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
    if (tally_.computed != in_flush_) list_.store.flush();
    in_flush_ = tally_.computed;
  }

  PointList list_;
  const LocalOptions& options_;
  const OnProgress& progress_;
  WorkQueue queue_;
  std::vector<bool> told_;     ///< by item: nothing more to do
  std::vector<int> attempts_;  ///< by item
  RunLog log_;
  std::deque<std::size_t> again_;
  std::vector<std::uint32_t> free_slots_;
  std::list<Running> running_;
  result::Metrics names_;  ///< for the next to share
  std::uint64_t done_ = 0;
  int useless_ = 0;
  HostClock::time_point flushed_ = HostClock::now();
  std::optional<HostClock::time_point> abandoned_at_;
  std::uint64_t in_flush_ = 0;  ///< points computed when it was
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
  return Pool(store, manifest, positions, options, run, progress).run();
}

}  // namespace platform::study
