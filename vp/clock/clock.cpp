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

constexpr std::uint64_t ps_per_second = 1'000'000'000'000;
/// How far an anchor lies before what is looked for, in edges.
constexpr std::uint64_t anchor_margin = std::uint64_t{1} << 16;
using Wide = unsigned __int128;

}  // namespace

// A module's alarm has moved, outside of an edge.
inline void Clock::plan_alarm(std::uint64_t before, std::uint64_t cycle) {
  if (next_.ps != never && cycle >= next_.cycle) {
    if (before == next_.cycle) plan_next(scheduler_.now_ps());
  } else if (cycle != never && hertz_ != 0) {
    seek(cycle);
    scheduler_.reschedule_earlier(*this);
  }
}

Clocked::Clocked(sc_core::sc_module_name name, Clock& clock)
    : sc_module(name), clock_(clock), place_(clock.places_.size()) {
  clock_.places_.push_back({this});
  ++clock_.awake_;
  clock_.attend_to_all();
}

Clocked::~Clocked() {
  sleep();
  auto& places = clock_.places_;
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
  Clock::Place& place = clock_.places_[place_];
  const std::uint64_t before = std::exchange(place.alarm, cycle);
  clock_.attend_to(place_);
  clock_.note_alarm(place_, cycle);
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
  start(hertz);
}

void Clock::set_frequency(std::uint64_t hertz) {
  scheduler_.synchronise();
  for (ClockListener* listener : listeners_) listener->before_change(*this);
  const std::uint64_t now = scheduler_.now_ps();
  origin_cycle_ = cycle();
  origin_ps_ = now;
  start(hertz);
  ++scheduler_.clock_changes_;
  plan_next(now);
  for (ClockListener* listener : listeners_) listener->after_change(*this);
}

// Edges count from the origin on.
void Clock::start(std::uint64_t hertz) {
  hertz_ = hertz;
  cycle_ps_ = never;
  next_ = {origin_cycle_ + 1, never, 0};
  reach_ps_ = 0;
  if (hertz_ == 0) return;
  period_ps_ = ps_per_second / hertz_;
  period_remainder_ = ps_per_second % hertz_;
  reach_ps_ = (std::uint64_t{1} << 62) / hertz_;
  anchor_ = {origin_cycle_, origin_ps_, hertz_ / 2};
  seek(origin_cycle_ + 1);
}

// Some way before `cycle`, as the next question may be about an earlier time.
void Clock::set_anchor(std::uint64_t cycle) const {
  const std::uint64_t from_origin = cycle - origin_cycle_;
  const std::uint64_t edges = from_origin - std::min(from_origin, anchor_margin);
  const Wide numerator = Wide(edges) * ps_per_second + hertz_ / 2;
  anchor_ = {origin_cycle_ + edges, origin_ps_ + static_cast<std::uint64_t>(numerator / hertz_),
             static_cast<std::uint64_t>(numerator % hertz_)};
}

// The first edge at or after `ps`, which is past the origin, counted from an anchor near it.
inline std::uint64_t Clock::edges_from_anchor(std::uint64_t ps) const {
  if (ps - anchor_.ps > reach_ps_) {
    // The edge looked for or the one before.
    set_anchor(origin_cycle_ +
               static_cast<std::uint64_t>(Wide(ps - origin_ps_) * hertz_ / ps_per_second));
  }
  // The smallest n whose edge, n · 10¹² / f + what was cut off, is not before.
  const std::uint64_t distance = (ps - anchor_.ps) * hertz_;
  if (distance <= anchor_.remainder) return 0;
  return (distance - anchor_.remainder + ps_per_second - 1) / ps_per_second;
}

std::uint64_t Clock::cycle_at_or_after(std::uint64_t ps) const {
  if (hertz_ == 0) return never;
  if (ps <= origin_ps_) return origin_cycle_ + 1;
  const std::uint64_t n = edges_from_anchor(ps);
  return std::max(anchor_.cycle + n, origin_cycle_ + 1);
}

std::uint64_t Clock::far_edge_at_or_after(std::uint64_t ps) const {
  if (hertz_ == 0) return never;
  if (ps <= origin_ps_) return exact_edge(origin_cycle_ + 1).ps;
  const std::uint64_t n = edges_from_anchor(ps);
  if (anchor_.cycle + n <= origin_cycle_) return exact_edge(origin_cycle_ + 1).ps;
  const std::uint64_t edge = anchor_.ps + n * period_ps_;
  if (period_remainder_ == 0) return edge;
  return edge + (n * period_remainder_ + anchor_.remainder) / hertz_;
}

std::uint64_t Clock::cycle() const {
  const std::uint64_t now = scheduler_.now_ps();
  if (now == cycle_ps_) return cycle_;
  cycle_ps_ = now;
  // The last edge at or before now.
  cycle_ = hertz_ == 0 || now < origin_ps_ ? origin_cycle_ : cycle_at_or_after(now + 1) - 1;
  return cycle_;
}

std::uint64_t Clock::duration_ps(double cycles) const {
  if (hertz_ == 0) return never;
  return static_cast<std::uint64_t>(
      cycles * static_cast<double>(ps_per_second) / static_cast<double>(hertz_) + 0.5);
}

// exact_edge(next_.cycle + 1) without a division.
inline void Clock::step() {
  ++next_.cycle;
  next_.ps += period_ps_;
  next_.remainder += period_remainder_;
  if (next_.remainder >= hertz_) {
    next_.remainder -= hertz_;
    ++next_.ps;
  }
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
  alarm_place_ = 0;
  others_alarm_ = 0;
}

inline void Clock::run_alarm(std::size_t at) {
  Place& place = places_[at];
  if (place.alarm != cycle_) return;  // it was moved
  place.alarm = never;
  place.module->edge();
}

inline void Clock::go_to_alarm(std::uint64_t cycle) {
  if (cycle == never || hertz_ == 0) {
    next_.ps = never;
  } else {
    seek(cycle);
  }
}

// Nearly always, a clock whose modules sleep runs an edge for the alarm of a single one.
void Clock::run_edge() {
  ++edges_run_;
  in_edge_ = true;
  const std::uint64_t cycle = next_.cycle;
  cycle_ = cycle;
  cycle_ps_ = next_.ps;
  const bool single = awake_ == 0 && others_alarm_ > cycle;
  if (single) {
    const std::size_t place = alarm_place_;
    run_alarm(place);
    const std::uint64_t next = std::min(others_alarm_, places_[alarm_place_].alarm);
    if (awake_ != 0 || next <= cycle) run_attended(place + 1);
  } else {
    run_attended(0);
  }
  in_edge_ = false;
  if (awake_ != 0) {
    if (next_.cycle == cycle) step();
  } else if (places_[alarm_place_].alarm <= others_alarm_) {
    go_to_alarm(places_[alarm_place_].alarm);
  } else {
    seek_alarm();
  }
}

void Clock::run_attended(std::size_t from) {
  for_each_attended(from, [&](std::size_t i) {
    Place& place = places_[i];
    const bool due = place.alarm == cycle_;
    if (due) place.alarm = never;
    if (place.awake || due) place.module->edge();
    if (place.alarm == never && !place.awake) attend_to(i);
  });
}

void Clock::seek_alarm() {
  std::uint64_t first = never;
  others_alarm_ = never;
  for_each_attended(0, [&](std::size_t i) {
    const std::uint64_t alarm = places_[i].alarm;
    others_alarm_ = std::min(others_alarm_, std::max(first, alarm));
    if (alarm < first) {
      first = alarm;
      alarm_place_ = i;
    }
  });
  go_to_alarm(first);
}

// A module woke or set an alarm: the clock runs again from its first edge after `after_ps`.
void Clock::plan_next(std::uint64_t after_ps) {
  // run_edge() plans when all modules have run; an edge of this very instant that is still to come
  // is not passed over.
  if (in_edge_ || next_.ps == after_ps) return;
  if (awake_ > 0 && hertz_ != 0) {
    seek(cycle_at_or_after(after_ps + 1));
  } else {
    seek_alarm();
  }
  scheduler_.reschedule();
}

void Clock::set_order(const std::vector<Clocked*>& modules) {
  std::vector<Place> places;
  for (Clocked* module : modules) {
    places.push_back(places_[module->place_]);
    module->place_ = places.size() - 1;
  }
  places_ = std::move(places);
  attend_to_all();
}

}  // namespace vp
