#pragma once

#include <boost/test/unit_test.hpp>

#include <cstdint>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <vp/report.h>

#include "bench.h"

/// Two cores, and what their programs share.
namespace bench::two_cores {

using Times = std::vector<std::uint64_t>;
using Log = std::vector<Device::Access>;

/// The word of the boot code answers at once. A start takes a barrier of 20 ns, and the second core
/// runs 100 ns later.
struct TwoCores : Bench {
  explicit TwoCores(const Settings& settings = {}) : Bench(settings) {
    reports.redirect(messages);
    bus.map("boot", 0xFFFF'F000, 0x1000).bind(boot.socket);
    cpu1.n_irq(n_irq1);
    cpu1.m_axi.socket.bind(bus.socket);
  }
  vp::ReportRouter reports;
  std::ostringstream messages;
  Device boot{"boot", scheduler};
  vp::Signal<bool> n_irq1{"n_irq1", 1, true};
  ps::Cpu cpu1{"cpu1", cpu_clock, cpu};

  std::string failure_of(std::function<int()> body) {
    run(std::move(body), false);
    return failure();
  }
};

constexpr std::uint64_t started_ps = 120'000;

inline hal_lock results = {0, "results"}, other = {0, "other"}, nameless = {0, nullptr};
inline volatile std::uint32_t word;
inline volatile bool flag;
inline std::uint32_t count, count1;

/// Locks and words as a program finds them.
struct Fresh {
  Fresh() {
    for (hal_lock* lock : {&results, &other, &nameless}) lock->taken = 0;
    word = count = count1 = 0;
    flag = false;
  }
};

inline void nothing() {}
inline void write_1() {
  hal_write32(device_address, 1);
}
/// 20 ns a look, between events.
inline void await_word() {
  while (hal_load_acquire(&word) == 0) hal_wait_for_event();
}
/// 20 ns for the store, 20 ns for the event.
inline void set_word() {
  hal_store_release(&word, 1);
  hal_send_event();
}

/// Throws and lets time pass while the exception is being handled.
inline void handle(const char* text) {
  for (int i = 0; i < 3; ++i) {
    try {
      throw std::runtime_error(text);
    } catch (const std::exception& error) {
      hal_work(step, 70);
      hal_barrier();
      if (std::string(error.what()) == text) ++count;
    }
  }
}

inline bool says(const std::string& text, const std::string& part) {
  const bool found = text.find(part) != std::string::npos;
  if (!found) BOOST_TEST_MESSAGE("'" + text + "' says nothing of '" + part + "'");
  return found;
}

}  // namespace bench::two_cores
