#include <vp/clock_scheduler.h>

#include <algorithm>
#include <iterator>
#include <unordered_set>

namespace vp {

namespace {

/// Bounds a batch when nothing else is planned, so that the kernel gets a say now and then.
constexpr std::uint64_t longest_batch_ps = 1'000'000'000;

/// Tells every signal of the simulation who runs the instants.
void claim_signals(const std::vector<sc_core::sc_object*>& objects, ClockScheduler& scheduler) {
  for (sc_core::sc_object* object : objects) {
    if (auto* signal = dynamic_cast<SignalBase*>(object)) signal->set_scheduler(scheduler);
    claim_signals(object->get_child_objects(), scheduler);
  }
}

/// Puts a module behind every module of its clock that reads its outputs. A ring is entered
/// anywhere: its closing link becomes a deferred signal.
class ConsumerFirstOrder {
 public:
  explicit ConsumerFirstOrder(const std::vector<Clocked*>& modules,
                              const std::vector<std::vector<Clocked*>>& producers)
      : modules_(modules), producers_(producers), visited_(modules.size(), false) {
    for (std::size_t i = 0; i < modules_.size(); ++i) visit(i);
    std::reverse(order_.begin(), order_.end());
  }
  const std::vector<Clocked*>& order() const { return order_; }

 private:
  void visit(std::size_t i) {
    if (visited_[i]) return;
    visited_[i] = true;
    for (Clocked* producer : producers_[i]) {
      const auto at = std::find(modules_.begin(), modules_.end(), producer);
      if (at != modules_.end()) visit(static_cast<std::size_t>(at - modules_.begin()));
    }
    order_.push_back(modules_[i]);
  }

  const std::vector<Clocked*>& modules_;
  const std::vector<std::vector<Clocked*>>& producers_;
  std::vector<bool> visited_;
  std::vector<Clocked*> order_;
};

}  // namespace

ClockScheduler::ClockScheduler(sc_core::sc_module_name name) : sc_module(name) {
  SC_HAS_PROCESS(ClockScheduler);
  SC_METHOD(run);
  sensitive << wake_up_;
  dont_initialize();
}

void ClockScheduler::start_of_simulation() {
  claim_signals(sc_core::sc_get_top_level_objects(), *this);
  order_modules();
  mark_deferred_signals();
  std::copy_if(clocks_.begin(), clocks_.end(), std::back_inserter(ticking_),
               [](const Clock* clock) { return !clock->places_.empty(); });
  started_ = true;
  for (Clock* clock : ticking_) clock->plan_next(0);
  find_next();
}

// Before the simulation starts there is no next instant.
void ClockScheduler::find_next() {
  if (!started_) return;
  std::uint64_t first = Clock::never;
  for (const Clock* clock : ticking_) first = std::min(first, clock->next_.ps);
  next_ps_ = first;
}

// Clocks run in the order in which they were made; inside one, consumers before producers. So a
// plain store is seen by the next edge only, as from a register.
void ClockScheduler::run_instant(std::uint64_t ps) {
  instant_ps_ = ps;
  moved_ = false;
  std::uint64_t next = Clock::never;
  for (Clock* clock : ticking_) {
    if (clock->next_.ps == ps) clock->run_edge();
    next = std::min(next, clock->next_.ps);
  }
  if (!deferred_.empty()) commit_deferred();
  for (InstantObserver* observer : observers_) observer->end_of_instant(ps);
  next_ps_ = next;
  if (moved_) find_next();
}

void ClockScheduler::commit_deferred() {
  for (std::size_t i = 0; i < deferred_.size(); ++i) deferred_[i]->commit();
  deferred_.clear();
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
  if (batch_) {
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
std::uint64_t ClockScheduler::find_horizon() {
  if (const std::uint64_t known = known_horizon()) return known;
  // Our own wake-up is no reason to stop: the edges it stands for are run here.
  wake_up_.cancel();
  const std::uint64_t pending =
      to_ps(sc_core::sc_time_to_pending_activity(sc_core::sc_get_curr_simcontext()));
  horizon_kernel_ps_ = kernel_ps();
  horizon_delta_ = sc_core::sc_delta_count();
  horizon_ps_ = horizon_kernel_ps_ + std::min(pending == 0 ? 0 : pending - 1, lookahead_ps_);
  return horizon_ps_;
}

void ClockScheduler::pass_instants(std::uint64_t ps, Condition condition, const void* context) {
  while (now_ps() < ps) {
    if (run_ahead_until(ps, condition, context) || now_ps() >= ps) return;
    wait_in_kernel(ps - kernel_ps(), condition, context);
    if (condition && condition(context)) return;
  }
}

bool ClockScheduler::run_ahead_until(std::uint64_t ps, Condition condition, const void* context) {
  const std::uint64_t reachable = std::max(now_ps(), std::min(ps, find_horizon()));
  return run_ahead(reachable, condition, context) == Ahead::met;
}

void ClockScheduler::wait_in_kernel(std::uint64_t ps, Condition condition, const void* context) {
  plan_wake_up();
  if (!condition) {
    sc_core::wait(from_ps(ps));
  } else {
    const std::pair<Condition, const void*> waiter{condition, context};
    waiting_.push_back(waiter);
    sc_core::wait(from_ps(ps), condition_met_);
    waiting_.erase(std::find(waiting_.begin(), waiting_.end(), waiter));
  }
  synchronise();
}

// Wakes all who wait for a condition; those whose own does not hold go on waiting.
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
  }
}

// A clock's next edge has moved. Who has run ahead wakes us when it waits.
void ClockScheduler::reschedule() {
  if (running_) {
    moved_ = true;
    return;
  }
  find_next();
  if (instant_ps_ <= kernel_ps()) plan_wake_up();
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

bool ClockScheduler::runs_before(const Clock& first, const Clock& second) const {
  return std::find(clocks_.begin(), clocks_.end(), &first) <
         std::find(clocks_.begin(), clocks_.end(), &second);
}

void ClockScheduler::add_observer(InstantObserver& observer) {
  observers_.push_back(&observer);
}

void ClockScheduler::remove_observer(InstantObserver& observer) {
  observers_.erase(std::remove(observers_.begin(), observers_.end(), &observer), observers_.end());
}

void ClockScheduler::order_modules() {
  for (Clock* clock : clocks_) {
    std::vector<std::vector<Clocked*>> producers;
    std::vector<Clocked*> modules;
    for (const Clock::Place& place : clock->places_) {
      const Clocked* module = place.module;
      modules.push_back(place.module);
      auto& list = producers.emplace_back();
      for (const InBase* input : module->inputs_) {
        if (!input->signal()) continue;
        Clocked* producer = input->signal()->writer();
        if (producer && producer != module) list.push_back(producer);
      }
    }
    clock->set_order(ConsumerFirstOrder(modules, producers).order());
  }
}

void ClockScheduler::mark_deferred_signals() {
  std::unordered_set<const Clocked*> already_run;
  // Walks the running order: a consumer that comes after its producer would see the new value too
  // early.
  for (Clock* clock : clocks_) {
    for (const Clock::Place& place : clock->places_) {
      const Clocked* module = place.module;
      already_run.insert(module);
      for (const InBase* input : module->inputs_) {
        SignalBase* signal = input->signal();
        if (!signal) continue;
        Clocked* producer = signal->writer();
        if (!producer || producer == module || !already_run.count(producer)) continue;
        signal->deferred_ = signal->observed_ = true;
      }
    }
  }
}

}  // namespace vp
