#include <ps/cpu/cores.h>
#include <ps/cpu/cpu.h>
#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <cmath>
#include <cstring>

namespace ps {

using namespace vp::literals;

namespace {

constexpr vp::Range<std::uint32_t> cycles_range{0, 1'000'000};
constexpr double fs_per_ns = 1e6;
/// The first core's time-out ends what the second one does for too long.
constexpr std::uint64_t longest_run_ps = 1'000'000_s;

const char* answer_text(tlm::tlm_response_status status) {
  switch (status) {
    case tlm::TLM_ADDRESS_ERROR_RESPONSE:
      return "DECERR, nothing answers there";
    case tlm::TLM_COMMAND_ERROR_RESPONSE:
      return "SLVERR, the device does not allow it";
    case tlm::TLM_BURST_ERROR_RESPONSE:
      return "SLVERR, the device does not take this size or alignment";
    case tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE:
      return "SLVERR, the device does not take part of a word";
    case tlm::TLM_INCOMPLETE_RESPONSE:
      return "no response (its model is wrong)";
    default:
      return "SLVERR, the device reports an error";
  }
}

}  // namespace

Cpu* Cpu::running_ = nullptr;

Cpu::Settings::Settings()
    : stack_size("stack_size", 8_MiB, vp::Unit::bytes, {64_KiB, 1_GiB}, vp::Source::decision,
                 "stack of the program"),
      quantum("quantum", 100_us, vp::Unit::time, {0, 1000_s}, vp::Source::decision,
              "how far the program may run ahead of the simulation; no result depends on it"),
      timeout("timeout", 10_s, vp::Unit::time, {1_us, 1'000'000_s}, vp::Source::decision,
              "the run ends if the program neither ends nor asks for an input for so long"),
      host_timeout("host_timeout", 10_s, vp::Unit::time, {100_ms, 1'000'000_s},
                   vp::Source::decision,
                   "the run ends if the program takes so much of the host's processor time, or "
                   "waits so long, while no simulated time passes"),
      loop_blocks("loop_blocks", 100'000, vp::Unit::none, {1'000, 1'000'000'000},
                  vp::Source::decision,
                  "basic blocks without HAL call or annotation after which time jumps to what "
                  "happens next"),
      interrupt_entry("interrupt_entry", 100, vp::Unit::cycles, cycles_range, vp::Source::published,
                      "from nIRQ to the handler, warm caches: below 100 (jblopen.com, Zynq-7000)"),
      interrupt_exit("interrupt_exit", 60, vp::Unit::cycles, cycles_range, vp::Source::assumed,
                     "from the handler back to the program"),
      barrier_cycles("barrier_cycles", 20, vp::Unit::cycles, cycles_range, vp::Source::assumed,
                     "a data synchronisation barrier"),
      cache_call_cycles("cache_call_cycles", 60, vp::Unit::cycles, cycles_range,
                        vp::Source::assumed, "a cache operation before its first line"),
      cache_line_cycles("cache_line_cycles", 20, vp::Unit::cycles, cycles_range,
                        vp::Source::assumed, "a line of 32 bytes in both cache levels"),
      cache_all_cycles("cache_all_cycles", 100'000, vp::Unit::cycles, cycles_range,
                       vp::Source::assumed,
                       "an operation on both cache levels as a whole: 17408 lines, by set and way"),
      uncached_scale("uncached_scale", 10, vp::Unit::none, {1, 1'000}, vp::Source::assumed,
                     "how much longer code takes while the data caches are off"),
      block_cycles("block_cycles", 0, vp::Unit::cycles, {0, 1'000}, vp::Source::decision,
                   "what each basic block of the program's own code takes, beside the work that it "
                   "counts; 0: by its instructions, or nothing where the program counts its work"),
      code_scale("code_scale", 1, vp::Unit::none, {0, 1'000}, vp::Source::decision,
                 "how long the code of a program takes that does not count its work, as a multiple "
                 "of what the profile says; 0: no time") {}

Cpu::Cpu(sc_core::sc_module_name name, vp::Clock& clock) : Cpu(name, clock, nullptr) {}

Cpu::Cpu(sc_core::sc_module_name name, vp::Clock& clock, Cpu& first) : Cpu(name, clock, &first) {}

Cpu::~Cpu() = default;

Cpu::Cpu(sc_core::sc_module_name name, vp::Clock& clock, Cpu* first)
    : sc_module(name),
      asleep("asleep", 1, first != nullptr),
      own_settings_(first ? nullptr : std::make_unique<Settings>()),
      settings_(first ? first->settings_ : *own_settings_),
      cores_(first ? first->cores_ : std::make_shared<Cores>()),
      number_(static_cast<unsigned>(cores_->all.size())),
      clock_(clock),
      scheduler_(clock.scheduler()),
      poll_elision_(first == nullptr),
      trap_(static_cast<std::size_t>(settings_.stack_size) + vp::FaultTrap::gap) {
  SC_HAS_PROCESS(Cpu);
  SC_THREAD(run);
  cores_->all.push_back(this);
  set_stack_size(static_cast<std::size_t>(settings_.stack_size) + vp::FaultTrap::gap);
  payload_.set_data_ptr(data_);
  payload_.set_data_length(sizeof data_);
  payload_.set_streaming_width(sizeof data_);
}

void Cpu::load(Program& program, const CostTable& costs) {
  const hal_program& description = program.description();
  work_.clear();
  for (std::uint32_t i = 0; i < description.work_count; ++i) {
    const WorkCost& cost = costs.at(description.work[i], description.name);
    Work work;
    work.cycles = static_cast<LocalTime::Wide>(
        std::llround(cost.cycles * static_cast<double>(LocalTime::one_cycle)));
    work.stall_fs = static_cast<LocalTime::Wide>(std::llround(cost.stall_ns * fs_per_ns));
    work_.push_back(work);
  }
  program_ = &program;
  if (!program.path().empty()) code_.emplace(&description);
  cost_profile_ = costs.profile();
  profile_scale_ = costs.code_scale();
  if (number_ != 0) return;
  for (Cpu* core : cores_->all) {
    if (core != this) core->load(program, costs);
  }
  check_memory();
}

void Cpu::end_of_elaboration() {
  if (number_ == 0) scheduler_.set_lookahead(settings_.quantum);
  if (n_irq.bound()) n_irq.signal()->attach(*this);
  for (vp::Clock* clock : scheduler_.clocks()) clock->add_listener(*this);
}

void Cpu::run() {
  if (!program_) return;
  std::optional<std::string> thrown;
  std::exception_ptr host_failed;  // of the platform, where it works for the program
  if (number_ != 0) await_start();
  state_ = State::running;
  running_ = this;
  try {
    if (number_ == 0) program_->reset();
    if (const auto first = cores_->all.back()->stack().first) {
      const DmaAllocator* const buffers = cores_->all.front()->dma_memory_;
      program_->end_heap_at(buffers ? std::min<std::uintptr_t>(first, buffers->first()) : first);
    }
    activity_.start(program_->description());
    if (number_ != 0) {
      activity_.idle(now_ps());
      if (moment_listener_) moment_listener_(Moment::call_over);
    }
    set_deadline(now_ps() + (number_ == 0 ? settings_.timeout.get() : longest_run_ps));
    follow_clock();
    start_ahead();
    call_program();
    catch_up();
  } catch (const sc_core::sc_unwind_exception&) {
    throw;
  } catch (const vp::HostError&) {
    host_failed = std::current_exception();
  } catch (const std::exception& error) {
    thrown = std::string(": ") + error.what();
  } catch (...) {
    thrown = "";
  }
  if (host_failed) stop(host_failed);
  if (thrown) break_off("the program threw an exception" + *thrown);
  if (number_ == 0) return end(State::finished);
  sleep_for_good();
}

void Cpu::take_turn() {
  running_ = this;
  trap_.resume();
}

void Cpu::end(State state) {
  if (moment_listener_) moment_listener_(Moment::call_over);
  scheduler_.rejoin();
  state_ = state;
  end_ps_ = over_ps_.value_or(now_ps());
  running_ = nullptr;
  ProgramWatch::end();
  ProgramWatch::charge = nullptr;
  LineGuard::program_is_over();
  cores_->all.front()->console.flush();
  for (Cpu* core : cores_->all) {
    if (core != this) core->freeze();
  }
  ended_.notify(sc_core::SC_ZERO_TIME);
  if (pause_at_end_) sc_core::sc_pause();
}

// The run ends with another core.
void Cpu::freeze() {
  watch_.disarm();
  trap_.abandon();
  if (asleep && state_ == State::running) activity_.idle(now_ps() - dozes_since_ps_);
}

void Cpu::on_failure(FailureListener listener) {
  failure_listener_ = std::move(listener);
  trap_.on_fault([this](const vp::Fault& fault) {
    if (fault.kind != vp::Fault::Kind::interrupted) failure_listener_(fault.text() + where());
  });
}

// The thread never comes back: nothing of the program is unwound.
void Cpu::rest() {
  while (true) sc_core::wait(never_);
}

void Cpu::stop(std::exception_ptr error) {
  error_ = std::move(error);
  exit_code_ = 0;
  end(State::failed);
  rest();
}

void Cpu::fail(const std::string& problem) {
  const std::string text = problem + where();
  if (failure_listener_) failure_listener_(text);
  stop(std::make_exception_ptr(vp::ProtocolError(text)));
}

// A mistake found ahead of time: first what the program did before.
void Cpu::misuse(const std::string& problem) {
  catch_up();
  fail(problem);
}

std::string Cpu::where() const {
  std::string text = ", at " + vp::format_time(now_ps());
  const std::uint32_t number = activity_.function();
  const hal_program& description = program_->description();
  if (number != Activity::none) {
    text += std::string(" in function '") + description.functions[number] + "'";
  }
  if (in_handler_now_) text += " in the interrupt handler";
  const std::string place = program_counter();
  if (number_ != 0) text += std::string(" on ") + basename();
  return text + " of program '" + description.name + "'" + (place.empty() ? "" : ", ") + place;
}

void Cpu::check() const {
  for (const Cpu* core : cores_->all) {
    if (core->error_) std::rethrow_exception(core->error_);
  }
  if (state_ == State::running && !interrupted()) {
    throw vp::ProtocolError("nothing is left to happen, but the program has not ended" + where());
  }
}

std::vector<WorkCount> Cpu::work() const {
  std::vector<WorkCount> counts;
  for (std::size_t i = 0; i < work_.size(); ++i) {
    const Work& work = work_[i];
    counts.push_back({program_->description().work[i], work.count,
                      static_cast<double>(work.cycles) / static_cast<double>(LocalTime::one_cycle),
                      static_cast<double>(work.stall_fs) / fs_per_ns});
  }
  return counts;
}

Cpu::Counted Cpu::counted() const {
  Counted sum;
  for (const Work& work : work_) {
    sum.cycles += work.cycles * work.count;
    sum.stall_fs += work.stall_fs * work.count;
  }
  sum.cycles += code_cycles_;
  return sum;
}

void Cpu::nothing_runs(const char* call) {
  if (vp::FaultTrap::can_leave()) vp::FaultTrap::leave(vp::Fault::Kind::no_hal, call);
  throw vp::ProtocolError(std::string(call) + "() was called, but no program runs");
}

Answerer Cpu::answerer_at(std::uint32_t address) const {
  return device_ ? device_(address) : Answerer{};
}

std::string Cpu::device_at(std::uint32_t address) const {
  const Answerer answerer = answerer_at(address);
  if (answerer.name.empty()) return {};
  return " (" + answerer.name + (answerer.is_modelled ? ")" : ": not modelled)");
}

// The general way: anything may be behind the sockets.
void Cpu::transport(bool read, std::uint32_t address, std::uint32_t& value) {
  if (address % sizeof data_ != 0) {
    fail("data abort: access to " + vp::hex(address) + device_at(address) +
         ", which is not a multiple of 4");
  }
  std::memcpy(data_, &value, sizeof data_);
  payload_.set_command(read ? tlm::TLM_READ_COMMAND : tlm::TLM_WRITE_COMMAND);
  payload_.set_address(address);
  payload_.set_byte_enable_ptr(nullptr);
  payload_.set_dmi_allowed(false);
  payload_.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  on_bus(now_ps(), read, address, [&] {
    sc_core::sc_time rest = sc_core::SC_ZERO_TIME;
    m_axi.transport(payload_, rest);
    scheduler_.forget_horizon();
    return vp::RegisterRoute::Answer{payload_.get_response_status(), now_ps() + vp::to_ps(rest)};
  });
  std::memcpy(&value, data_, sizeof data_);
}

void Cpu::refuse(tlm::tlm_response_status status, bool read, std::uint32_t address) {
  // A block that the chip has and the platform has not is no place where nothing answers.
  const std::string answer =
      answerer_at(address).is_modelled ? ": " + std::string(answer_text(status)) : "";
  fail(std::string("data abort: ") + (read ? "read of " : "write to ") + vp::hex(address) +
       device_at(address) + answer);
}

}  // namespace ps
