#include <ps/cpu/cpu.h>
#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <cstring>

namespace ps {

using namespace vp::literals;

namespace {

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

Cpu::Cpu(sc_core::sc_module_name name, vp::Clock& clock) : Cpu(name, clock, nullptr) {}

Cpu::Cpu(sc_core::sc_module_name name, vp::Clock& clock, Cpu& first) : Cpu(name, clock, &first) {}

Cpu::~Cpu() = default;

Cpu::Cpu(sc_core::sc_module_name name, vp::Clock& clock, Cpu* first)
    : sc_module(name),
      asleep("asleep", 1, first != nullptr),
      own_settings_(first ? nullptr : std::make_unique<CpuSettings>()),
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
  work_.load(program.description(), costs);
  program_ = &program;
  if (!program.path().empty()) code_.emplace(&program.description());
  cost_profile_ = costs.profile();
  code_scale_ = costs.code_scale();
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
    deadline_.set_timeout(now_ps() + (number_ == 0 ? settings_.timeout.get() : longest_run_ps));
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
  if (irq_.in_handler()) text += " in the interrupt handler";
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

void Cpu::nothing_runs(const char* call) {
  if (vp::FaultTrap::can_leave()) vp::FaultTrap::leave(vp::Fault::Kind::no_hal, call);
  throw vp::ProtocolError(std::string(call) + "() was called, but no program runs");
}

// The general way: anything may be behind the sockets.
void Cpu::transport(bool read, std::uint32_t address, std::uint32_t& value) {
  if (address % sizeof data_ != 0) {
    fail("data abort: access to " + vp::hex(address) + surroundings.name_at(address) +
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
      surroundings.device(address).is_modelled ? ": " + std::string(answer_text(status)) : "";
  fail(std::string("data abort: ") + (read ? "read of " : "write to ") + vp::hex(address) +
       surroundings.name_at(address) + answer);
}

}  // namespace ps
