// The program's own code: how it is called, what it does without the HAL, and how it fails.
#include <ps/cpu/cpu.h>
#include <vp/report.h>
#include <vp/unit.h>
#include <algorithm>

namespace ps {

namespace {

/// The first jump of time for a loop without HAL call; each further one is twice as long.
constexpr std::uint64_t first_jump_ps = 10'000;
constexpr unsigned most_doublings = 40;
/// 10 us: it may wait for what the other core writes.
constexpr unsigned most_beside_other = 10;
/// Handlers in a row after which an interrupt is taken to be unacknowledged (decision).
constexpr unsigned many_handlers = 1'000;
constexpr std::uint64_t ps_per_ns = 1'000;
/// Where basic blocks take time, that of so many passes at once (decision): the longest that an
/// interrupt waits for a loop.
constexpr std::uint64_t blocks_at_once = 64;

}  // namespace

volatile unsigned ProgramWatch::suspicions_ = 0;
ProgramWatch::BlockCounts* ProgramWatch::block_counts = nullptr;
std::uint64_t ProgramWatch::counted_ = 0, ProgramWatch::counted_limit_ = ~std::uint64_t{0};

int Cpu::call_program() {
  struct Call {
    void (*boot)(void);
    int (*program)(void);
    void (*entry)(void);
    int result;
  } call{program_->boot(), program_->description().entry, entry_, 0};
  // The first core's looks after both.
  const HostLimit limit{number_ == 0 ? settings_.host_timeout / ps_per_ns : 0, &Cpu::progress,
                        this};
  ProgramWatch::start(settings_.block_cycles == 0 ? settings_.loop_blocks.get() : blocks_at_once);
  watch_.arm(limit);
  const vp::Fault* fault = trap_.call(
      [](void* context) {
        Call& call = *static_cast<Call*>(context);
        if (call.entry) {
          call.entry();
        } else {
          if (call.boot) call.boot();
          call.result = call.program();
        }
      },
      &call);
  watch_.disarm();
  spend_blocks();
  ProgramWatch::end();
  if (number_ == 0) LineGuard::program_is_over();
  if (fault) report(*fault);
  if (in_handler_now_)
    break_off("the interrupt handler never returned: do not leave it by longjmp()");
  return call.result;
}

// The program is over: what it did ahead of time passes, but no handler runs any more.
void Cpu::break_off(const std::string& problem) {
  ProgramWatch::end();
  masked_ = true;
  misuse(problem);
}

// Simulated time and inputs. In a signal handler: what is read may be half a step ahead.
std::uint64_t Cpu::progress(const void* cpu) {
  const Cpu& self = *static_cast<const Cpu*>(cpu);
  return self.now_ps() + self.frame;
}

void Cpu::interrupt_program() {
  if (!running_) return;
  ProgramWatch::ask_to_stop(ProgramWatch::Stop::interrupted);
  sc_core::sc_pause();
}

void Cpu::report(const vp::Fault& fault) {
  using vp::Fault;
  if (fault.kind == Fault::Kind::interrupted) stop(nullptr);
  std::string text = fault.text();
  if (fault.kind == Fault::Kind::exit) {
    text += ": return from its entry function instead";
  } else if (fault.kind == Fault::Kind::forbidden) {
    text += ", which would end or double the whole platform: leave it out";
  } else if (fault.kind == Fault::Kind::host_time) {
    text += ", for " + vp::format_time(settings_.host_timeout) + " now (" +
            settings_.host_timeout.name() +
            "): access a register, wait for an interrupt, or count work";
  } else if (fault.stack_overflow) {
    text += ": its " + std::to_string(settings_.stack_size / 1024) + " KiB are used up (" +
            settings_.stack_size.name() + ")";
  } else if (fault.address_known && fault.address <= ~std::uint32_t{0}) {
    const std::string device = device_at(static_cast<std::uint32_t>(fault.address));
    if (!device.empty()) {
      text += device +
              ", a device address: dereference no pointer to it, use hal_read32() and "
              "hal_write32()";
    }
  }
  if (code_) {
    fault_calls_.assign(fault.frames,
                        fault.frames + std::min(fault.frame_count, Fault::most_frames));
  }
  break_off(text);
}

void Cpu::call_handler() {
  std::string thrown;
  try {
    const ProgramWatch::ProgramCode code;
    handler_(handler_context_);
    return;
  } catch (const sc_core::sc_unwind_exception&) {
    throw;
  } catch (const std::exception& error) {
    thrown = std::string(": ") + error.what();
  } catch (...) {
  }
  fail("the interrupt handler threw an exception" + thrown);
}

void Cpu::check_acknowledged() {
  if (!interrupt_pending()) {
    unacknowledged_ = 0;
    return;
  }
  if (++unacknowledged_ == 1) first_unacknowledged_ps_ = now_ps();
  if (unacknowledged_ != many_handlers) return;
  const Request request = describe_request_ ? describe_request_() : Request{};
  const std::string which = request.text.empty() ? "" : " (" + request.text + ")";
  const std::string so_often = std::to_string(many_handlers) + " times in a row";
  if (request.since_ps <= first_unacknowledged_ps_) {
    vp::warn(*this, "/markervp/cpu/not_acknowledged",
             "the interrupt handler has returned " + so_often + " with an interrupt still pending" +
                 which + ": acknowledge it at the device, and end it at the interrupt controller");
  } else {
    vp::warn(*this, "/markervp/cpu/overrun",
             "interrupts come faster than they are handled: the handler has returned " + so_often +
                 ", since " + vp::format_time(first_unacknowledged_ps_) +
                 ", with the next one pending" + which +
                 ": let them come more rarely, or do less in the handler");
  }
}

// A bad pointer is the program's fault, not that of who reads it for the program: the fault trap
// tells of it, no sanitizer does.
__attribute__((no_sanitize("address", "undefined"))) void Cpu::look_at(const void* data,
                                                                       std::size_t size) const {
  constexpr std::size_t page = 4096;
  const ProgramWatch::ProgramCode code;
  const auto* bytes = static_cast<const volatile char*>(data);
  for (std::size_t i = 0; i < size; i += page) static_cast<void>(bytes[i]);
  if (size != 0) static_cast<void>(bytes[size - 1]);
}

// An interrupt ends the jump: the program may have waited for what its handler does. Where blocks
// take time, no jump is needed.
void Cpu::notice_loop(unsigned before) {
  const std::uint64_t taken = interrupts;
  catch_up();
  if (interrupts == taken && settings_.block_cycles == 0) {
    loop_jumps_ = true;
    pass(first_jump_ps << std::min(before, beside_other() ? most_beside_other : most_doublings));
    loop_jumps_ = false;
    catch_up();
  }
}

std::optional<std::string> Cpu::place() const {
  const auto process = sc_core::sc_get_current_process_handle();
  if (running_ && dynamic_cast<const Cpu*>(process.get_parent_object()) == nullptr) return {};
  return program_counter();
}

std::string Cpu::program_counter() const {
  if (locate_program_) return locate_program_();
  if (!code_ || !running_) return {};
  return code_->path(fault_calls_.empty() ? return_addresses() : fault_calls_);
}

}  // namespace ps
