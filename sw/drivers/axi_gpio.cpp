#include <axi_gpio_registers.h>
#include <drivers/axi_gpio.h>

namespace drivers {

void AxiGpio::initialise(const AxiGpioConfig& config) {
  base_ = config.base;
  hal_write32(base_ + axi_gpio::GPIO_TRI, config.inputs);
}

void AxiGpio::write(std::uint32_t value) const {
  hal_write32(base_ + axi_gpio::GPIO_DATA, value);
}

std::uint32_t AxiGpio::read() const {
  return hal_read32(base_ + axi_gpio::GPIO_DATA);
}

hal_poll_result AxiGpio::poll_until_changed(std::uint32_t previous, std::uint32_t cycles,
                                            std::uint32_t limit) const {
  return hal_poll_until_changed(base_ + axi_gpio::GPIO_DATA, previous, cycles, limit);
}

}  // namespace drivers
