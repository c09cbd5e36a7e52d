#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

/// What is on a board around the chip.
namespace board {

/// A device at an I2C bus, byte by byte.
class I2cDevice {
 public:
  virtual ~I2cDevice() = default;

  /// A start condition with its address. True: it acknowledges.
  virtual bool start(bool read) = 0;
  /// A byte from the master. True: it acknowledges.
  virtual bool write(std::uint8_t byte) = 0;
  /// The next byte for the master.
  virtual std::uint8_t read() = 0;
  /// The transfer is over.
  virtual void stop() {}

  // The contents, for tests: whatever the device stores, by its own numbers.
  virtual std::size_t size() const = 0;
  /// Throws std::out_of_range from size() on.
  virtual std::uint8_t peek(std::size_t address) const = 0;
  virtual void poke(std::size_t address, std::uint8_t byte) = 0;
};

/// An I2C bus with one master: which device answers an address of 7 bits.
class I2cBus {
 public:
  /// Throws std::invalid_argument for an address beyond 0x7F, or one that is in use.
  I2cDevice& attach(unsigned address, std::unique_ptr<I2cDevice> device);
  /// Null if no device has the address.
  I2cDevice* find(unsigned address) const;

  /// A start, or a repeated start, with address and direction. True: a device acknowledged.
  bool start(unsigned address, bool read);
  /// False: no device acknowledged.
  bool write(std::uint8_t byte);
  /// 0xFF, the level of the pull-ups, if no device drives the bus.
  std::uint8_t read();
  void stop();

 private:
  std::map<unsigned, std::unique_ptr<I2cDevice>> devices_;
  I2cDevice* selected_ = nullptr;
};

/// An EEPROM such as a 24C02: the first byte (two for more than 2048 bytes) after the address sets
/// the place; reads count up through all of it, writes stay in a page. It writes in no time.
class I2cEeprom : public I2cDevice {
 public:
  /// `size` and `page` are powers of two. Throws std::invalid_argument.
  explicit I2cEeprom(std::size_t size = 256, std::size_t page = 16);

  bool start(bool read) override;
  bool write(std::uint8_t byte) override;
  std::uint8_t read() override;
  std::size_t size() const override { return bytes_.size(); }
  std::uint8_t peek(std::size_t address) const override { return bytes_.at(address); }
  void poke(std::size_t address, std::uint8_t byte) override { bytes_.at(address) = byte; }

 private:
  unsigned address_bytes() const { return bytes_.size() > 2048 ? 2 : 1; }

  std::vector<std::uint8_t> bytes_;
  std::size_t page_;
  std::size_t place_ = 0;
  unsigned to_come_ = 0;  ///< bytes of the place
};

/// A device with a file of registers, as sensors, codecs and cameras have: the first byte (or two)
/// after the address names the register, and each byte after it goes to the next one.
class I2cRegisterFile : public I2cDevice {
 public:
  /// `index_bytes`: 1 or 2. `value_bytes`: bytes of a register, most significant first; 1 or 2.
  /// Throws std::invalid_argument.
  explicit I2cRegisterFile(unsigned index_bytes = 1, unsigned value_bytes = 1);

  bool start(bool read) override;
  bool write(std::uint8_t byte) override;
  std::uint8_t read() override;
  std::size_t size() const override { return bytes_.size(); }
  std::uint8_t peek(std::size_t address) const override { return bytes_.at(address); }
  void poke(std::size_t address, std::uint8_t byte) override { bytes_.at(address) = byte; }

 private:
  unsigned index_bytes_, value_bytes_;
  std::vector<std::uint8_t> bytes_;
  std::size_t place_ = 0;
  unsigned to_come_ = 0;
};

}  // namespace board
