#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

namespace platform::sweep {

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

}  // namespace platform::sweep
