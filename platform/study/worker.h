#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <result/metrics.h>
#include <study/engine.h>
#include <study/point.h>

namespace platform::study {

/// Which of a list's items is whose, in memory that a process shares with those that it forks. They
/// take the next item as soon as they can: no process waits while there is work.
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
  void hold(std::uint32_t slot, std::size_t item) { slots()[slot] = item + 1; }
  /// The slot's item is done, and the parent knows.
  void release(std::uint32_t slot) { slots()[slot] = 0; }
  std::optional<std::size_t> held(std::uint32_t slot) const;

  bool empty() const { return shared_->next >= items_; }

  /// Asks the workers to end after the item that they hold.
  void stop() { shared_->stopped = true; }
  bool stopped() const { return shared_->stopped; }

 private:
  struct Shared {
    std::atomic<std::uint64_t> next{0};
    std::atomic<bool> stopped{false};
  };
  using Slot = std::atomic<std::uint64_t>;  ///< 0: none; else item + 1
  static_assert(Slot::is_always_lock_free, "else processes cannot share it");

  Slot* slots() const { return reinterpret_cast<Slot*>(shared_ + 1); }

  std::size_t items_;
  std::size_t bytes_;
  Shared* shared_;
};

/// What a process that computes points tells of one of them.
struct PointMessage : Outcome {
  enum class Kind : std::uint8_t {
    computed,     ///< its file is written
    there,        ///< its file was there: another process's, or an earlier attempt's
    interrupted,  ///< by a signal to the process
    fault,        ///< of the program itself: `failure` says which
    no_host       ///< the machine failed, not the point: the failure's message says why
  };
  Kind kind = Kind::computed;
  std::uint64_t item = 0;  ///< of the engine's list
  double wall_s = 0;
  double cpu_s = 0;  ///< of the run itself
};

/// Names go over the pipe when they differ from those of the message before.
class MessageWriter {
 public:
  /// The message as bytes for MessageReader.
  std::string bytes(const PointMessage& message);

 private:
  result::Metrics before_;
};

/// Puts messages together again that arrive in pieces.
class MessageReader {
 public:
  /// Metrics share the names of `known`, if they are the same.
  explicit MessageReader(result::Metrics known = {}) : known_(std::move(known)) {}

  void add(std::string_view bytes) { waiting_ += bytes; }
  /// The next whole message.
  std::optional<PointMessage> next();

 private:
  std::string waiting_;
  result::Metrics known_;
  result::Metrics before_;
};

/// The list of points that a sweep's processes work on.
struct PointList {
  const Store& store;
  const Manifest& manifest;
  const std::vector<std::size_t>& positions;  ///< in the manifest, by item
  const RunPoint& run;
};

/// Computes points in a process of its own: writes their files and tells of them.
class PointWorker {
 public:
  /// Tells into the pipe `pipe`.
  PointWorker(const PointList& list, WorkQueue& queue, std::uint32_t slot, int pipe);

  /// Computes at most so many points.
  void work(std::uint32_t most);
  /// Computes one that was taken from the queue before.
  void work_on(std::size_t item);

 private:
  /// Whether the process is as it was before.
  bool complete(std::size_t item);
  PointMessage compute(std::size_t item);
  /// The exit code of the run. Throws vp::HostError if the machine failed, not the run.
  int run(const PlannedPoint& point, PointResult& result, std::ostream& said) const;
  void compute_claimed(const PlannedPoint& point, PointMessage& message);
  void finish(const PointRecord& record, PointMessage& message);
  void tell(const PointMessage& message);

  const PointList& list_;
  WorkQueue& queue_;
  std::uint32_t slot_;
  int pipe_;
  result::MetricsReader metrics_;
  MessageWriter writer_;
  bool clean_ = true;  ///< no run ended badly
};

/// What `markervp run` said last, without its name.
std::string last_line(const std::string& text);

}  // namespace platform::study
