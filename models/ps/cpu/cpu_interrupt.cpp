// Interrupts: when one is taken, what runs then, and the sleep until one comes.
#include <ps/cpu/cpu.h>

#include <algorithm>
#include <string>
#include <utility>

#include <vp/report.h>
#include <vp/unit.h>

namespace ps {

namespace {

/// So often the loop behind main() looks whether anything is left to happen (decision): 1 ms. No
/// result depends on it but the length of waveforms.
constexpr std::uint64_t look_after_main_ps = 1'000'000'000;

}  // namespace

void Cpu::connect_interrupt(hal_interrupt_handler handler, void* context) {
  catch_up();
  irq_.connect(handler, context);
}

bool Cpu::enable_interrupt(bool enable) {
  catch_up();
  const bool was_enabled = !irq_.masked();
  irq_.mask(!enable);
  take_interrupts();
  return was_enabled;
}

bool Cpu::irq_is_low(const void* cpu) {
  return static_cast<const Cpu*>(cpu)->interrupt_pending();
}

void Cpu::on_change(vp::SignalBase&, std::uint32_t) {
  if (interrupt_pending()) scheduler_.check_condition();
}

void Cpu::run_handler() {
  if (!irq_.handler())
    fail("an interrupt is pending and IRQ is unmasked, but no handler is connected");
  ++interrupts;
  irq_.enter();
  in_handler = true;
  activity_.enter_handler();
  open_before_handler_ = open_functions_;

  if (running_ != this) take_turn();
  if (both_started_) handler_begins();
  spend_cycles(settings_.interrupt_entry);
  if (moment_listener_) moment_listener_(Moment::handler_begins);
  call_handler();
  spend_blocks();
  if (open_functions_ != open_before_handler_) {
    misuse("the interrupt handler returned without leaving its function");
  }
  spend_cycles(settings_.interrupt_exit);
  catch_up();
  if (moment_listener_) moment_listener_(Moment::handler_over);

  open_before_handler_ = 0;
  activity_.leave_handler();
  in_handler = false;
  irq_.leave();
  event_ = true;
  monitor_.clear();
  check_acknowledged();
  if (after_interrupt_) leave_interrupt();
}

// The program may continue another of its contexts: what this one did ahead waits until it is
// continued itself.
void Cpu::leave_interrupt() {
  Timeline ahead;
  std::swap(ahead, timeline_);
  {
    const ProgramWatch::ProgramCode code;
    after_interrupt_();
  }
  spend_blocks();
  std::swap(ahead, timeline_);
}

bool Cpu::lives_after_main() const {
  const bool served = irq_.interruptible() && irq_.handler() && surroundings.any_interrupt();
  return (served || beside_other()) &&
         (interrupt_due() || deadline_.wants_look() || scheduler_.has_more(give_up_ps_));
}

// Behind main() the vendor's exit() loops for ever: interrupts are served, and the other core runs
// on. The end is that of the last work that was done, or the time-out: a timer never ends, and a
// clocked design costs the host's time. A program that counts its work ends with its entry
// function.
void Cpu::stay_after_main() {
  ProgramWatch::enter_hal();
  if (!program_->charge()) return;
  spend_blocks();
  catch_up();
  main_end_ps_ = now_ps();
  if (!beside_other()) deadline_.shorten_timeout(now_ps() + settings_.after_main);
  std::uint64_t worked_ps = now_ps();
  while (lives_after_main()) {
    pass(look_after_main_ps);
    if (!interrupt_due()) continue;
    take_interrupts();
    worked_ps = now_ps();
  }
  worked_ps = std::max(worked_ps, cores_->all.back()->end_ps_);
  works_after_main_ = worked_ps > *main_end_ps_;
  over_ps_ = worked_ps;
}

void Cpu::wait_for_interrupt() {
  if (irq_.interruptible() && !slept_unmasked_) {
    slept_unmasked_ = true;
    vp::warn(*this, "/markervp/cpu/sleeps_unmasked",
             "hal_wait_for_interrupt() with IRQ unmasked: an interrupt that comes between the last "
             "check of what it changes and the sleep does not wake the CPU; mask IRQ before the "
             "check, with hal_interrupt_enable(false)");
  }
  catch_up();
  sleep();
  take_interrupts();
}

// While the second core is awake, neither core runs ahead, so that simultaneous actions have a
// defined order.
void Cpu::doze(std::uint64_t until_ps, vp::ClockScheduler::Condition condition) {
  const std::uint64_t start = dozes_since_ps_ = now_ps();
  asleep = true;
  if (number_ != 0) scheduler_.set_lookahead(settings_.quantum);
  scheduler_.pass_from(start, until_ps, condition, this);
  if (number_ != 0) {
    scheduler_.set_lookahead(0);
    scheduler_.let_others_go_first();
  }
  asleep = false;
  activity_.idle(now_ps() - start);
}

void Cpu::sleep() {
  while (!interrupt_pending()) {
    doze(std::max(deadline_.ps(), now_ps()), irq_is_low);
    if (!interrupt_pending())
      meet_deadline("it waits for an interrupt, and none came",
                    surroundings.wait_reason({irq_.masked_by_program(), {}}));
  }
}

void Cpu::check_acknowledged() {
  if (!irq_.leaves_too_many(interrupt_pending(), now_ps())) return;
  const Surroundings::Request request = surroundings.request();
  const std::string which = request.text.empty() ? "" : " (" + request.text + ")";
  const std::string so_often = std::to_string(Irq::many_handlers) + " times in a row";
  if (request.since_ps <= irq_.pending_since_ps()) {
    vp::warn(*this, "/markervp/cpu/not_acknowledged",
             "the interrupt handler has returned " + so_often + " with an interrupt still pending" +
                 which + ": acknowledge it at the device, and end it at the interrupt controller");
  } else {
    vp::warn(*this, "/markervp/cpu/overrun",
             "interrupts come faster than they are handled: the handler has returned " + so_often +
                 ", since " + vp::format_time(irq_.pending_since_ps()) +
                 ", with the next one pending" + which +
                 ": let them come more rarely, or do less in the handler");
  }
}

}  // namespace ps
