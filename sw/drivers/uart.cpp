#include <drivers/uart.h>
#include <hal/hal.h>
#include <uart_registers.h>

namespace drivers {
namespace {

constexpr std::uint32_t on = uart::cr::TXEN | uart::cr::RXEN;
constexpr std::uint32_t worst_error_percent = 3;  // as the vendor's driver

struct BaudRate {
  std::uint32_t generator = 0, divider = 0;
  std::uint32_t error;  ///< Hz
};

BaudRate nearest(std::uint32_t clock_hz, std::uint32_t baud) {
  BaudRate best{0, 0, baud};
  for (std::uint32_t divider = uart::smallest_baud_div; divider <= 0xFF; ++divider) {
    const std::uint64_t step = std::uint64_t{baud} * (divider + 1);
    const std::uint64_t generator = (clock_hz + step / 2) / step;
    if (generator == 0 || generator > 0xFFFF) continue;
    const auto given = static_cast<std::uint32_t>(clock_hz / (generator * (divider + 1)));
    const std::uint32_t error = given > baud ? given - baud : baud - given;
    if (error < best.error) best = {static_cast<std::uint32_t>(generator), divider, error};
  }
  return best;
}

}  // namespace

bool Uart::initialise(const UartConfig& config) {
  const BaudRate rate =
      config.baud == 0 ? BaudRate{0, 0, 0} : nearest(config.clock_hz, config.baud);
  if (rate.generator == 0 ||
      std::uint64_t{rate.error} * 100 > std::uint64_t{config.baud} * worst_error_percent) {
    return false;
  }
  base_ = config.base;
  hal_write32(at(uart::CR), uart::cr::TXDIS | uart::cr::RXDIS);
  hal_write32(at(uart::IDR), uart::event::all);
  hal_write32(at(uart::MR), uart::mr::PAR_none);
  hal_write32(at(uart::BAUDGEN), rate.generator);
  hal_write32(at(uart::BAUD_DIV), rate.divider);
  reset();
  hal_write32(at(uart::ISR), uart::event::all);
  return true;
}

bool Uart::try_put(std::uint8_t byte) const {
  if (hal_read32(at(uart::SR)) & uart::sr::TFUL) return false;
  hal_write32(at(uart::FIFO), byte);
  return true;
}

bool Uart::try_get(std::uint8_t& byte) const {
  if (hal_read32(at(uart::SR)) & uart::sr::REMPTY) return false;
  byte = static_cast<std::uint8_t>(hal_read32(at(uart::FIFO)));
  return true;
}

void Uart::write(const void* data, std::size_t size) const {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  for (std::size_t i = 0; i < size; ++i) {
    while (!try_put(bytes[i])) {
    }
  }
}

std::size_t Uart::read(void* data, std::size_t size) const {
  auto* bytes = static_cast<std::uint8_t*>(data);
  std::size_t count = 0;
  while (count < size && try_get(bytes[count])) ++count;
  return count;
}

bool Uart::is_idle() const {
  const std::uint32_t status = hal_read32(at(uart::SR));
  return (status & uart::sr::TEMPTY) && !(status & uart::sr::TACTIVE);
}

void Uart::enable_interrupts(std::uint32_t events, unsigned receive_level) const {
  hal_write32(at(uart::IDR), uart::event::all);
  hal_write32(at(uart::RXWM), receive_level);
  hal_write32(at(uart::IER), events);
}

std::uint32_t Uart::acknowledge() const {
  const std::uint32_t events = hal_read32(at(uart::ISR));
  hal_write32(at(uart::ISR), events);
  return events;
}

void Uart::reset() const {
  hal_write32(at(uart::CR), on | uart::cr::TXRES | uart::cr::RXRES);
}

}  // namespace drivers
