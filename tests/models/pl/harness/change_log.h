#pragma once

#include <vp/clock_scheduler.h>
#include <vp/signal.h>

#include <cstdint>
#include <ostream>
#include <vector>

namespace harness {

/// A new value of a signal, and when it came.
struct Change {
  std::uint64_t ps;
  std::uint64_t value;
};
inline bool operator==(const Change& a, const Change& b) {
  return a.ps == b.ps && a.value == b.value;
}
inline std::ostream& operator<<(std::ostream& out, const Change& c) {
  return out << c.value << " at " << c.ps << " ps";
}

/// Notes every change of a signal while it lives.
class ChangeLog : public vp::SignalListener {
 public:
  ChangeLog(vp::SignalBase& signal, const vp::ClockScheduler& scheduler)
      : signal_(signal), scheduler_(scheduler) {
    signal_.attach(*this);
  }
  ~ChangeLog() override { signal_.detach(*this); }
  ChangeLog(const ChangeLog&) = delete;
  ChangeLog& operator=(const ChangeLog&) = delete;

  std::vector<Change> changes;

 private:
  void on_change(vp::SignalBase& signal, std::uint32_t) override {
    changes.push_back({scheduler_.now_ps(), signal.bits()});
  }

  vp::SignalBase& signal_;
  const vp::ClockScheduler& scheduler_;
};

}  // namespace harness
