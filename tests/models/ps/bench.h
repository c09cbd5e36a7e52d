#pragma once

#include <hal/hal.h>
#include <simulation.h>

#include <ps/cpu/cpu.h>
#include <tlm_utils/simple_target_socket.h>
#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/router.h>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bench {

/// Units of work, functions and options of every program here.
enum Work : std::uint32_t { step, load };
enum Function : std::uint32_t { outer, inner, dispatch };

/// One cycle; 2.5 cycles and a stall of 3 ns.
ps::CostTable costs();

/// A hal_program whose entry is `body`.
const hal_program& program(std::function<int()> body);

/// A register at every address. Logs what reaches it.
class Device : public sc_core::sc_module {
 public:
  Device(sc_core::sc_module_name name, vp::ClockScheduler& scheduler);

  struct Access {
    bool write;
    std::uint64_t address;
    std::uint32_t value;
    std::uint64_t ps;
    bool operator==(const Access& o) const {
      return write == o.write && address == o.address && value == o.value && ps == o.ps;
    }
  };

  tlm_utils::simple_target_socket<Device> socket;
  std::vector<Access> log;
  std::uint64_t delay_ps = 0;  ///< added to `delay`
  std::uint64_t wait_ps = 0;   ///< waited before the access
  tlm::tlm_response_status status = tlm::TLM_OK_RESPONSE;
  std::function<std::uint32_t(std::uint64_t ps)> value = [](std::uint64_t) { return 0u; };
  std::function<void(std::uint32_t)> written = [](std::uint32_t) {};

  std::vector<std::uint64_t> times() const;

 private:
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);

  vp::ClockScheduler& scheduler_;
};

/// The times at which a signal changed, in ps.
template <class T>
class Changes : public vp::SignalListener {
 public:
  Changes(vp::Signal<T>& signal, const vp::ClockScheduler& scheduler) : scheduler_(scheduler) {
    signal.attach(*this);
  }
  void on_change(vp::SignalBase& signal, std::uint32_t) override {
    times.push_back(scheduler_.now_ps());
    values.push_back(signal.bits());
  }
  std::vector<std::uint64_t> times, values;

 private:
  const vp::ClockScheduler& scheduler_;
};

std::ostream& operator<<(std::ostream& out, const Device::Access& access);

/// Settings of a simulation, in force while it is built.
using Settings = std::vector<std::string>;

/// A CPU of 1 GHz at a bus with one device from 0x4000'0000 on, and a wire for interrupts.
class Bench : public kit::Simulation {
 public:
  explicit Bench(const Settings& settings = {}, std::uint64_t cpu_hertz = 1'000'000'000);

 private:
  vp::Configuration configuration_;
  std::optional<vp::Configuration::Scope> scope_;

 public:
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock cpu_clock;
  vp::Clock pl_clock{"pl_clock", scheduler, 100'000'000};
  vp::Signal<bool> n_irq{"n_irq", 1, true};
  ps::Cpu cpu{"cpu", cpu_clock};
  vp::Router bus{"bus"};
  Device device{"device", scheduler};

  /// Runs `body` as program until it ends. `rethrow`: throws what ended it.
  void run(std::function<int()> body, bool rethrow = true);
  /// Writes n_irq at a time, from a process of its own.
  void set_n_irq_at(std::uint64_t ps, bool level);
  /// What ended the program that run() was told not to throw; "" if nothing.
  std::string failure() const;

 private:
  std::unique_ptr<ps::Program> program_;
};

/// The present time of the simulation built last, in ps. SystemC's own may lag behind.
std::uint64_t now_ps();

constexpr std::uint32_t device_address = 0x4000'0000;

}  // namespace bench
