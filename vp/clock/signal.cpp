#include <vp/signal.h>

#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <algorithm>
#include <stdexcept>
#include <string>

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
  observed_ = deferred_ || shown_to_systemc_ || force_ || !listeners_.empty();
}

void SignalBase::force(SignalForce* force) {
  if (force && force_) throw std::logic_error(std::string(name()) + ": it is forced already");
  if (force) forced_anew();
  force_ = force;
  if (force_) observed_ = true;
}

void SignalBase::changed() {
  for (std::size_t i = 0; i < listeners_.size(); ++i) {
    listeners_[i].listener->on_change(*this, listeners_[i].id);
  }
  if (!shown_to_systemc_) return;
  if (scheduler_) {
    scheduler_->show_later(*this);
  } else {
    update_shown();  // before the simulation
  }
}

void SignalBase::show_to_systemc() const {
  if (shown_to_systemc_) return;
  show();
  observed_ = shown_to_systemc_ = true;
}

// In SystemC's update phase: the events come with the next delta cycle.
void SignalBase::update_shown() {
  if (!show()) return;
  change_stamp_ = ClockScheduler::kernel_delta() + 1;
  for (const EventKind kind : {any_change, bits() != 0 ? rising : falling}) {
    if (events_[kind]) events_[kind]->notify(sc_core::SC_ZERO_TIME);
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
    show_to_systemc();
  }
  return *events_[kind];
}

InBase::InBase(const char* name, Clocked* owner) : name_(name), owner_(owner) {
  if (owner_) owner_->inputs_.push_back(this);
}

std::string InBase::follower_name() const {
  return (owner_ ? std::string(owner_->basename()) + "_" : "") + name_;
}

}  // namespace vp
