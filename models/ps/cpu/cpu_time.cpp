// The processor's time: what it did ahead of the simulation passes, and interrupts come in between.
#include <ps/cpu/cpu.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/unit.h>
#include <algorithm>

namespace ps {

namespace {

constexpr LocalTime::Wide fs_per_second = 1'000'000'000'000'000;
constexpr std::size_t longest_timeline = 4096;

}  // namespace

// The cost of a unit is kept in cycles; its upper bound in time follows the clock.
void Cpu::follow_clock() {
  if (hertz_ == clock_.frequency_hz()) return;
  hertz_ = clock_.frequency_hz();
  if (hertz_ == 0) fail("the clock of the CPU was stopped");
  local_time_.set_frequency(hertz_);
  for (Work& work : work_) {
    const LocalTime::Wide denominator = LocalTime::Wide{hertz_} << LocalTime::fraction_bits;
    work.most_fs = work.cycles * fs_per_second / denominator + 1 + work.stall_fs;
  }
}

void Cpu::spend_cycles(std::uint64_t cycles) {
  local_time_.add_cycles(LocalTime::Wide{cycles} << LocalTime::fraction_bits);
}

void Cpu::close_segment() {
  if (local_time_.empty()) return;
  follow_clock();
  if (const std::uint64_t ps = local_time_.take_ps()) timeline().push(Timeline::Kind::work, ps);
}

// How much work may be counted before settle() looks at it: the quantum, but not past the time-out.
void Cpu::limit_advance() {
  const std::uint64_t reached = now_ps() + timeline().total_ps();
  const std::uint64_t left = deadline_ps_ > reached ? deadline_ps_ - reached : 0;
  ahead_fs_ = 0;
  ahead_limit_fs_ = LocalTime::Wide{std::min<std::uint64_t>(left, quantum)} * LocalTime::fs_per_ps;
}

// All that was done ahead passes, and interrupts that come run their handler.
void Cpu::catch_up() {
  close_segment();
  clock_.scheduler().synchronise();
  play(Interrupts::take);
  while (interrupt_due()) run_handler();
  limit_advance();
}

// The simulation follows, up to an interrupt at most: handlers run inside HAL calls that catch up,
// not between two statements of the program. There it waits until the program comes to such a call.
void Cpu::settle() {
  close_segment();
  if (now_ps() + timeline().total_ps() >= deadline_ps_) {
    catch_up();
    return;
  }
  clock_.scheduler().synchronise();
  play(Interrupts::leave);
  limit_advance();
}

// False if an interrupt is due that was to be left.
bool Cpu::play(Interrupts interrupts) {
  Timeline& line = timeline();
  while (!line.empty()) {
    const Timeline::Segment segment = line.front();
    switch (segment.kind) {
      case Timeline::Kind::work:
        if (interrupt_due()) {
          if (interrupts == Interrupts::leave) return false;
          run_handler();
          continue;
        }
        line.pass(pass(segment.ps, true));
        if (line.front().ps > 0) continue;
        break;
      case Timeline::Kind::access:
        pass(segment.ps, false);
        break;
      case Timeline::Kind::enter:
        activity_.enter(segment.function, now_ps());
        function = segment.function + 1;
        break;
      case Timeline::Kind::leave:
        activity_.leave(now_ps());
        function = activity_.function() + 1;  // none + 1 is 0
        break;
    }
    line.pop();
  }
  return true;
}

// Lets up to `ps` pass; less if an interrupt comes that may be taken. Returns what passed.
std::uint64_t Cpu::pass(std::uint64_t ps, bool interruptible) {
  const std::uint64_t start = now_ps();
  const std::uint64_t end = start + std::min(ps, deadline_ps_ - std::min(deadline_ps_, start));
  if (interruptible && !masked_ && !in_handler_now_) {
    clock_.scheduler().pass_until(end, irq_is_low, this);
  } else {
    clock_.scheduler().pass_until(end);
  }
  const std::uint64_t passed = now_ps() - start;
  activity_.busy(passed, in_handler_now_);
  if (now_ps() >= deadline_ps_) {
    fail("no end within " + vp::format_time(timeout) + " of simulated time since the last image (" +
         timeout.name() + ")");
  }
  return passed;
}

bool Cpu::irq_is_low(const void* cpu) {
  return static_cast<const Cpu*>(cpu)->interrupt_pending();
}

void Cpu::on_change(vp::SignalBase&, std::uint32_t) {
  if (interrupt_pending()) clock_.scheduler().check_condition();
}

void Cpu::run_handler() {
  if (!handler_) fail("an interrupt is pending and IRQ is unmasked, but no handler is connected");
  ++interrupts;
  masked_ = true;
  in_handler_now_ = true;
  in_handler = true;
  activity_.enter_handler();
  open_before_handler_ = open_functions_;

  running_ = this;
  spend_cycles(interrupt_entry);
  handler_(handler_context_);
  if (open_functions_ != open_before_handler_) {
    misuse("the interrupt handler returned without leaving its function");
  }
  spend_cycles(interrupt_exit);
  catch_up();

  open_before_handler_ = 0;
  activity_.leave_handler();
  in_handler = false;
  in_handler_now_ = false;
  masked_ = false;
}

void Cpu::wait_for_interrupt() {
  catch_up();
  if (!interrupt_pending()) sleep();
  catch_up();
}

void Cpu::sleep() {
  const std::uint64_t start = now_ps();
  asleep = true;
  clock_.scheduler().pass_until(std::max(deadline_ps_, start), irq_is_low, this);
  asleep = false;
  activity_.idle(now_ps() - start);
  if (!interrupt_pending()) {
    fail("it waits for an interrupt, and none came within " + vp::format_time(timeout) +
         " of simulated time since the last image (" + timeout.name() + ")");
  }
}

void Cpu::do_work(std::uint32_t item, std::uint64_t count) {
  if (item >= work_.size()) misuse("hal_work(" + std::to_string(item) + "): no such unit of work");
  Work& work = work_[item];
  work.count += count;
  local_time_.add_cycles(work.cycles * count);
  local_time_.add_stall_fs(work.stall_fs * count);
  constexpr std::uint64_t much = std::uint64_t{1} << 40;
  if (count < much) ahead_fs_ += work.most_fs * count;
  if (count >= much || ahead_fs_ >= ahead_limit_fs_) settle();
}

void Cpu::enter_function(std::uint32_t number) {
  if (number >= program_->description().function_count) {
    misuse("hal_function_enter(" + std::to_string(number) + "): no such function");
  }
  close_segment();
  timeline().push(Timeline::Kind::enter, 0, number);
  ++open_functions_;
  if (timeline().size() >= longest_timeline) settle();
}

void Cpu::leave_function() {
  if (open_functions_ <= open_before_handler_) {
    misuse("hal_function_leave() without hal_function_enter()");
  }
  close_segment();
  timeline().push(Timeline::Kind::leave, 0);
  --open_functions_;
  if (timeline().size() >= longest_timeline) settle();
}

}  // namespace ps
