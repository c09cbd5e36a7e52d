#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include <board/i2c_bus.h>
#include <board/spi_flash.h>

namespace board {

/// A controller of an I2C bus, of the processing system or the PL: what its module derives from,
/// besides, so that a test finds the bus by the controller's name.
class I2cHost {
 public:
  virtual ~I2cHost() = default;
  virtual I2cBus& i2c_bus() = 0;
};

/// The same for SPI.
class SpiHost {
 public:
  virtual ~SpiHost() = default;
  /// Wires a device to select `slave`. Throws std::out_of_range for one that the controller does
  /// not have.
  virtual void attach(unsigned slave, std::shared_ptr<SpiDevice> device) = 0;
};

/// The same for a serial line.
class SerialHost {
 public:
  virtual ~SerialHost() = default;
  /// Called with each byte when its last bit has left. May be null.
  std::function<void(std::uint8_t)> on_transmit;
  /// Bytes that the other end sends, one after the other, from now on.
  virtual void receive(std::string_view bytes) = 0;
};

/// The same for an analogue converter.
class AnalogueHost {
 public:
  virtual ~AnalogueHost() = default;
  /// Sets an input, as Xadc::set().
  virtual void set_input(unsigned channel, double value) = 0;
};

}  // namespace board
