#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <systemc>
#include <type_traits>
#include <utility>
#include <vector>

#include <hal/hal.h>
#include <ps/cpu/console.h>
#include <ps/cpu/cores.h>
#include <ps/cpu/cpu_settings.h>
#include <ps/cpu/cpu_time.h>
#include <ps/cpu/deadline.h>
#include <ps/cpu/irq.h>
#include <ps/cpu/pointer_access.h>
#include <ps/cpu/poll.h>
#include <ps/cpu/program.h>
#include <ps/cpu/program_watch.h>
#include <ps/cpu/surroundings.h>
#include <ps/cpu/test_bench.h>
#include <ps/cpu/wait_signs.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/counter.h>
#include <vp/error.h>
#include <vp/mm_link.h>
#include <vp/probe.h>
#include <vp/register_route.h>
#include <vp/signal.h>

namespace ps {

class DmaAllocator;

/// A core without instruction set: one thread that runs a program natively and gives it the HAL.
///
/// The program's own statements take no time; the work it counts does, through the cost table, and
/// so do HAL calls. The processor may be ahead of the simulation, but catches up before each
/// register access, barrier, cache operation, interrupt check, and call of the test bench. An
/// interrupt that comes while it catches up runs its handler at exactly that time, and the work
/// continues afterwards. So no result depends on how far ahead it may be (`quantum`).
///
/// When something ends the run early (a bus error, a mistake of the program, the time-out), the
/// program is frozen where it is: its stack is never unwound, no destructor runs and no exception
/// passes through its code, as on a chip that hangs in an abort handler. The simulation continues
/// without it, or pauses. A fault of the program (segmentation fault, abort, …) acts alike.
///
/// A second core runs a function of the same program once the first has started it. When both act
/// at the same simulated time, the first one acts first, unless the second one woke it then. While
/// the second is awake, neither runs ahead of the simulation. A program's own accesses to memory
/// happen up to 10 us before the time of its work, whatever `quantum` is; those through the HAL
/// (locks, words, events) happen at their time. The run ends with the first core's program.
class Cpu : public sc_core::sc_module, public vp::SignalListener, private vp::ClockListener {
 public:
  Cpu(sc_core::sc_module_name name, vp::Clock& clock);
  /// The second core, beside `first`, whose settings and program it shares.
  Cpu(sc_core::sc_module_name name, vp::Clock& clock, Cpu& first);
  ~Cpu() override;
  const char* kind() const override { return "ps::Cpu"; }

  vp::MmLink m_axi{"m_axi"};    ///< bind m_axi.socket to the interconnect
  vp::In<bool> n_irq{"n_irq"};  ///< from the interrupt controller, active low; may stay unbound
  vp::Signal<std::uint32_t> function{
      "function"};  ///< annotated function that runs, its number + 1; 0 none
  vp::Signal<bool> in_handler{"in_handler"};     ///< from interrupt entry to exit
  vp::Signal<bool> asleep{"asleep"};             ///< waits for an interrupt or an event
  vp::Signal<std::uint32_t> frame{"frame"};      ///< inputs that the program took
  vp::Signal<std::uint32_t> results{"results"};  ///< results that it delivered
  // For traces: names of the annotated function, and of the handler while it runs.
  vp::TextSignal function_name{"function_name", [this] { return name_of_function(); }, {&function}};
  vp::TextSignal handler_name{"handler_name", [this] { return name_of_handler(); }, {&in_handler}};

  /// Of all cores.
  const CpuSettings& settings() const { return settings_; }

  vp::Counter interrupts{"interrupts", "interrupts taken"};
  vp::Counter polls{"polls", "reads made by hal_poll_until_changed"};
  vp::Counter barriers{"barriers", "barriers and cache operations"};
  vp::Counter cache_lines{"cache_lines", "cache lines flushed or invalidated"};

  /// 0: the first core.
  unsigned number() const { return number_; }

  // The processor's environment: set it at the first core before the simulation starts. Whatever is
  // passed must outlive the core.
  /// Throws vp::InputError if `costs` lacks a unit of work of the program.
  void load(Program& program, const CostTable& costs);
  void connect(TestBench& bench) { bench_ = &bench; }
  void connect(DmaAllocator& dma_memory) { dma_memory_ = &dma_memory; }
  /// The program's stack in the DDR ends at this address, the second core's below it. For programs
  /// that lie there; others run on the thread's.
  void end_stack_at(std::uintptr_t end) { stack_end_ = end; }
  std::uintptr_t stack_end() const { return stack_end_; }
  /// First byte and one past the last of the stack in the DDR; {0, 0}: it is elsewhere.
  std::pair<std::uintptr_t, std::uintptr_t> stack() const;
  /// What messages name. Set it before the simulation starts.
  Surroundings surroundings;
  enum class CacheCall {
    flush,
    invalidate,
    flush_all,
    invalidate_all,
    disable,
    enable,
    uncache,  ///< accesses to this memory are not cached from now on
    cache,
  };
  /// Called after each cache operation of the program, on either core. May be null.
  using CacheListener = std::function<void(CacheCall, std::uintptr_t address, std::size_t bytes)>;
  void on_cache_call(CacheListener listener) { cache_listener_ = std::move(listener); }
  /// Points in the program's course at which a profiler samples it, on the program's stack.
  enum class Moment {
    call_over,       ///< a call of the HAL is over, or the program is
    handler_begins,  ///< an interrupt was taken: what follows is the handler's
    handler_over,
  };
  /// One per core. May be null.
  using MomentListener = std::function<void(Moment)>;
  void on_moment(MomentListener listener) { moment_listener_ = std::move(listener); }
  /// Calls `look` once, on the program's stack, when the simulation reaches `ps`: in the HAL call
  /// in which that time passes. No time or result depends on it. Set before the simulation starts.
  void call_at(std::uint64_t ps, std::function<void()> look) {
    deadline_.want_look(ps, std::move(look));
  }
  /// Replaces the processor's own program_counter(), for a program that only represents one that
  /// runs elsewhere.
  void locate_program(std::function<std::string()> locate) { locate_program_ = std::move(locate); }
  /// Called with the reason when the program is stopped, as check() throws it, while its call stack
  /// still exists: in a signal handler if it is a fault. May be null.
  using FailureListener = std::function<void(const std::string& problem)>;
  void on_failure(FailureListener listener);
  /// When everything that the program has done so far will be over, in ps: its own time, which may
  /// be ahead of the simulation. In a handler, the time of the handler.
  std::uint64_t program_time_ps() const { return reached_ps() + local_time_.ps_after(0); }
  /// The loaded program's code; null if it is part of the process.
  const CodeLocator* code() const { return code_ ? &*code_ : nullptr; }
  /// Where the program is, as messages end: ", at 320 ns in function 'f' of program 'p', pc …".
  std::string where() const;
  /// Reads the lines of the program's source now: copies of this process need not.
  void read_lines() const;
  /// "pc …" as CodeLocator::path() has it, while the program or a HAL call of it is under way;
  /// otherwise empty.
  std::string program_counter() const;
  /// The same; nullopt if called by something that happens while the program waits, rather than by
  /// the program.
  std::optional<std::string> place() const;
  /// Ends the program because of a mistake, once its earlier work is over. In guarded() only.
  [[noreturn]] void misuse(const std::string& problem);
  /// False: polls make every read. Default: those that cannot see anything new only take their
  /// time, and are counted like the others.
  void set_poll_elision(bool elide) { poll_elision_ = elide; }
  /// False: the simulation continues when the program has ended. Default: it pauses (sc_pause).
  void set_pause_at_end(bool pause) { pause_at_end_ = pause; }
  Console console;

  enum class State { waiting, running, finished, failed };
  State state() const { return state_; }
  /// The user wants an end: the program stops where it is, and the simulation pauses, soon. May be
  /// called in a signal handler, also when no program runs.
  static void interrupt_program();
  static bool interrupted() { return ProgramWatch::stop == ProgramWatch::Stop::interrupted; }
  /// What the entry function returned; 0 unless finished.
  int exit_code() const { return exit_code_; }
  /// When the program ended, in ps; 0 before.
  std::uint64_t end_ps() const { return end_ps_; }
  /// The program has finished because it looped to its time limit, in a function that cannot
  /// return: its end by design, as on the chip.
  bool reached_limit() const { return reached_limit_; }
  /// When its main() returned, in ps, if interrupts or the other core had work after that.
  std::optional<std::uint64_t> main_end_ps() const {
    return works_after_main_ || reached_limit_ ? main_end_ps_ : std::nullopt;
  }
  /// An event at `ps` only ends what takes too long: a program whose main() has returned does not
  /// wait for it, nor for what comes later.
  void give_up_at(std::uint64_t ps) { give_up_ps_ = ps; }
  /// Throws what ended the program: vp::ProtocolError, or what a model or the test bench threw.
  /// Nothing if it finished or was interrupted. A program that neither ended nor can go on is
  /// vp::ProtocolError too: call it after the simulation.
  void check() const;
  /// Notified when the program ends, however.
  const sc_core::sc_event& ended() const { return ended_; }

  /// The work that it counted, and its code.
  const WorkMeter& work() const { return work_; }
  /// Reads among `polls` that were not made, for performance reports.
  std::uint64_t skipped_polls() const { return skipped_polls_; }
  const Activity& activity() const { return activity_; }
  /// Software on this core raised an interrupt: the handler sees what was done before.
  void software_interrupt_raised();
  const std::string& cost_profile() const { return cost_profile_; }

  /// The processor whose program runs, for the HAL. Throws vp::ProtocolError if none does.
  static Cpu& running(const char* call) {
    if (!running_) nothing_runs(call);
    return *running_;
  }
  /// Runs a HAL call. An exception in it ends the run, without passing the program's frames.
  template <class Call>
  auto guarded(Call call);

  // The HAL, see <hal/hal.h>.
  std::uint32_t read32(std::uint32_t address);
  void write32(std::uint32_t address, std::uint32_t value);
  hal_poll_result poll_until_changed(std::uint32_t address, std::uint32_t previous,
                                     std::uint32_t cycles, std::uint32_t limit);
  void barrier();
  void maintain_cache(CacheCall call, const void* data, std::size_t size);
  void maintain_all(hal_cache_whole operation);
  void set_cached(const void* data, std::size_t size, bool cached);
  hal_dma_buffer allocate_dma(std::size_t size, std::size_t alignment);
  void connect_interrupt(hal_interrupt_handler handler, void* context);
  bool enable_interrupt(bool enable);
  void after_interrupt(void (*hook)(void)) { after_interrupt_ = hook; }
  void wait_for_interrupt();
  void write_console(const char* text, std::size_t length);
  void warn(const char* text);
  const hal_frame* next_frame();
  void publish(std::uint32_t kind, const void* data, std::size_t size);
  double option(std::uint32_t option);
  std::string_view option_data(std::uint32_t option);
  std::uint32_t xparameter(const char* name, std::uint32_t built_in);
  void do_work(std::uint32_t item, std::uint64_t count);
  void enter_function(std::uint32_t number);
  void leave_function();

  // The HAL between two cores: cores.cpp
  void start_core(unsigned number, void (*entry)(void));
  void wait_for_event();
  void send_event();
  std::uint32_t load_acquire(const volatile std::uint32_t* word);
  void store_release(volatile std::uint32_t* word, std::uint32_t value);
  std::uint32_t load_exclusive(const volatile std::uint32_t* word);
  bool store_exclusive(volatile std::uint32_t* word, std::uint32_t value);
  void acquire(hal_lock& lock);
  void release(hal_lock& lock);
  void access_shared(bool write, const volatile void* data, std::size_t size);

  // What a program does without the HAL: cpu_program.cpp
  /// It ran `loop_blocks` basic blocks without HAL call or annotation, or what it may at once where
  /// its code takes time, `before` times already: lets time pass, and interrupts come. `is_empty`:
  /// a loop without a statement.
  void notice_loop(unsigned before, bool is_empty);
  /// Makes the access of an instruction that reads or writes a device's register by a pointer.
  void access_by_pointer(PointerAccess& access);

 private:
  enum class Interrupts { take, leave };
  /// Reads of a poll that were not made, and the one that is on its way.
  struct Skipped {
    std::uint64_t reads = 0;
    std::uint64_t until_ps = 0;  ///< that one left then; otherwise now
    vp::RegisterRoute* route = nullptr;
    std::optional<vp::RegisterRoute::Access> on_its_way;
  };

  Cpu(sc_core::sc_module_name name, vp::Clock& clock, Cpu* first);
  void end_of_elaboration() override;
  std::string name_of_function() const;
  std::string name_of_handler() const;
  void check_memory() const;
  void call_program();
  void go_on();
  void take_turn();
  [[noreturn]] void report(const vp::Fault& fault);
  void call_handler();
  void check_acknowledged();
  void look_at(const void* data, std::size_t size) const;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void run();

  // Polls: cpu_poll.cpp
  Skipped skip_reads(std::uint32_t address, std::uint32_t previous, std::uint32_t cycles,
                     std::uint32_t limit);
  void go_on_between(std::uint64_t end_ps, std::uint64_t leave_ps);
  void before_change(vp::Clock& clock) override;
  void after_change(vp::Clock&) override {}

  // Time: cpu_catch_up.cpp; interrupts: cpu_interrupt.cpp
  std::uint64_t now_ps() const { return scheduler_.now_ps(); }
  static std::uint64_t progress(const void* cpu);
  static bool irq_is_low(const void* cpu);
  /// When what was done so far will be over.
  std::uint64_t reached_ps() const {
    return std::max(now_ps(), access_end_ps_) + (irq_.in_handler() ? 0 : timeline_.total_ps());
  }
  void spend_cycles(std::uint64_t cycles);
  void spend_blocks();
  void spend_timed_blocks();
  void start_charging();
  bool code_takes_time() const {
    return settings_.block_cycles != 0 || ProgramWatch::charge != nullptr;
  }
  std::uint64_t take_work();
  void work_for(std::uint64_t ps);
  [[gnu::noinline]] std::uint64_t pass_busy(std::uint64_t start_ps, std::uint64_t end_ps);
  void close_segment();
  /// Work that is over before anything else is to be looked at: `work_ps` of it, from `start_ps`,
  /// the present, or from the end of the last access.
  struct Stretch {
    std::uint64_t start_ps, work_ps, end_ps;
  };
  bool take_stretch(Stretch& stretch);
  std::uint64_t pass_stretch(const Stretch& stretch);
  std::uint64_t catch_up();
  [[gnu::noinline]] std::uint64_t catch_up_slowly();
  [[gnu::noinline]] std::uint64_t pass_work(std::uint64_t start_ps, std::uint64_t work_ps);
  void settle();
  void check_open_functions();
  bool play(Interrupts interrupts);
  std::uint64_t pass(std::uint64_t ps);
  void entered(std::uint32_t number, std::uint64_t now_ps);
  void left(std::uint64_t now_ps);
  void end_access();
  void follow_clock();
  void start_ahead();
  bool far_ahead();
  bool interrupt_pending() const { return n_irq.bound() && !n_irq.read(); }
  bool interrupt_due() const { return irq_.interruptible() && interrupt_pending(); }
  void take_interrupts() {
    while (interrupt_due()) run_handler();
  }
  void run_handler();
  void leave_interrupt();
  bool lives_after_main() const;
  void stay_after_main();
  void tell_cache(CacheCall call, const void* data, std::size_t size) const;
  static bool on_fault(std::uintptr_t address, void* context);
  bool reaches_by_pointer(std::uintptr_t address) const;
  static void make_access(PointerAccess& access);
  std::uint32_t access_part(bool read, std::uint32_t address, unsigned bytes, std::uint32_t value);
  void sleep();
  void sleep_until(std::uint64_t ps);
  void doze(std::uint64_t until_ps, vp::ClockScheduler::Condition condition);

  // Two cores: cores.cpp
  void leave_boot_code(unsigned number, void (*entry)(void));
  void start_by_word();
  void await_start();
  void sleep_for_good();
  bool beside_other() const;
  bool has_woken() const { return event_ || interrupt_due(); }
  bool is_deaf() const;
  void doze_until_event();
  void check_deadlock();
  std::string doing() const;
  std::string doing_elsewhere() const;
  void check_word(const char* call, const volatile std::uint32_t* word);
  void put(volatile std::uint32_t* word, std::uint32_t value);
  void handler_begins();

  std::uint32_t access(bool read, std::uint32_t address, std::uint32_t value);
  bool access_quietly(const Stretch& stretch, bool read, std::uint32_t address,
                      std::uint32_t& value);
  /// An access that left at `start_ps`. `transfer` brings it to the device and gives the answer.
  template <class Transfer>
  void on_bus(std::uint64_t start_ps, bool read, std::uint32_t address, Transfer transfer);
  void transport(bool read, std::uint32_t address, std::uint32_t& value);
  [[noreturn]] void refuse(tlm::tlm_response_status status, bool read, std::uint32_t address);
  [[noreturn]] void stop(std::exception_ptr error);
  [[noreturn]] void fail(const std::string& problem);
  [[noreturn]] static void nothing_runs(const char* call);
  void meet_deadline(const char* what, const std::string& hint = {});
  MachineCode::Reach reach() const;
  [[noreturn]] void end_at_limit(const std::string& hint, bool sleeps);
  [[noreturn]] void rest();
  std::string signs_of_waiting() const {
    return signs_.text(surroundings, irq_.masked_by_program());
  }
  [[noreturn]] void break_off(const std::string& problem);
  void end(State state);
  void freeze();

  std::unique_ptr<CpuSettings> own_settings_;  ///< of the first core
  const CpuSettings& settings_;
  std::shared_ptr<Cores> cores_;
  const unsigned number_;
  vp::Clock& clock_;
  vp::ClockScheduler& scheduler_;
  Program* program_ = nullptr;
  TestBench* bench_ = nullptr;
  DmaAllocator* dma_memory_ = nullptr;
  std::function<std::string()> locate_program_;
  std::string cost_profile_;
  CacheListener cache_listener_;
  MomentListener moment_listener_;
  FailureListener failure_listener_;
  bool pause_at_end_ = true;
  bool poll_elision_ = true;

  State state_ = State::waiting;
  int exit_code_ = 0;
  std::uint64_t end_ps_ = 0;
  bool reached_limit_ = false;
  std::optional<std::uint64_t> main_end_ps_;
  std::uint64_t give_up_ps_ = vp::Clock::never;
  std::optional<std::uint64_t> over_ps_;  ///< the end, where nothing was left to do after main()
  bool works_after_main_ = false;
  std::exception_ptr error_;
  sc_core::sc_event ended_, never_;

  WorkMeter work_;
  double code_scale_ = 1;  ///< by the cost table
  std::uintptr_t stack_end_ = 0;
  std::size_t open_functions_ = 0;  ///< entered by the program, ahead of time
  std::size_t open_before_handler_ = 0;
  Activity activity_;

  std::uint64_t hertz_ = 0;
  LocalTime local_time_;
  std::uint64_t access_end_ps_ = 0;   ///< of the last bus access: an interrupt waits for it
  Timeline timeline_;                 ///< what the program does after it
  LocalTime::Wide ahead_fs_ = 0;      ///< work counted since the last settling, rounded up
  std::uint64_t ahead_limit_fs_ = 0;  ///< 0: not looked at yet
  Deadline deadline_;
  std::uint64_t dozes_since_ps_ = 0;
  bool slept_unmasked_ = false;

  Irq irq_;
  void (*after_interrupt_)(void) = nullptr;
  bool caches_off_ = false;      ///< of the first core: for both
  bool warned_of_long_ = false;  ///< an access of 8 bytes by a pointer to a register

  void (*entry_)(void) = nullptr;  ///< of the second core
  sc_core::sc_event start_;
  bool both_started_ = false;
  bool event_ = false, awaits_event_ = false;  ///< the event register; it is in WFE
  const hal_lock* awaited_lock_ = nullptr;
  ExclusiveMonitor monitor_;

  vp::RegisterRoutes routes_{m_axi};
  PollSkip* skip_ = nullptr;  ///< while it runs
  std::uint64_t skipped_polls_ = 0;
  tlm::tlm_generic_payload payload_;
  unsigned char data_[4] = {};
  WaitSigns signs_;

  vp::FaultTrap trap_;
  HostWatch watch_;
  std::optional<CodeLocator> code_;          ///< of a plug-in
  std::vector<std::uintptr_t> fault_calls_;  ///< under way in the fault that ended it

  static Cpu* running_;
};

template <class Transfer>
[[gnu::always_inline]] inline void Cpu::on_bus(std::uint64_t start_ps, bool read,
                                               std::uint32_t address, Transfer transfer) {
  vp::RegisterRoute::Answer answer;
  try {
    answer = transfer();
  } catch (const vp::ProtocolError& error) {
    throw vp::ProtocolError(error.what() + where());
  }
  activity_.busy(now_ps() - start_ps);
  if (answer.status != tlm::TLM_OK_RESPONSE) refuse(answer.status, read, address);
  access_end_ps_ = answer.ps;
}

// What the program did since its last call, where its basic blocks take time.
inline void Cpu::spend_blocks() {
  if (code_takes_time()) spend_timed_blocks();
}

// Resumes the program's code after a call in which the other core's may have run.
inline void Cpu::go_on() {
  if (running_ != this) take_turn();
  ProgramWatch::leave_hal();
}

template <class Call>
auto Cpu::guarded(Call call) {
  ProgramWatch::enter_hal();
  spend_blocks();
  try {
    if constexpr (std::is_void_v<decltype(call())>) {
      call();
      if (moment_listener_) moment_listener_(Moment::call_over);
      go_on();
      return;
    } else {
      auto result = call();
      if (moment_listener_) moment_listener_(Moment::call_over);
      go_on();
      return result;
    }
  } catch (const sc_core::sc_unwind_exception&) {
    throw;  // the process is being killed
  } catch (...) {
    error_ = std::current_exception();
  }
  stop(error_);
}

}  // namespace ps
