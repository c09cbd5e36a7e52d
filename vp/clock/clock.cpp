#include <vp/clock.h>

#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/systemc_pins.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace vp {

namespace {

using Wide = unsigned __int128;

}  // namespace

void EdgeTimes::restart(std::uint64_t cycles, std::uint64_t ps, std::uint64_t hertz) {
  hertz_ = hertz;
  stopped_ = hertz == 0;
  origin_ = anchor_ = {cycles, ps, hertz / 2};
  reach_ps_ = 0;
  if (stopped()) return;
  period_ps_ = ps_per_second / hertz_;
  period_remainder_ = ps_per_second % hertz_;
  reach_ps_ = (std::uint64_t{1} << 62) / hertz_;
}

void EdgeTimes::halt(std::uint64_t cycles, std::uint64_t ps) {
  stopped_ = true;
  origin_ = anchor_ = {cycles, ps, 0};
  reach_ps_ = 0;
}

void EdgeTimes::join(std::uint64_t cycles, const EdgeTimes& source, std::uint64_t source_cycle) {
  const Edge last = source.edge(source_cycle);
  *this = source;
  origin_ = anchor_ = {cycles, last.ps, last.remainder};
}

// Some way before `cycle`, as the next question may be about an earlier time.
void EdgeTimes::set_anchor(std::uint64_t cycle) const {
  constexpr std::uint64_t margin = std::uint64_t{1} << 16;
  const std::uint64_t from_origin = cycle - origin_.cycle;
  const std::uint64_t edges = from_origin - std::min(from_origin, margin);
  const Wide numerator = Wide(edges) * ps_per_second + origin_.remainder;
  anchor_ = {origin_.cycle + edges, origin_.ps + static_cast<std::uint64_t>(numerator / hertz_),
             static_cast<std::uint64_t>(numerator % hertz_)};
}

// The first edge at or after `ps`, which is past the origin, counted from an anchor near it.
inline std::uint64_t EdgeTimes::edges_from_anchor(std::uint64_t ps) const {
  if (ps - anchor_.ps > reach_ps_) {
    // The edge looked for or the one before.
    set_anchor(origin_.cycle +
               static_cast<std::uint64_t>(Wide(ps - origin_.ps) * hertz_ / ps_per_second));
  }
  // The smallest n whose edge, n · 10¹² / f + what was cut off, is not before.
  const std::uint64_t distance = (ps - anchor_.ps) * hertz_;
  if (distance <= anchor_.remainder) return 0;
  return (distance - anchor_.remainder + ps_per_second - 1) / ps_per_second;
}

std::uint64_t EdgeTimes::cycle_at_or_after(std::uint64_t ps) const {
  if (stopped()) return never;
  if (ps <= origin_.ps) return origin_.cycle + 1;
  const std::uint64_t n = edges_from_anchor(ps);
  return std::max(anchor_.cycle + n, origin_.cycle + 1);
}

EdgeTimes::Moment EdgeTimes::far_edge_at_or_after(std::uint64_t ps) const {
  if (stopped()) return {origin_.cycle, never};
  const std::uint64_t first = origin_.cycle + 1;
  if (ps <= origin_.ps) return {first, edge(first).ps};
  const std::uint64_t n = edges_from_anchor(ps);
  if (anchor_.cycle + n < first) return {first, edge(first).ps};
  return {anchor_.cycle + n, time_from_anchor(n)};
}

void Earliest::push(std::uint64_t time) {
  times_.back() = time;
  times_.push_back(never);
  look();
}

void Earliest::erase(std::size_t place) {
  times_.erase(times_.begin() + static_cast<std::ptrdiff_t>(place));
  look();
}

void Earliest::look() {
  std::size_t first = 0;
  std::uint64_t earliest = times_[0], others = never;
  const std::size_t count = times_.size();
  const std::uint64_t* const times = times_.data();
  for (std::size_t place = 1; place < count; ++place) {
    const std::uint64_t time = times[place];
    if (time >= others) continue;
    if (time < earliest) {
      others = std::exchange(earliest, time);
      first = place;
    } else {
      others = time;
    }
  }
  first_ = first;
  others_ = others;
}

// A module's alarm has moved, outside of an edge.
inline void Clock::plan_alarm(std::uint64_t before, std::uint64_t cycle) {
  if (next_.ps != never && cycle >= next_.cycle) {
    if (before == next_.cycle) plan_next(scheduler_.now_ps());
  } else if (cycle != never && !times_.stopped()) {
    next_ = times_.edge(cycle);
    scheduler_.reschedule(*this);
  }
}

Clocked::Clocked(sc_core::sc_module_name name, Clock& clock)
    : sc_module(name), clock_(clock), place_(clock.places_.size()) {
  clock_.places_.push_back({this});
  clock_.alarms_.push(Clock::never);
  ++clock_.awake_;
  clock_.attend_to_all();
}

Clocked::~Clocked() {
  sleep();
  auto& places = clock_.places_;
  clock_.alarms_.erase(place_);
  places.erase(places.begin() + static_cast<std::ptrdiff_t>(place_));
  for (std::size_t i = place_; i < places.size(); ++i) places[i].module->place_ = i;
  clock_.attend_to_all();
}

void Clocked::wake() {
  Clock::Place& place = clock_.places_[place_];
  if (place.awake) return;
  place.awake = true;
  clock_.attend_to(place_);
  // While another module is awake every edge runs anyway.
  if (clock_.awake_++ == 0) clock_.plan_next(clock_.scheduler().now_ps());
}

void Clocked::wake_at(std::uint64_t cycle) {
  if (cycle < (clock_.in_edge_ ? clock_.cycle_ : clock_.cycle())) refuse_alarm(cycle);
  const std::uint64_t before = clock_.alarms_[place_];
  clock_.alarms_.set(place_, cycle);
  clock_.attend_to(place_);
  if (clock_.awake_ == 0 && !clock_.in_edge_) clock_.plan_alarm(before, cycle);
}

void Clocked::refuse_alarm(std::uint64_t cycle) const {
  throw std::logic_error(std::string(name()) + ": alarm for edge " + std::to_string(cycle) +
                         ", which has run: now is " + std::to_string(clock_.cycle()));
}

void Clocked::wake_on(InBase& input) {
  wake_inputs_.push_back(&input);
}

void Clocked::on_change(SignalBase&, std::uint32_t) {
  wake();
}

void Clocked::end_of_elaboration() {
  for (const InBase* input : inputs_) {
    if (input->signal()) continue;
    throw InputError(std::string(name()) + "." + input->name() +
                     " is connected to nothing: bind it to a signal where the design is wired");
  }
  for (InBase* input : wake_inputs_) {
    if (input->signal()) input->signal()->attach(*this);
  }
}

Clock::Clock(const char* name, ClockScheduler& scheduler, std::uint64_t hertz)
    : sc_object(name), scheduler_(scheduler) {
  scheduler_.clocks_.push_back(this);
  start(0, 0, hertz);
}

void Clock::set_frequency(std::uint64_t hertz) {
  scheduler_.synchronise();
  for (ClockListener* listener : listeners_) listener->before_change(*this);
  const std::uint64_t now = scheduler_.now_ps();
  start(cycle(), now, hertz);
  ++scheduler_.clock_changes_;
  plan_next(now);
  for (ClockListener* listener : listeners_) listener->after_change(*this);
}

void Clock::start(std::uint64_t cycles, std::uint64_t ps, std::uint64_t hertz) {
  times_.restart(cycles, ps, hertz);
  ahead_ = {0, never};
  next_ = {cycles + 1, never, 0};
  if (!times_.stopped()) next_ = times_.edge(cycles + 1);
}

void Clock::halt() {
  const std::uint64_t now = scheduler_.synchronised_ps();
  times_.halt(cycle(), now);
  plan_next(now);
  if (pin_) pin_->follow_gate();
}

void Clock::join(const Clock& source) {
  const std::uint64_t now = scheduler_.synchronised_ps();
  times_.join(cycle(), source.times_, source.cycle());
  plan_next(now);
  if (pin_) pin_->follow_gate();
}

std::uint64_t Clock::cycle() const {
  const std::uint64_t now = scheduler_.now_ps();
  return now == cycle_ps_ ? cycle_ : count_cycles(now);
}

std::uint64_t Clock::count_cycles(std::uint64_t now_ps) const {
  cycle_ = now_ps == ahead_.ps ? ahead_.cycle : times_.cycles_until(now_ps);
  cycle_ps_ = now_ps;
  return cycle_;
}

std::uint64_t Clock::duration_ps(double cycles) const {
  if (times_.hertz() == 0) return never;
  return static_cast<std::uint64_t>(cycles * static_cast<double>(EdgeTimes::ps_per_second) /
                                        static_cast<double>(times_.hertz()) +
                                    0.5);
}

// A module that is woken meanwhile by one before it is visited too.
template <class Visit>
void Clock::for_each_attended(std::size_t from, Visit visit) const {
  const std::uint64_t* const words = attended_.data();
  const std::size_t count = attended_.size();
  std::uint64_t rest = ~std::uint64_t{0} << from % 64;
  for (std::size_t word = from / 64; word < count; ++word, rest = ~std::uint64_t{0}) {
    for (std::uint64_t left = words[word] & rest; left != 0;) {
      const unsigned bit = static_cast<unsigned>(__builtin_ctzll(left));
      visit(64 * word + bit);
      left = words[word] & ~std::uint64_t{1} << bit;
    }
  }
}

void Clock::attend_to_all() {
  attended_.assign((places_.size() + 63) / 64, 0);
  for (std::size_t i = 0; i < places_.size(); ++i) attend_to(i);
}

inline void Clock::run_alarm(std::size_t at) {
  if (alarms_[at] != cycle_) return;  // it was moved
  alarms_.set(at, never);
  places_[at].module->edge();
}

inline void Clock::go_to_alarm(std::uint64_t cycle) {
  if (cycle == never || times_.stopped()) {
    next_.ps = never;
  } else {
    next_ = times_.edge(cycle);
  }
}

// Nearly always, a clock whose modules sleep runs an edge for the alarm of a single one.
void Clock::run_edge() {
  ++edges_run_;
  in_edge_ = true;
  const std::uint64_t cycle = next_.cycle;
  cycle_ = cycle;
  cycle_ps_ = next_.ps;
  if (awake_ == 0 && alarms_.others_are_after(cycle)) {
    const std::size_t place = alarms_.place();
    run_alarm(place);
    if (awake_ != 0 || alarms_.bound() <= cycle) run_attended(place + 1);
  } else {
    run_attended(0);
  }
  in_edge_ = false;
  if (awake_ == 0) {
    go_to_alarm(alarms_.time());
  } else if (next_.cycle == cycle) {
    next_ = times_.after(next_);
  }
}

// Nearly always, a module that is visited is awake, stays so, and no alarm is due.
void Clock::run_attended(std::size_t from) {
  for_each_attended(from, [this](std::size_t i) {
    if (alarms_.bound() <= cycle_ && alarms_[i] == cycle_) {
      alarms_.set(i, never);
      places_[i].module->edge();
    } else if (places_[i].awake) {
      places_[i].module->edge();
      if (places_[i].awake) return;
    }
    if (!places_[i].awake && alarms_[i] == never) attend_to(i);
  });
}

// A module woke or set an alarm: the clock runs again from its first edge after `after_ps`.
void Clock::plan_next(std::uint64_t after_ps) {
  // run_edge() plans when all modules have run; an edge of this very instant that is still to come
  // is not passed over.
  if (in_edge_ || next_.ps == after_ps) return;
  if (awake_ > 0 && !times_.stopped()) {
    next_ = times_.edge(times_.cycle_at_or_after(after_ps + 1));
  } else {
    go_to_alarm(alarms_.time());
  }
  scheduler_.reschedule(*this);
}

void Clock::set_order(const std::vector<Clocked*>& modules) {
  std::vector<Place> places;
  Earliest alarms;
  for (Clocked* module : modules) {
    places.push_back(places_[module->place_]);
    alarms.push(alarms_[module->place_]);
    module->place_ = places.size() - 1;
  }
  places_ = std::move(places);
  alarms_ = std::move(alarms);
  attend_to_all();
}

}  // namespace vp
