#include <vp/signal.h>

#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <algorithm>

namespace vp {

SignalBase::SignalBase(const char* name) : sc_core::sc_object(name) {}

void SignalBase::attach(SignalListener& listener, std::uint32_t id) {
  listeners_.push_back({&listener, id});
  observed_ = true;
}

void SignalBase::detach(SignalListener& listener) {
  listeners_.erase(std::remove_if(listeners_.begin(), listeners_.end(),
                                  [&](const Listener& l) { return l.listener == &listener; }),
                   listeners_.end());
  observed_ = deferred_ || has_events_ || !listeners_.empty();
}

void SignalBase::changed() {
  for (std::size_t i = 0; i < listeners_.size(); ++i) {
    listeners_[i].listener->on_change(*this, listeners_[i].id);
  }
  change_stamp_ = ClockScheduler::kernel_delta() + 1;
  if (has_events_) notify_events();
}

void SignalBase::notify_events() {
  if (events_[any_change]) notify(*events_[any_change]);
  const EventKind edge = bits() != 0 ? rising : falling;
  if (events_[edge]) notify(*events_[edge]);
}

void SignalBase::notify(sc_core::sc_event& event) {
  if (scheduler_) {
    scheduler_->notify(event);
  } else {
    event.notify(sc_core::SC_ZERO_TIME);
  }
}

void SignalBase::defer() {
  queued_ = true;
  if (scheduler_ && scheduler_->running_) {
    scheduler_->defer(*this);
  } else {
    commit();  // written by a process: no edge of this instant is still to come
  }
}

Clocked* SignalBase::writer() const {
  if (writer_) return writer_;
  for (sc_core::sc_object* o = get_parent_object(); o; o = o->get_parent_object()) {
    if (auto* module = dynamic_cast<Clocked*>(o)) return module;
  }
  return nullptr;
}

sc_core::sc_event& SignalBase::event_of(EventKind kind) const {
  if (!events_[kind]) {
    events_[kind] = std::make_unique<sc_core::sc_event>();
    observed_ = has_events_ = true;
  }
  return *events_[kind];
}

InBase::InBase(const char* name, Clocked* owner) : name_(name), owner_(owner) {
  if (owner_) owner_->inputs_.push_back(this);
}

}  // namespace vp
