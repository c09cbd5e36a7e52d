#include "bench.h"

#include <ostream>

namespace bench {

namespace {

std::function<int()> current_body;
const vp::ClockScheduler* current_scheduler;

int entry() {
  return current_body();
}

constexpr const char* work_names[] = {"step", "load"};
constexpr const char* function_names[] = {"outer", "inner", "dispatch"};
constexpr hal_option_info options[] = {{"margin", "px", 4.0, 0.0, 20.0, "a number"},
                                       {"table", "file", 0.0, 0.0, 1.0, "what a user brings"}};
constexpr hal_program description{HAL_ABI,        "bench", entry,   work_names, 2,
                                  function_names, 3,       options, 2};

}  // namespace

std::uint64_t now_ps() {
  return current_scheduler->now_ps();
}

ps::CostTable costs() {
  ps::CostTable table("test");
  table.set("step", {1.0, 0.0});
  table.set("load", {2.5, 3.0});
  return table;
}

const hal_program& program(std::function<int()> body) {
  current_body = std::move(body);
  return description;
}

Device::Device(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
    : sc_module(name), socket("socket"), scheduler_(scheduler) {
  socket.register_b_transport(this, &Device::b_transport);
}

void Device::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  scheduler_.pass_until(scheduler_.now_ps() + wait_ps);
  const std::uint64_t ps = scheduler_.now_ps() + delay.value();
  auto* word = reinterpret_cast<std::uint32_t*>(payload.get_data_ptr());
  if (payload.is_read()) *word = value(ps);
  log.push_back({payload.is_write(), payload.get_address(), *word, ps});
  if (payload.is_write()) written(*word);
  delay += vp::from_ps(delay_ps);
  payload.set_response_status(status);
}

std::vector<std::uint64_t> Device::times() const {
  std::vector<std::uint64_t> times;
  for (const Access& access : log) times.push_back(access.ps);
  return times;
}

std::ostream& operator<<(std::ostream& out, const Device::Access& access) {
  return out << (access.write ? "write " : "read ") << access.address << " = " << access.value
             << " at " << access.ps;
}

Bench::Bench(const Settings& settings, std::uint64_t cpu_hertz)
    : scope_((
          [&] {
            for (const std::string& setting : settings) configuration_.set(setting);
          }(),
          configuration_)),
      cpu_clock("cpu_clock", scheduler, cpu_hertz) {
  current_scheduler = &scheduler;
  cpu.n_irq(n_irq);
  cpu.m_axi.socket.bind(bus.socket);
  bus.map("device", device_address, 0x1000).bind(device.socket);
  configuration_.check_unused();
}

void Bench::run(std::function<int()> body, bool rethrow) {
  program_ = ps::Program::linked(program(std::move(body)));
  cpu.load(*program_, costs());
  sc_core::sc_start();
  if (rethrow) cpu.check();
}

void Bench::set_n_irq_at(std::uint64_t ps, bool level) {
  sc_core::sc_spawn([this, ps, level] {
    sc_core::wait(vp::from_ps(ps));
    n_irq = level;
  });
}

std::string Bench::failure() const {
  try {
    cpu.check();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace bench
