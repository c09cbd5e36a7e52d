#pragma once

#include <atomic>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include <result/metrics.h>
#include <study/engine.h>
#include <study/shard.h>

namespace platform::study {

/// Which of a list's items is whose, and which are finished, in memory that a process shares with
/// those that it forks. They take the next item as soon as they can: no process waits while there
/// is work.
class WorkQueue {
 public:
  /// For items 0 … `items` - 1, and workers in `slots` slots. Throws std::system_error.
  WorkQueue(std::size_t items, std::uint32_t slots);
  ~WorkQueue();
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;

  /// The next item, which the slot holds from here on; none: there are no more.
  std::optional<std::size_t> take(std::uint32_t slot);
  /// The slot holds this item.
  void hold(std::uint32_t slot, std::size_t item) { slots_[slot] = item + 1; }
  void release(std::uint32_t slot) { slots_[slot] = 0; }
  std::optional<std::size_t> held(std::uint32_t slot) const;

  /// The item is finished: what came of it is in the store.
  void finish(std::size_t item);
  bool is_finished(std::size_t item) const { return finished_[item]; }
  std::uint64_t finished() const { return shared_->finished; }

  bool empty() const { return shared_->next >= items_; }

  /// Asks the workers to end after the item that they hold.
  void stop() { shared_->stopped = true; }
  bool stopped() const { return shared_->stopped; }

  /// Why a worker ended before its item was finished: a signal interrupted it, or the machine
  /// failed, not the item.
  enum class Stop : std::uint8_t { none, interrupted, no_host };
  void tell(Stop stop) { shared_->told = stop; }
  Stop told() const { return shared_->told; }

 private:
  struct Shared {
    std::atomic<std::uint64_t> next{0};
    std::atomic<std::uint64_t> finished{0};
    std::atomic<bool> stopped{false};
    std::atomic<Stop> told{Stop::none};
  };
  using Slot = std::atomic<std::uint64_t>;  ///< 0: none; else item + 1
  using Flag = std::atomic<bool>;
  static_assert(Slot::is_always_lock_free && Flag::is_always_lock_free,
                "else processes cannot share it");

  std::size_t items_;
  std::size_t bytes_;
  Shared* shared_;
  Slot* slots_;
  Flag* finished_;  ///< by item
};

/// The list of points that a sweep's processes work on.
struct PointList {
  const Store& store;
  const Manifest& manifest;
  const std::vector<std::size_t>& positions;  ///< in the manifest, by item
  const RunPoint& run;
  const LocalOptions& options;
};

/// Computes points in a process of its own, and adds what came of them to a shard of its own.
class PointWorker {
 public:
  PointWorker(const PointList& list, WorkQueue& queue, std::uint32_t slot);

  /// Computes at most so many points. Returns the exit code of the process, and says on `err` why
  /// it ends if that is not host::done. Throws vp::HostError if the machine failed, not the point.
  int work(std::uint32_t most, std::ostream& err);
  /// Computes one that was taken from the queue before.
  int work_on(std::size_t item, int attempt, std::ostream& err);

 private:
  /// How the process is after a point: as it was before, or as a run that ended badly left it.
  enum class Left { clean, unclean, fault };

  Left complete(std::size_t item, int attempt, std::ostream& err);
  /// The exit code of the run. Throws vp::HostError if the machine failed, not the run.
  int run(const Point& point, RunResult& result, std::ostream& said) const;
  void finish(const Point& point, Outcome& outcome, RunResult& found);

  const PointList& list_;
  WorkQueue& queue_;
  std::uint32_t slot_;
  result::MetricsReader metrics_;
  Shard shard_;
};

/// What `markervp run` said last, without its name.
std::string last_line(const std::string& text);

}  // namespace platform::study
