#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <ps/cpu/code_charge.h>
#include <ps/cpu/line_guard.h>
#include <vp/fault_trap.h>
#include <vp/host_ticks.h>

struct backtrace_state;

namespace ps {

/// What the processor has to know of the program's own statements, which it does not see: whether
/// one runs at all, and for how long none has called the HAL. Written on every HAL call.
struct ProgramWatch : vp::ForeignCode {
  /// How often each basic block ran, by the address after its call of
  /// __sanitizer_cov_trace_pc(). Null: not counted. Set before the program starts.
  using BlockCounts = std::unordered_map<std::uintptr_t, std::uint64_t>;
  static BlockCounts* block_counts;
  /// The program looks at `stop` often, and ends by itself: it is not left where it is.
  static volatile bool ends_itself;
  /// Of the program that runs, while its code takes time; null: it takes none, or block_cycles.
  static CodeCharge* charge;
  /// Units of the charge that the program may use up between two looks at it.
  static constexpr std::int64_t charge_at_once = 1'024 * MachineCode::units_per_cycle;

  static void enter_hal() { runs = false; }
  static void leave_hal() {
    blocks_left = blocks_limit;
    if (charge) charge->left() = stop == Stop::none ? charge_at_once : 0;
    counted_ = 0;
    suspicions_ = 0;
    LineGuard::program_runs();
    runs = true;
  }
  /// The program's code is about to run; `blocks` without HAL call are a suspicion.
  static void start(std::uint64_t blocks) {
    ends_itself = false;
    counted_limit_ = blocks;
    ForeignCode::start(block_counts || charge ? 1 : blocks);
    leave_hal();
  }
  /// No program runs any more.
  static void end() { runs = false; }
  /// As ForeignCode's, for a program that is charged, too.
  static void ask_to_stop(Stop why) {
    ForeignCode::ask_to_stop(why);
    if (charge && runs) charge->left() = 0;
  }

  /// Basic blocks since the last call, or HAL call; units of the charge where there is one.
  static std::uint64_t take_blocks() {
    if (charge) {
      const std::int64_t units = charge_at_once - charge->left();
      charge->left() = charge_at_once;
      return static_cast<std::uint64_t>(units);
    }
    const std::uint64_t blocks = blocks_left < blocks_limit ? blocks_limit - blocks_left : 0;
    blocks_left = blocks_limit;
    return block_counts ? std::exchange(counted_, 0) : blocks;
  }
  /// Counts a block of the program, or charges for it. False: the processor is to look.
  static bool count_block(std::uintptr_t address);

  /// Suspicions since the last HAL call.
  static unsigned suspicions() { return suspicions_ & ~marked; }
  static void suspect_again(unsigned before) { suspicions_ = before + 1; }
  /// True if it was called before in the HAL call that runs. For a signal handler.
  static bool mark_call() {
    const bool again = (suspicions_ & marked) != 0;
    suspicions_ = suspicions_ | marked;
    return again;
  }

  /// The program's code runs in this scope, inside a HAL call: a handler, or a look at its memory.
  class ProgramCode {
   public:
    ProgramCode() {
      LineGuard::program_runs();
      runs = true;
    }
    ~ProgramCode() { runs = false; }
    ProgramCode(const ProgramCode&) = delete;
    ProgramCode& operator=(const ProgramCode&) = delete;
  };

 private:
  static constexpr unsigned marked = 1u << 31;
  static volatile unsigned suspicions_;
  static std::uint64_t counted_, counted_limit_;  ///< blocks, while they are counted
};

/// The program is in a loop without a statement: lets time pass.
void look_at_empty_loop();

/// How much host time a program's code may take without progress.
struct HostLimit {
  std::uint64_t ns = 0;  ///< processor time of the process, or time in which the program waits
  /// A value that changes with each progress; null: there is no progress.
  std::uint64_t (*progress)(const void* context) = nullptr;
  const void* context = nullptr;
};

/// Checks the running code of a program at intervals of host time.
///
/// It ends a program that takes host time without progress, whatever it calls: first by
/// ForeignCode::ask_to_stop(), which the next instrumented basic block obeys; code without
/// instrumentation (the C library) is left where a later tick interrupts it. Time inside one HAL
/// call is the simulator's, and does not count.
///
/// It also lets time pass in loops without a statement, `while (true);`. The compiler puts no call
/// of __sanitizer_cov_trace_pc() into them: their only basic block is the jump to itself, or to a
/// nop. The watch moves the program into a loop that makes the call. Since the jump leads nowhere
/// else, no result depends on when that happens. Only on x86-64.
class HostWatch : private vp::HostTicks::Listener {
 public:
  HostWatch() = default;
  ~HostWatch() { disarm(); }  // a simulation may end in the middle of the program
  HostWatch(const HostWatch&) = delete;
  HostWatch& operator=(const HostWatch&) = delete;

  /// Call before the program's code runs in a FaultTrap. A limit of 0 ns disables it.
  void arm(const HostLimit& limit);
  void disarm();

  /// The instruction there jumps to itself, or is one of a nop and the jump to it.
  static bool is_empty_loop(std::uintptr_t instruction);

 private:
  void on_host_tick(std::uint64_t spent_ns, void* context) override;
  void count(std::uint64_t spent_ns);

  HostLimit limit_;
  std::uint64_t spent_ns_ = 0;  ///< since the last progress
  std::uint64_t progress_ = 0;
  bool told_ = false;  ///< the program was to stop at the last tick
};

/// The program that contains an address of code: a shared object, as it is mapped.
class CodeLocator {
 public:
  /// `inside`: any address in the shared object, for instance of its description.
  explicit CodeLocator(const void* inside);

  bool contains(std::uintptr_t address) const;
  /// The offset in the file of `address`, which it must contain.
  std::uintptr_t place(std::uintptr_t address) const { return address - bias_; }
  /// "0x1a2b make(Mistake)+0x1c": the place in the file, as addr2line takes it, and the function
  /// around it. Only the place if the file was stripped. Looked up in the file once: a trace asks
  /// at each interrupt.
  const std::string& text(std::uintptr_t address) const;
  /// The function around `address`: "make(Mistake)"; empty if the file was stripped.
  std::string symbol(std::uintptr_t address) const;
  /// The functions that `address` lies in: those that were inlined there, the innermost first, then
  /// symbol(), or "0x1a2b" for none.
  std::vector<std::string> functions(std::uintptr_t address) const;
  /// "pc 0x1a2b make(Mistake)+0x1c (main.cpp:37), called from main (main.cpp:90)": the innermost of
  /// `calls` that lies in the program, and those of the program that led there. "…, in arm
  /// (main.cpp:12), called from make (…" where one was inlined. Without lines where it was built
  /// without debug information; empty if no call lies in it.
  std::string path(const std::vector<std::uintptr_t>& calls) const;
  /// How often each function was called that has code of its own, by its name, if so often the
  /// blocks ran: its first one runs in each call.
  std::map<std::string, std::uint64_t> calls(const ProgramWatch::BlockCounts& blocks) const;
  /// The file has debug information for `address`.
  bool knows_line(std::uintptr_t address) const { return !lines(address).empty(); }

 private:
  /// A line of the source, and the function that contains it.
  struct Line {
    std::string function, place;
  };
  std::string look_up(std::uintptr_t address) const;
  std::vector<Line> lines(std::uintptr_t address) const;

  std::string file_;
  mutable std::vector<char> content_;  ///< of the file, read on first use
  std::uintptr_t base_ = 0;            ///< of its first page; 0: nothing is known
  std::uintptr_t bias_ = 0;            ///< what the loader adds to the addresses of the file
  mutable std::map<std::uintptr_t, std::string> texts_;
  mutable backtrace_state* debug_ = nullptr;  ///< debug information of the process; never freed
};

/// Of the calls that are under way, the innermost first: addresses inside the calling instructions.
std::vector<std::uintptr_t> return_addresses();

}  // namespace ps
