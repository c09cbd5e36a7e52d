#include <vp/gated_clock.h>

#include <vp/clock_scheduler.h>

namespace vp {

GatedClock::GatedClock(const char* name, Clock& source)
    : Clock(name, source.scheduler(), source.frequency_hz()), source_(source) {
  scheduler().run_before(*this, source);
  source.add_listener(*this);
  join(source);
}

void GatedClock::open(bool open) {
  if (open == open_) return;
  open_ = open;
  if (open) {
    join(source_);
  } else {
    halt();
  }
}

// A closed gate knows the new frequency, too.
void GatedClock::after_change(Clock&) {
  join(source_);
  if (!open_) halt();
}

}  // namespace vp
