#include <chip/system/ps_devices.h>

#include <type_traits>
#include <utility>

#include <devcfg_registers.h>
#include <gem_registers.h>
#include <ps/idle/idle_devices.h>
#include <ps/system_watchdog/system_watchdog.h>
#include <qspi_registers.h>
#include <sdio_registers.h>
#include <system_watchdog_registers.h>
#include <usb_registers.h>

namespace platform {

namespace {

constexpr std::uint64_t page = 0x1000, part_of_page = 0x100;
constexpr std::uint32_t none = 0;  // of a device without interrupt

struct Entry {
  const char* name;
  const char* title;
  std::uint32_t base;
  std::uint64_t size;
  std::uint32_t interrupt;
  PsDevice (*make)(const Entry& entry, vp::ClockScheduler& scheduler, vp::Clock& cpu_1x_clk);
};

template <class Model, class = void>
struct HasIrq : std::false_type {};
template <class Model>
struct HasIrq<Model, std::void_t<decltype(std::declval<Model&>().irq)>> : std::true_type {};

/// A model is made with its clock, or with the scheduler if it has none.
template <class Model>
PsDevice make(const Entry& entry, vp::ClockScheduler& scheduler, vp::Clock& cpu_1x_clk) {
  std::unique_ptr<Model> model;
  if constexpr (std::is_constructible_v<Model, sc_core::sc_module_name, vp::Clock&>) {
    model = std::make_unique<Model>(entry.name, cpu_1x_clk);
  } else {
    model = std::make_unique<Model>(entry.name, scheduler);
  }
  vp::RegisterBank& registers = model->registers;
  vp::Signal<bool>* irq = nullptr;
  if constexpr (HasIrq<Model>::value) irq = &model->irq;
  return {entry.title, entry.base, entry.size, std::move(model), registers, entry.interrupt, irq};
}

constexpr Entry entries[] = {
    {"swdt", "System watchdog", system_watchdog::base, page, system_watchdog::interrupt_id,
     make<ps::SystemWatchdog>},
    {"devcfg", "Device configuration, idle", devcfg::base, part_of_page, devcfg::interrupt_id,
     make<ps::Devcfg>},
    {"qspi", "Quad-SPI, I/O mode", qspi::base, page, qspi::interrupt_id, make<ps::Qspi>},
    {"sdio0", "SDIO without a card", sdio::sd0_base, page, sdio::sd0_interrupt, make<ps::Sdio>},
    {"sdio1", "SDIO without a card", sdio::sd1_base, page, sdio::sd1_interrupt, make<ps::Sdio>},
    {"gem0", "Ethernet without PHY", gem::gem0_base, page, none, make<ps::Gem>},
    {"gem1", "Ethernet without PHY", gem::gem1_base, page, none, make<ps::Gem>},
    {"usb0", "USB without transceiver", usb::usb0_base, page, none, make<ps::Usb>},
    {"usb1", "USB without transceiver", usb::usb1_base, page, none, make<ps::Usb>},
};

}  // namespace

std::vector<PsDevice> make_ps_devices(vp::ClockScheduler& scheduler, vp::Clock& cpu_1x_clk) {
  std::vector<PsDevice> devices;
  for (const Entry& entry : entries) devices.push_back(entry.make(entry, scheduler, cpu_1x_clk));
  return devices;
}

}  // namespace platform
