// The processor's time: what it did ahead of the simulation passes, and interrupts come in between.
#include <ps/cpu/cpu.h>

#include <algorithm>
#include <string>

#include <vp/unit.h>

namespace ps {

namespace {

constexpr const char* no_end = "no end";
constexpr std::size_t longest_timeline = 4096;
/// How far a core runs ahead of its work beside the other one, which sees its memory: what the
/// program does may depend on it, so it is no quantum.
constexpr std::uint64_t ahead_of_other_ps = 10'000'000;
/// Deeper than any stack (decision).
constexpr std::size_t most_open_functions = 1'000'000;

}  // namespace

void Cpu::follow_clock() {
  hertz_ = clock_.frequency_hz();
  if (hertz_ == 0) fail("the clock of the CPU was stopped");
  local_time_.set_frequency(hertz_);
  work_.set_frequency(hertz_);
}

void Cpu::spend_cycles(std::uint64_t cycles) {
  local_time_.add_cycles(LocalTime::Wide{cycles} << LocalTime::fraction_bits);
}

// The time of what was counted since the last call.
inline std::uint64_t Cpu::take_work() {
  if (local_time_.empty()) return 0;
  if (hertz_ != clock_.frequency_hz()) follow_clock();
  return local_time_.take_ps();
}

void Cpu::close_segment() {
  if (const std::uint64_t ps = take_work()) timeline_.push(Timeline::Kind::work, ps);
}

// Nothing is counted since the simulation was looked at.
void Cpu::start_ahead() {
  ahead_fs_ = 0;
  ahead_limit_fs_ = 0;
}

// More work is counted than settle() may leave: the quantum, and not past the time-out.
bool Cpu::far_ahead() {
  if (ahead_limit_fs_ == 0) {
    const std::uint64_t reached = reached_ps();
    const std::uint64_t left = deadline_.ps() > reached ? deadline_.ps() - reached : 0;
    const std::uint64_t most = beside_other() ? ahead_of_other_ps : settings_.quantum.get();
    ahead_limit_fs_ = std::min(left, most) * LocalTime::fs_per_ps;
  }
  return ahead_fs_ >= ahead_limit_fs_;
}

// The rest of the last bus access passes. An interrupt waits for its end.
inline void Cpu::end_access() {
  const std::uint64_t start = now_ps();
  if (access_end_ps_ > start) pass_busy(start, access_end_ps_);
}

// What basic blocks took since they were last looked at.
void Cpu::spend_timed_blocks() {
  const bool slower = cores_->all.front()->caches_off_;
  const double scale = slower ? settings_.uncached_scale.get() : 1;
  local_time_.add_cycles(
      work_.add_code(ProgramWatch::take_blocks(), static_cast<std::uint64_t>(scale)));
}

// What was done since the simulation was looked at; false where more than that is to be played.
inline bool Cpu::take_stretch(Stretch& stretch) {
  const bool in_one =
      irq_.in_handler() || (timeline_.empty() && (irq_.masked() || !interrupt_pending()));
  const std::uint64_t start = now_ps();
  if (!in_one || !scheduler_.up_to_date(start) || !local_time_.little() ||
      hertz_ != clock_.frequency_hz()) {
    return false;
  }
  const std::uint64_t work = local_time_.empty() ? 0 : local_time_.take_little();
  stretch = {start, work, std::max(access_end_ps_, start) + work};
  start_ahead();
  return true;
}

// Usually nothing happens meanwhile, so that no interrupt can come: that is kept short.
inline std::uint64_t Cpu::pass_stretch(const Stretch& stretch) {
  const auto [start, work, end] = stretch;
  if (end <= start) return start;
  if (end >= deadline_.ps() || !scheduler_.pass_quietly(end)) return pass_work(start, work);
  activity_.busy(end - start);
  return end;
}

// All that was done ahead passes, and interrupts that come run their handler. Returns the present
// time.
std::uint64_t Cpu::catch_up() {
  Stretch stretch;
  return take_stretch(stretch) ? pass_stretch(stretch) : catch_up_slowly();
}

// Work before an access and the way to the register are one stretch where nothing comes in between.
[[gnu::always_inline]] inline bool Cpu::access_quietly(const Stretch& stretch, bool read,
                                                       std::uint32_t address,
                                                       std::uint32_t& value) {
  vp::RegisterRoute* const route = routes_.find(address);
  vp::BusStage::Passage passage;
  if (!route || stretch.end_ps >= deadline_.ps() ||
      !route->reach_quietly(stretch.end_ps, read, passage)) {
    return false;
  }
  on_bus(stretch.start_ps, read, address, [&] { return route->arrive(passage, read, value); });
  return true;
}

std::uint32_t Cpu::access(bool read, std::uint32_t address, std::uint32_t value) {
  Stretch stretch;
  const bool plain = take_stretch(stretch);
  if (!plain || !access_quietly(stretch, read, address, value)) {
    const std::uint64_t now = plain ? pass_stretch(stretch) : catch_up_slowly();
    if (vp::RegisterRoute* route = routes_.find(address)) {
      on_bus(now, read, address, [&] { return route->transfer(now, read, value); });
    } else {
      transport(read, address, value);
    }
  }
  if (read) signs_.note_read(address, value);
  return value;
}

std::uint64_t Cpu::catch_up_slowly() {
  const bool plain = irq_.in_handler() || timeline_.empty();
  const std::uint64_t work = plain ? take_work() : 0;
  if (!plain) close_segment();
  const std::uint64_t start = scheduler_.synchronised_ps();
  start_ahead();
  if (plain) return pass_work(start, work);
  end_access();
  play(Interrupts::take);
  take_interrupts();
  return now_ps();
}

// The rest of an access and the work after it. Where no interrupt can come, they are one stretch.
std::uint64_t Cpu::pass_work(std::uint64_t start_ps, std::uint64_t work_ps) {
  if (!irq_.interruptible()) {
    const std::uint64_t end = std::max(access_end_ps_, start_ps) + work_ps;
    return end > start_ps ? pass_busy(start_ps, end) : start_ps;
  }
  end_access();
  work_for(work_ps);
  take_interrupts();
  return now_ps();
}

// Nothing interrupts it. Returns the end.
std::uint64_t Cpu::pass_busy(std::uint64_t start_ps, std::uint64_t end_ps) {
  const std::uint64_t end = std::min(end_ps, std::max(deadline_.ps(), start_ps));
  scheduler_.pass_from(start_ps, end);
  activity_.busy(end - start_ps);
  if (end >= deadline_.ps()) meet_deadline(no_end, signs_of_waiting());
  return end < end_ps ? pass_busy(end, end_ps) : end;
}

// The simulation follows, up to an interrupt at most: handlers run inside HAL calls that catch up,
// not between two statements of the program. There it waits until the program comes to such a call.
// A handler is not interrupted: it catches up.
void Cpu::settle() {
  if (irq_.in_handler()) {
    catch_up();
    return;
  }
  close_segment();
  if (deadline_.is_timeout(reached_ps())) {
    catch_up();
    return;
  }
  scheduler_.synchronise();
  end_access();
  play(Interrupts::leave);
  start_ahead();
}

// A stretch of work with nothing before it.
void Cpu::work_for(std::uint64_t ps) {
  while (ps > 0) {
    take_interrupts();
    ps -= pass(ps);
  }
}

// False if an interrupt is due that was to be left.
bool Cpu::play(Interrupts interrupts) {
  while (!timeline_.empty()) {
    const Timeline::Segment& segment = timeline_.front();
    switch (segment.kind) {
      case Timeline::Kind::work:
        if (interrupt_due()) {
          if (interrupts == Interrupts::leave) return false;
          run_handler();
          continue;
        }
        timeline_.pass(pass(segment.ps));
        if (timeline_.front().ps > 0) continue;
        break;
      case Timeline::Kind::enter:
        entered(segment.function, now_ps());
        break;
      case Timeline::Kind::leave:
        left(now_ps());
        break;
    }
    timeline_.pop();
  }
  return true;
}

inline void Cpu::entered(std::uint32_t number, std::uint64_t now_ps) {
  activity_.enter(number, now_ps);
  function = number + 1;
}

inline void Cpu::left(std::uint64_t now_ps) {
  activity_.leave(now_ps);
  function = activity_.function() + 1;  // none + 1 is 0
}

// Lets up to `ps` pass; less if an interrupt comes that may be taken. Returns what passed.
std::uint64_t Cpu::pass(std::uint64_t ps) {
  const std::uint64_t start = now_ps();
  const std::uint64_t end = start + std::min(ps, deadline_.ps() - std::min(deadline_.ps(), start));
  scheduler_.pass_from(start, end, irq_.interruptible() ? irq_is_low : nullptr, this);
  const std::uint64_t now = now_ps();
  activity_.busy(now - start);
  if (now < deadline_.ps()) return now - start;
  meet_deadline(no_end, signs_of_waiting());
  const std::uint64_t left = ps - (now - start);
  return now - start + (left == 0 || interrupt_due() ? 0 : pass(left));
}

// Handles the time-out, or only the deadline of call_at(), after which the program continues.
void Cpu::meet_deadline(const char* what, const std::string& hint) {
  if (!deadline_.is_timeout(now_ps())) {
    start_ahead();
    deadline_.look();
    return;
  }
  if (number_ == 0 && (main_end_ps_ || reach() != MachineCode::Reach::returns))
    end_at_limit(hint, std::string_view(what) != no_end);
  fail(std::string(what) + " within " + vp::format_time(settings_.timeout) +
       " of simulated time since the last input (" + settings_.timeout.name() + ")" + hint +
       doing_elsewhere());
}

// For what no device of the platform tells. Interrupts run their handlers meanwhile; the time-out
// does not count.
void Cpu::sleep_until(std::uint64_t ps) {
  while (now_ps() < ps) {
    deadline_.set_timeout(ps + settings_.timeout);
    doze(std::min(ps, std::max(deadline_.ps(), now_ps())),
         irq_.interruptible() ? irq_is_low : nullptr);
    if (now_ps() >= deadline_.ps()) meet_deadline(no_end);
    take_interrupts();
  }
}

void Cpu::do_work(std::uint32_t item, std::uint64_t count) {
  const WorkMeter::Unit* const work = work_.add(item, count);
  if (!work) misuse("hal_work(" + std::to_string(item) + "): no such unit of work");
  local_time_.add_cycles(work->cycles * count);
  local_time_.add_stall_fs(work->stall_fs * count);
  constexpr std::uint64_t much = std::uint64_t{1} << 40;
  if (count < much) ahead_fs_ += work->most_fs * count;
  if (count >= much || (ahead_fs_ >= ahead_limit_fs_ && far_ahead())) settle();
}

void Cpu::enter_function(std::uint32_t number) {
  if (number >= program_->description().function_count) {
    misuse("hal_function_enter(" + std::to_string(number) + "): no such function");
  }
  ++open_functions_;
  if (irq_.in_handler()) {
    check_open_functions();
    return entered(number, catch_up());
  }
  close_segment();
  timeline_.push(Timeline::Kind::enter, 0, number);
  if (timeline_.size() < longest_timeline) return;
  settle();
  check_open_functions();
}

void Cpu::check_open_functions() {
  if (open_functions_ < most_open_functions) return;
  misuse("hal_function_enter() was called " + std::to_string(open_functions_) +
         " times more than hal_function_leave()");
}

void Cpu::leave_function() {
  if (open_functions_ <= open_before_handler_) {
    misuse("hal_function_leave() without hal_function_enter()");
  }
  --open_functions_;
  if (irq_.in_handler()) return left(catch_up());
  close_segment();
  timeline_.push(Timeline::Kind::leave, 0);
  if (timeline_.size() >= longest_timeline) settle();
}

}  // namespace ps
