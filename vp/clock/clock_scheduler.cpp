#include <vp/clock_scheduler.h>

#include <vp/ip.h>
#include <vp/report.h>
#include <vp/systemc_pins.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <utility>

#include <cxxabi.h>

namespace vp {

namespace {

/// Bounds a batch when nothing else is planned, so that the kernel gets a say now and then.
constexpr std::uint64_t longest_batch_ps = 1'000'000'000;

/// Exceptions that a process is handling while it waits. The C++ runtime keeps them for a thread of
/// the host, of which all processes are part.
class ExceptionsInFlight {
 public:
  ExceptionsInFlight() { std::swap(*current(), own_); }
  ~ExceptionsInFlight() { std::swap(*current(), own_); }
  ExceptionsInFlight(const ExceptionsInFlight&) = delete;
  ExceptionsInFlight& operator=(const ExceptionsInFlight&) = delete;

 private:
  /// Itanium C++ ABI, 2.2.2.
  struct Globals {
    void* caught = nullptr;
    unsigned uncaught = 0;
  };
  static Globals* current() { return reinterpret_cast<Globals*>(abi::__cxa_get_globals()); }

  Globals own_;
};

}  // namespace

ClockScheduler::ClockScheduler(sc_core::sc_module_name name) : sc_module(name) {
  SC_HAS_PROCESS(ClockScheduler);
  SC_METHOD(run);
  sensitive << wake_up_;
  dont_initialize();
  SC_METHOD(show_signals);
  sensitive << stale_signals_;
  dont_initialize();
}

void ClockScheduler::start_of_simulation() {
  for (SignalBase* signal : all_objects<SignalBase>()) signal->set_scheduler(*this);
  // Foreign modules take part.
  keeps_pace_ = !all_objects<ClockPin>().empty() || !all_objects<FollowerBase>().empty();
  order_clocks();
  order_modules();
  mark_deferred_signals();
  std::copy_if(clocks_.begin(), clocks_.end(), std::back_inserter(ticking_),
               [](const Clock* clock) { return !clock->places_.empty(); });
  for (std::size_t i = 0; i < ticking_.size(); ++i) {
    ticking_[i]->number_ = i;
    edges_.push(Clock::never);
  }
  started_ = true;
  for (Clock* clock : ticking_) clock->plan_next(0);
}

inline void ClockScheduler::run_edge_of(std::size_t clock) {
  ticking_[clock]->run_edge();
  edges_.set(clock, ticking_[clock]->next_.ps);
}

// Clocks run one after the other; inside one, consumers before producers. So a plain store is seen
// by the next edge only, as from a register.
void ClockScheduler::run_instant(std::uint64_t ps) {
  instant_ps_ = ps;
  std::size_t from = 0;
  if (edges_.others_are_after(ps)) {
    from = edges_.place();
    run_edge_of(from++);
  }
  if (!edges_.others_are_after(ps)) run_edges(from, ps);
  if (!deferred_.empty()) commit_deferred();
  for (InstantObserver* observer : observers_) observer->end_of_instant(ps);
  next_ps_ = edges_.time();
}

void ClockScheduler::run_edges(std::size_t from, std::uint64_t ps) {
  for (std::size_t i = from; i < ticking_.size(); ++i) {
    if (edges_[i] == ps) run_edge_of(i);
  }
}

void ClockScheduler::commit_deferred() {
  for (std::size_t i = 0; i < deferred_.size(); ++i) deferred_[i]->commit();
  deferred_.clear();
}

bool ClockScheduler::has_more(std::uint64_t ps) const {
  if (next_ps_ < ps) return true;
  if (!sc_core::sc_pending_activity()) return false;
  return ps == Clock::never ||
         to_ps(sc_core::sc_time_stamp() + sc_core::sc_time_to_pending_activity()) < ps;
}

void ClockScheduler::run_due_instants() {
  if (running_) return;
  const std::uint64_t now = now_ps();
  running_ = true;
  while (next_ps_ <= now) run_instant(next_ps_);
  running_ = false;
}

void ClockScheduler::run() {
  synchronise();
  const std::uint64_t now = kernel_ps();
  if (batch_ && !keeps_pace_) {
    const sc_core::sc_time pending =
        sc_core::sc_time_to_pending_activity(sc_core::sc_get_curr_simcontext());
    const std::uint64_t horizon = now + std::min(to_ps(pending), longest_batch_ps);
    running_ = true;
    stop_batch_ = false;
    while (next_ps_ <= horizon && next_ps_ != Clock::never && !stop_batch_) run_instant(next_ps_);
    running_ = false;
  }
  plan_wake_up();
}

// What happens at the time of an event may come before or after it: that is left to the kernel.
inline std::uint64_t ClockScheduler::find_horizon() {
  const std::uint64_t known = known_horizon();
  return known != 0 ? known : look_for_horizon();
}

std::uint64_t ClockScheduler::look_for_horizon() {
  // Our own wake-up is no reason to stop: its edges are run here.
  wake_up_.cancel();
  const std::uint64_t pending =
      to_ps(sc_core::sc_time_to_pending_activity(sc_core::sc_get_curr_simcontext()));
  horizon_delta_ = kernel_delta();
  const std::uint64_t lookahead = keeps_pace_ ? 0 : lookahead_ps_;
  horizon_ps_ = kernel_ps() + std::min(pending == 0 ? 0 : pending - 1, lookahead);
  return horizon_ps_;
}

void ClockScheduler::pass_instants(std::uint64_t now, std::uint64_t ps, Condition condition,
                                   const void* context) {
  while (true) {
    const std::uint64_t reachable = std::max(now, std::min(ps, find_horizon()));
    const Ahead end = run_ahead(reachable, condition, context);
    if (end == Ahead::met || (end == Ahead::reached && reachable == ps) || now_ps() >= ps) return;
    wait_in_kernel(ps - kernel_ps(), condition, context);
    if (condition && condition(context)) return;
    now = now_ps();
    if (now >= ps) return;
  }
}

bool ClockScheduler::run_ahead_until(std::uint64_t ps, Condition condition, const void* context) {
  const std::uint64_t reachable = std::max(now_ps(), std::min(ps, find_horizon()));
  return run_ahead(reachable, condition, context) == Ahead::met;
}

void ClockScheduler::wait_in_kernel(std::uint64_t ps, Condition condition, const void* context) {
  plan_wake_up();
  const ExceptionsInFlight exceptions;
  if (!condition) {
    sc_core::wait(from_ps(ps));
  } else {
    const std::pair<Condition, const void*> waiter{condition, context};
    waiting_.push_back(waiter);
    sc_core::wait(from_ps(ps), condition_met_);
    waiting_.erase(std::find(waiting_.begin(), waiting_.end(), waiter));
  }
  synchronise();
  if (last_.valid() && last_ == sc_core::sc_get_current_process_handle()) let_others_go_first();
  ReportRouter::software_goes_on();
}

// An edge of this time wakes a process one delta cycle later.
void ClockScheduler::let_others_go_first() {
  rejoin();
  for (unsigned delta = 0; delta < 2; ++delta) sc_core::wait(sc_core::SC_ZERO_TIME);
  synchronise();
}

// Wakes all that wait for a condition; those whose condition does not hold keep waiting.
void ClockScheduler::check_condition() {
  for (const auto& [condition, context] : waiting_) {
    if (condition(context)) {
      notify(condition_met_);
      return;
    }
  }
}

// Stops where a condition holds, and where an edge notified a SystemC event: the kernel has its
// turn then.
ClockScheduler::Ahead ClockScheduler::run_ahead(std::uint64_t ps, Condition condition,
                                                const void* context) {
  Ahead end = Ahead::reached;
  running_ = true;
  stop_batch_ = false;
  while (next_ps_ <= ps && end == Ahead::reached) {
    run_instant(next_ps_);
    if (condition && condition(context)) {
      end = Ahead::met;
    } else if (stop_batch_) {
      end = Ahead::stopped;
    }
  }
  running_ = false;
  if (end == Ahead::reached) instant_ps_ = std::max(instant_ps_, ps);
  return end;
}

void ClockScheduler::rejoin() {
  if (instant_ps_ > kernel_ps()) {
    plan_wake_up();
    sc_core::wait(from_ps(instant_ps_ - kernel_ps()));
    ReportRouter::software_goes_on();
  }
}

void ClockScheduler::plan_wake_up() {
  forget_horizon();
  if (next_ps_ == Clock::never) return;
  const std::uint64_t now = kernel_ps();
  wake_up_.notify(from_ps(next_ps_ > now ? next_ps_ - now : 0));
}

void ClockScheduler::notify(sc_core::sc_event& event) {
  stop_batch_ = true;
  forget_horizon();
  event.notify(from_ps(now_ps() - kernel_ps()));
}

void ClockScheduler::show_later(SignalBase& signal) {
  stale_.push_back(&signal);
  notify(stale_signals_);
}

// Processes on a clock's pin run one delta cycle after its edge: they are let pass first.
void ClockScheduler::show_signals() {
  if (sampled_) {
    show_update_.request_update();
  } else {
    next_trigger(sc_core::SC_ZERO_TIME);
  }
  sampled_ = !sampled_;
}

void ClockScheduler::ShowUpdate::update() {
  for (SignalBase* signal : scheduler_.stale_) signal->update_shown();
  scheduler_.stale_.clear();
}

// Keeps the order in which clocks were made wherever no statement is against it.
void ClockScheduler::order_clocks() {
  std::vector<Clock*> left = std::move(clocks_);
  clocks_.clear();
  while (!left.empty()) {
    const auto free = std::find_if(left.begin(), left.end(), [&](const Clock* clock) {
      return std::none_of(precedences_.begin(), precedences_.end(), [&](const auto& precedence) {
        return precedence.second == clock &&
               std::find(left.begin(), left.end(), precedence.first) != left.end();
      });
    });
    if (free == left.end()) {
      throw std::logic_error(std::string(left.front()->name()) +
                             " is to run before itself at coincident edges: look at the calls of "
                             "ClockScheduler::run_before()");
    }
    clocks_.push_back(*free);
    left.erase(free);
  }
}

void ClockScheduler::add_observer(InstantObserver& observer) {
  observers_.push_back(&observer);
}

void ClockScheduler::remove_observer(InstantObserver& observer) {
  observers_.erase(std::remove(observers_.begin(), observers_.end(), &observer), observers_.end());
}

// Consumers before producers. A ring is opened where that takes the fewest bits: next comes,
// always, the module of whose outputs the modules behind it read the fewest, of equal ones the one
// made last. What they do read is deferred.
void ClockScheduler::order_modules() {
  for (Clock* clock : clocks_) {
    std::vector<Clocked*> left, order;
    for (const Clock::Place& place : clock->places_) left.insert(left.begin(), place.module);
    while (!left.empty()) {
      auto bits = bits_read(left);
      const auto next = std::min_element(left.begin(), left.end(),
                                         [&](Clocked* a, Clocked* b) { return bits[a] < bits[b]; });
      order.push_back(*next);
      left.erase(next);
    }
    clock->set_order(order);
  }
}

/// Of the outputs of each module, so many bits are read by others of them.
std::unordered_map<const Clocked*, unsigned> ClockScheduler::bits_read(
    const std::vector<Clocked*>& modules) {
  std::unordered_map<const Clocked*, unsigned> bits;
  std::unordered_set<const SignalBase*> seen;
  for (const Clocked* reader : modules) {
    for (const InBase* input : reader->inputs_) {
      const SignalBase* signal = input->signal();
      if (!signal || signal->writer() == reader || !seen.insert(signal).second) continue;
      bits[signal->writer()] += signal->width();
    }
  }
  return bits;
}

void ClockScheduler::mark_deferred_signals() {
  std::unordered_set<const Clocked*> already_run;
  // Walks the running order. A consumer that runs after its producer would see the new value too
  // early, and so would the parts of a module that feeds itself.
  for (Clock* clock : clocks_) {
    for (const Clock::Place& place : clock->places_) {
      const Clocked* module = place.module;
      already_run.insert(module);
      for (const InBase* input : module->inputs_) {
        SignalBase* signal = input->signal();
        if (!signal) continue;
        Clocked* producer = signal->writer();
        if (!producer || !already_run.count(producer)) continue;
        signal->deferred_ = signal->observed_ = true;
      }
    }
  }
}

}  // namespace vp
