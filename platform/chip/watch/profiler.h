#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <chip/system/zynq.h>
#include <ps/cpu/cpu.h>

namespace platform {

/// Where the program's time goes, by the functions under way at each call of the HAL; and how long
/// interrupts wait.
///
/// All time of a program passes in such calls, so nothing is sampled: each picosecond has its
/// place, and the same run gives the same profile. Costs some microseconds of the host's time a
/// call, while it lives.
class Profiler {
 public:
  explicit Profiler(Zynq& zynq);
  ~Profiler();
  Profiler(const Profiler&) = delete;
  Profiler& operator=(const Profiler&) = delete;

  /// What a function did itself, without those that it called.
  struct Cost {
    std::uint64_t calls = 0;       ///< of the HAL, by it
    std::uint64_t work_ps = 0;     ///< instructions of the work that it counted
    std::uint64_t stall_ps = 0;    ///< memory stalls of that work
    std::uint64_t waiting_ps = 0;  ///< for registers, barriers, caches; entry and exit of handlers
    std::uint64_t asleep_ps = 0;
    double cycles = 0;  ///< of the core, while it was awake

    std::uint64_t awake_ps() const { return work_ps + stall_ps + waiting_ps; }
  };
  /// A function, as called by another one.
  struct Function {
    std::string name;
    std::size_t caller;  ///< index; the first one, the whole program, is its own
    Cost self;
  };
  /// Callers stand before those that they call; in the order of their first call. What the second
  /// core does is called by "cpu1", which the program calls: its time comes on top.
  const std::vector<Function>& functions() const { return functions_; }

  /// How long an interrupt waited: from when its line rose, or software raised it, to the first
  /// statement of the handler.
  struct Latency {
    static constexpr std::size_t buckets = 40;
    std::uint64_t count = 0;
    std::uint64_t total_ps = 0;
    std::uint64_t worst_ps = 0;
    std::uint64_t worst_at_ps = 0;                ///< when that handler began
    std::array<std::uint64_t, buckets> counts{};  ///< [n]: of 2^n ns up to 2^(n+1) ns; [0]: less
  };
  /// By the number of the interrupt.
  const std::map<std::uint32_t, Latency>& latencies() const { return latencies_; }
  /// How often each function of the program was called that has code of its own: was not inlined,
  /// and comes from sources of markervp_add_program().
  std::map<std::string, std::uint64_t> calls() const;
  /// In interrupt handlers, entry and exit included.
  std::uint64_t handler_ps() const { return handler_ps_; }

  // `nj_per_cycle`: what a core takes for a cycle awake.
  /// For https://www.speedscope.app: time, cycles, energy and calls, one profile each.
  std::string speedscope(double nj_per_cycle) const;
  /// For the page: {"functions": [[name, caller, calls, work us, stalls us, waiting us, asleep us,
  /// cycles, uJ]…], "calls": {name: calls…}, "named": [[name, calls, self us, total us]…],
  /// "handlers": us, "interrupts": [{"name", "count", "mean", "worst", "worst_at": us, "counts":
  /// […]}]}.
  std::string page_json(double nj_per_cycle);

 private:
  /// The program's course up to a moment.
  struct Mark {
    std::uint64_t time_ps = 0;
    std::uint64_t idle_ps = 0;
    ps::WorkMeter::Counted counted;
  };
  /// What a core is at.
  struct Course {
    ps::Cpu& cpu;
    const ps::Gic& gic;
    std::size_t root;  ///< function
    Mark last;         ///< all before is assigned
    Mark interrupted;  ///< `last` of what the handler interrupted
    Mark handler_began;
    bool in_handler = false;
    std::size_t depth_below = 0;  ///< addresses on the stack of what the handler interrupted
  };
  static Mark mark(const Course& course);
  void at(Course& course, ps::Cpu::Moment moment);
  void assign(Course& course, std::size_t function);
  void begin_handler(Course& course);
  void end_handler(Course& course);
  void note_latency(const Course& course);
  std::size_t under_way(const Course& course);
  std::size_t called(std::size_t caller, const std::string& name);
  const std::vector<std::string>& names(std::uintptr_t address);

  static constexpr std::size_t program = 0;

  Zynq& zynq_;
  std::vector<Function> functions_;
  std::map<std::pair<std::size_t, std::string>, std::size_t> index_;  ///< by caller and name
  std::unordered_map<std::uintptr_t, std::vector<std::string>>
      names_;  ///< empty: not the program's
  std::map<std::uint32_t, Latency> latencies_;
  std::uint64_t handler_ps_ = 0;
  std::deque<Course> courses_;
  ps::ProgramWatch::BlockCounts blocks_;
};

}  // namespace platform
