// The program's own code: how it is called, what it does without the HAL, and how it fails.
#include <ps/cpu/cpu.h>
#include <sys/mman.h>
#include <vp/error.h>
#include <vp/report.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <algorithm>
#include <cmath>
#include <cstring>

namespace ps {

namespace {

/// The first jump of time for a loop without HAL call; each further one is twice as long.
constexpr std::uint64_t first_jump_ps = 10'000;
constexpr unsigned most_doublings = 40;
/// 10 us: it may wait for what the other core writes.
constexpr unsigned most_beside_other = 10;
constexpr std::uint64_t ps_per_ns = 1'000;
/// UG585 table 4-1: on-chip memory below the DDR, and all that is no memory above it. What is near
/// address 0 is a pointer that was never set.
constexpr std::uintptr_t null_end = 0x1000, low_end = 0x4'0000, first_register = 0x4000'0000;
/// Where basic blocks take time, that of so many passes at once (decision): the longest that an
/// interrupt waits for a loop.
constexpr std::uint64_t blocks_at_once = 64;

/// As the vendor's boot code calls main(), with argc 0 and argv NULL. Entries without parameters
/// do not look at them.
int call_entry(int (*entry)(void)) {
  using Main = int (*)(int, char**);
  return reinterpret_cast<Main>(reinterpret_cast<void (*)(void)>(entry))(0, nullptr);
}

}  // namespace

volatile unsigned ProgramWatch::suspicions_ = 0;
volatile bool ProgramWatch::ends_itself = false;
ProgramWatch::BlockCounts* ProgramWatch::block_counts = nullptr;
CodeCharge* ProgramWatch::charge = nullptr;
std::uint64_t ProgramWatch::counted_ = 0, ProgramWatch::counted_limit_ = ~std::uint64_t{0};

void Cpu::call_program() {
  struct Call {
    void (*boot)(void);
    int (*program)(void);
    void (*entry)(void);
    Cpu& cpu;
  } call{program_->boot(), program_->description().entry, entry_, *this};
  // The first core's looks after both.
  const HostLimit limit{number_ == 0 ? settings_.host_timeout / ps_per_ns : 0, &Cpu::progress,
                        this};
  start_charging();
  ProgramWatch::start(settings_.block_cycles == 0 ? settings_.loop_blocks.get() : blocks_at_once);
  watch_.arm(limit);
  vp::FaultTrap::on_access = &Cpu::on_fault;
  const vp::Fault* fault = trap_.call(
      [](void* context) {
        Call& call = *static_cast<Call*>(context);
        if (call.entry) {
          call.entry();
        } else {
          if (call.boot) call.boot();
          call.cpu.exit_code_ = call_entry(call.program);
          call.cpu.stay_after_main();
        }
      },
      &call);
  watch_.disarm();
  spend_blocks();
  ProgramWatch::end();
  if (number_ == 0) LineGuard::program_is_over();
  if (fault) report(*fault);
  if (irq_.in_handler())
    break_off("the interrupt handler never returned: do not leave it by longjmp()");
}

// A second core runs the code of the first one's program.
void Cpu::start_charging() {
  CodeCharge* const charge = program_->charge();
  const double scale = settings_.code_scale * code_scale_;
  const bool by_code = charge && settings_.block_cycles == 0 && scale > 0;
  work_.set_code_cycles(by_code ? scale / MachineCode::units_per_cycle
                                : settings_.block_cycles.get());
  ProgramWatch::charge = by_code ? charge : nullptr;
  if (charge) charge->start(by_code && !ProgramWatch::block_counts);
  if (const auto [first, end] = stack(); first != 0) {
    constexpr std::size_t page = 4096;
    mprotect(reinterpret_cast<void*>(first), page, PROT_NONE);
    // A program that writes beyond its frames does not leave the memory at once.
    trap_.use_stack(first, end - first - vp::FaultTrap::gap);
  }
}

std::pair<std::uintptr_t, std::uintptr_t> Cpu::stack() const {
  const std::uintptr_t end = cores_->all.front()->stack_end_;
  if (end == 0 || !program_ || program_->end() == 0 || program_->is_sanitized()) return {0, 0};
  const std::uintptr_t top = end - number_ * settings_.stack_size;
  return {top - settings_.stack_size, top};
}

// Program, heap and stacks lie one behind the other in the DDR.
void Cpu::check_memory() const {
  const std::uint64_t wanted = cores_->all.size() * settings_.stack_size;
  if (program_->end() == 0 || stack_end_ == 0 || program_->end() + wanted <= stack_end_) return;
  throw vp::InputError(
      "program '" + std::string(program_->name()) + "' ends at " + vp::hex(program_->end() - 1) +
      ", and its stack would begin before that: " + "it ends at " + vp::hex(stack_end_ - 1) +
      ", with " + std::to_string(wanted / 1024) + " KiB (" + settings_.stack_size.name() +
      "): make the program's variables or the stack smaller");
}

// The program is over: what it did ahead of time passes, but no handler runs any more.
void Cpu::break_off(const std::string& problem) {
  ProgramWatch::end();
  irq_.mask(true);
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
  } else if (fault.address_known && fault.address >= low_end && fault.address < program_->end()) {
    text +=
        ", where the program itself lies, and none of its variables: if it is to write there, put "
        "it "
        "elsewhere (target_link_options(… LINKER:-Ttext-segment=0x08000000))";
  } else if (fault.address_known && fault.address >= null_end &&
             fault.address <= ~std::uint32_t{0}) {
    const auto address = static_cast<std::uint32_t>(fault.address);
    const Answerer answerer = surroundings.device(address);
    text += surroundings.name_at(address);
    if (!answerer.name.empty() && answerer.is_modelled)
      text +=
          ", a device address: dereference no pointer to it, use hal_read32() and hal_write32()";
  }
  if (code_) {
    fault_calls_.assign(fault.frames,
                        fault.frames + std::min(fault.frame_count, Fault::most_frames));
  }
  break_off(text);
}

// Of a program that describes itself, a pointer below the DDR is a mistake.
bool Cpu::reaches_by_pointer(std::uintptr_t address) const {
  const bool low = address >= null_end && address < low_end && program_->charge() != nullptr;
  return low || (address >= first_register && address <= ~std::uint32_t{0});
}

// In the signal handler of a segmentation fault.
bool Cpu::on_fault(std::uintptr_t address, void* context) {
  if (LineGuard::on_fault(address, context)) return true;
  if (!ProgramWatch::runs || !running_ || !running_->reaches_by_pointer(address) ||
      running_->surroundings.device(static_cast<std::uint32_t>(address)).name.empty()) {
    return false;
  }
  return PointerAccess::divert(context, address, &Cpu::make_access);
}

// Part of a word is read with it, and written with the rest of it as it is.
std::uint32_t Cpu::access_part(bool read, std::uint32_t address, unsigned bytes,
                               std::uint32_t value) {
  constexpr unsigned word_bytes = 4, bits = 8;
  if (bytes == word_bytes) return access(read, address, value);
  const unsigned shift = address % word_bytes * bits;
  const std::uint32_t word_address = address & ~(word_bytes - 1);
  const std::uint32_t mask = ((1u << bytes * bits) - 1) << shift;
  const std::uint32_t word = access(true, word_address, 0);
  if (read) return (word & mask) >> shift;
  return access(false, word_address, (word & ~mask) | (value << shift & mask));
}

// `unsigned long` has 32 bits on the chip: such an access is one of a word.
void Cpu::access_by_pointer(PointerAccess& pointer) {
  constexpr unsigned word_bytes = 4, long_bytes = 8;
  const auto address = static_cast<std::uint32_t>(pointer.address);
  const std::string where = vp::hex(address) + surroundings.name_at(address);
  PointerAccess::Move move{};
  if (const char* const why = pointer.decode(move)) {
    misuse("the program accesses " + where + " with " + why +
           ": read and write registers word by word, through pointers to volatile uint32_t");
  }
  const bool is_long = move.bytes == long_bytes && !pointer.is_vector();
  if (is_long && !warned_of_long_) {
    warned_of_long_ = true;
    vp::warn(*this, "/markervp/cpu/long_register",
             "the program accesses " + where +
                 " with 8 bytes, as a pointer to unsigned long does here; on the chip that has 4, "
                 "and so has this access; use u32 or uint32_t, for p[1] lies 8 bytes on here");
  }
  const unsigned bytes = is_long ? word_bytes : move.bytes;
  if (address % std::min(bytes, word_bytes) != 0) {
    misuse("data abort: unaligned access of " + std::to_string(bytes) + " bytes at " + where);
  }
  for (unsigned at = 0; at < bytes; at += word_bytes) {
    std::uint32_t word = 0;
    std::memcpy(&word, move.data + at, word_bytes);
    word = access_part(!move.store, address + at, std::min(bytes, word_bytes), word);
    if (!move.store) std::memcpy(move.data + at, &word, word_bytes);
  }
  pointer.complete(move);
}

void Cpu::call_handler() {
  std::string thrown;
  try {
    const ProgramWatch::ProgramCode code;
    irq_.call_handler();
    return;
  } catch (const sc_core::sc_unwind_exception&) {
    throw;
  } catch (const std::exception& error) {
    thrown = std::string(": ") + error.what();
  } catch (...) {
  }
  fail("the interrupt handler threw an exception" + thrown);
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
void Cpu::notice_loop(unsigned before, bool is_empty) {
  constexpr unsigned long_loop = 100;  // looks: it computes no more, but waits
  const std::uint64_t taken = interrupts;
  signs_.set_loops(before >= long_loop || is_empty);
  catch_up();
  if (interrupts == taken && (is_empty || !code_takes_time())) {
    signs_.set_loops(true);
    pass(first_jump_ps << std::min(before, beside_other() ? most_beside_other : most_doublings));
    catch_up();
  }
  signs_.set_loops(false);
}

// Of the innermost calls first: one that cannot return decides. A program that describes itself
// works on inputs, or ends.
MachineCode::Reach Cpu::reach() const {
  using Reach = MachineCode::Reach;
  const MachineCode* const code = program_->charge() ? program_->code() : nullptr;
  if (!code) return Reach::returns;
  for (const std::uintptr_t call : return_addresses()) {
    if (!code->contains(call)) continue;
    const Reach found = code->reach(HostWatch::is_empty_loop(call) ? call : call + 1);
    if (found != Reach::returns) return found;
  }
  return Reach::returns;
}

// What it waits for inside of its endless loop may never come: a warning says so. A kernel with
// tasks (hal_after_interrupt) computes between its interrupts in a task that idles, for ever.
void Cpu::end_at_limit(const std::string& hint, bool sleeps) {
  const bool waits = signs_.loops() ? !after_interrupt_ && reach() != MachineCode::Reach::straight
                                    : signs_.sees_no_change();
  // It leaves all to handlers: what keeps an interrupt from them?
  const bool leaves_it = signs_.loops() && !waits && irq_.handler();
  const std::string stopped =
      leaves_it ? surroundings.wait_reason({irq_.masked_by_program(), {}, true}) : "";
  if (!main_end_ps_ && (sleeps || waits || !stopped.empty())) {
    vp::warn(*this, "/markervp/cpu/time_limit",
             "the program reached its time limit, " + vp::format_time(settings_.timeout) + " (" +
                 settings_.timeout.name() + "), in an endless loop" +
                 (sleeps ? "; it waits for an interrupt, and none came" : "") +
                 (leaves_it ? stopped : hint));
  }
  reached_limit_ = true;
  end(State::finished);
  rest();
}

std::optional<std::string> Cpu::place() const {
  const auto process = sc_core::sc_get_current_process_handle();
  if (running_ && dynamic_cast<const Cpu*>(process.get_parent_object()) == nullptr) return {};
  return program_counter();
}

void Cpu::read_lines() const {
  if (code_) code_->path({reinterpret_cast<std::uintptr_t>(program_->description().entry) + 1});
}

std::string Cpu::program_counter() const {
  if (locate_program_) return locate_program_();
  if (!code_ || !running_) return {};
  return code_->path(fault_calls_.empty() ? return_addresses() : fault_calls_);
}

}  // namespace ps
