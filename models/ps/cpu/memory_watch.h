#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace ps {

/// Notices that a loop without HAL call accesses some memory, by taking the access rights of its
/// pages away until then. Costs nothing while it watches nothing.
///
/// The fault goes through FaultTrap, so it works while a program runs. One in a process at a time.
class MemoryWatch {
 public:
  MemoryWatch() = default;
  ~MemoryWatch() { lift(); }
  MemoryWatch(const MemoryWatch&) = delete;
  MemoryWatch& operator=(const MemoryWatch&) = delete;

  /// Addresses [first, end), of memory that may be read and written.
  using Range = std::pair<std::uintptr_t, std::uintptr_t>;
  /// Watches these and nothing else, until one of their pages is accessed. Forgets touched().
  void watch(std::vector<Range> ranges);
  /// Watches nothing any more.
  void lift();
  /// The address that the loop accessed since watch().
  std::optional<std::uintptr_t> touched() const { return touched_; }

  /// A segmentation fault at `address`: true if it was for the watch only, and the access will
  /// succeed now. For the signal handler.
  static bool on_fault(std::uintptr_t address, bool by_loop);

 private:
  void protect(int access) const;

  std::vector<Range> pages_;
  bool watching_ = false;
  std::optional<std::uintptr_t> touched_;

  static MemoryWatch* active_;
};

}  // namespace ps
