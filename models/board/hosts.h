#pragma once

#include <memory>

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

}  // namespace board
