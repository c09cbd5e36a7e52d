#pragma once

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>

#include <ps/memory/memory.h>

namespace ps {

/// Detects reads of guarded cache lines by the program, at the reading instruction.
///
/// The pages of guarded lines lose their access rights, so accesses fault: a read of a guarded line
/// is reported, a write removes the guard of its line. For an access to the rest of such a page,
/// the page is opened for that one instruction (the processor's trap flag, x86-64), or a plain load
/// is executed in its place (read_from()). This takes some 20 or 5 us, so it is done at most
/// `steps` times in a run. A program that needs more releases buffers in parts: ranges guarded
/// together with such a page are no longer guarded from then on.
///
/// Lines may be watched instead: their reads are offered before the guard's, again and again as
/// long as the listener likes. They have fewer steps, a quarter in a run and 8 for each page, after
/// which the page's lines are no longer watched; what is guarded there stays so.
///
/// Code other than the program must use another view of the memory, or remove the guard of the
/// page. Faults come through vp::FaultTrap, so this works while a program runs. One per process at
/// a time.
class LineGuard {
 public:
  static constexpr std::uintptr_t line = DmaAllocator::cache_line;

  /// Called for a read at `address`, before the program executes the instruction.
  using Listener = std::function<void(std::uintptr_t address)>;
  /// Called for a read of a watched line by `instruction`. True: the line stays watched.
  using Watcher = std::function<bool(std::uintptr_t address, std::uintptr_t instruction)>;

  /// For memory in [first, end), whole pages. Guards nothing with 0 steps, nor under a debugger,
  /// which would stop at each fault, nor where pages have not 4096 bytes.
  LineGuard(std::uintptr_t first, std::uintptr_t end, unsigned steps, Listener listener);
  ~LineGuard();
  LineGuard(const LineGuard&) = delete;
  LineGuard& operator=(const LineGuard&) = delete;

  /// Where the memory's bytes may be read that the program must not see: from here on loads beside
  /// guarded lines need no step.
  void read_from(const unsigned char* second_view) { second_view_ = second_view; }
  /// All lines of [address, address + bytes), which begins in the memory, once the program runs
  /// again.
  void guard(std::uintptr_t address, std::size_t bytes);
  void release(std::uintptr_t address, std::size_t bytes);
  /// The same for watched lines, whose reads `watcher` gets. Set it before the first.
  void on_watched(Watcher watcher) { watcher_ = std::move(watcher); }
  void watch(std::uintptr_t address, std::size_t bytes);
  void forget(std::uintptr_t address, std::size_t bytes);
  /// Never guards pages in [first, end): code, or a stack on which the simulator works, too.
  void exclude(std::uintptr_t first, std::uintptr_t end);
  /// Guards nothing any more, now and later.
  void stop();

  /// A segmentation fault at `address`: true if it was for the guard only, and the instruction is
  /// to be tried again. For the signal handler; `context` is a ucontext_t.
  static bool on_fault(std::uintptr_t address, void* context);
  /// The program is about to run.
  static void program_runs() {
    if (pending_) active_->close();
  }
  /// No program runs any more that could fault.
  static void program_is_over();

 private:
  static constexpr std::uintptr_t page = 4096;
  static constexpr unsigned lines_per_page = page / line;
  static constexpr unsigned bits = 64;
  struct Lines {
    std::array<std::uint64_t, lines_per_page / bits> words;

    bool empty() const { return (words[0] | words[1]) == 0; }
    bool has(unsigned number) const { return (words[number / bits] >> number % bits & 1) != 0; }
    /// Lines [from, to).
    void set(unsigned from, unsigned to, bool value);
  };
  struct Page {
    Lines guarded, watched;
    std::uint32_t closed;  ///< in which go; 0: it is open
    bool left_alone;
    unsigned char watch_steps;  ///< that were made because of watched lines only

    bool empty() const { return guarded.empty() && watched.empty(); }
  };

  /// Pages that a device writes one after the other, closed up to `closed_to`.
  struct Range {
    std::uint32_t closing;
    std::size_t closed_to, to;
  };

  template <class Action>
  void for_each_page(std::uintptr_t address, std::size_t bytes, Action action);
  void add(Lines Page::*kind, std::uintptr_t address, std::size_t bytes);
  void remove(Lines Page::*kind, std::uintptr_t address, std::size_t bytes);
  void offer(Page& page, unsigned number, std::uintptr_t address, const void* context);
  bool may_step(Page& page);
  bool fault(std::uintptr_t address, void* context);
  void step(std::uintptr_t address, bool for_watched, void* context);
  void end_step(void* context);
  void close();
  void open(std::size_t number);
  void leave_alone_all_closed_with(std::size_t number);
  void allow(std::size_t from, std::size_t to, bool access) const;
  static void on_trap(int signal, siginfo_t* info, void* context);

  std::uintptr_t first_;
  std::uintptr_t end_;
  const unsigned char* second_view_ = nullptr;
  Listener listener_;
  Watcher watcher_;
  bool stopped_ = false;
  unsigned steps_left_, watch_steps_left_;
  SparseArray<Page> pages_;
  // Pages that were ever guarded lie in [used_from_, used_): most of the memory never is.
  std::size_t used_from_ = SIZE_MAX, used_ = 0;
  std::uint32_t closings_ = 0;
  std::deque<Range> ranges_;  ///< that were guarded last: those of the devices that write
  /// Pages opened for the program's current instruction, which may access that many.
  std::array<std::size_t, 4> stepping_{};
  std::size_t stepping_count_ = 0;
  bool trap_is_set_ = false;
  struct sigaction old_trap_ {};

  static LineGuard* active_;
  static bool pending_;  ///< the active one has pages to close
};

}  // namespace ps
