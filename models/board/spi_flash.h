#pragma once

#include <cstdint>
#include <vector>

namespace board {

/// A device at an SPI bus, byte by byte.
class SpiDevice {
 public:
  virtual ~SpiDevice() = default;
  /// Its chip select falls (true) or rises.
  virtual void select(bool selected) = 0;
  /// A byte goes in while another comes out.
  virtual std::uint8_t exchange(std::uint8_t byte) = 0;
};

/// A serial NOR flash of 3 address bytes: read id (0x9F), read (0x03, 0x0B), status (0x05), write
/// enable and disable (0x06, 0x04), page program (0x02), erase of a 4 KiB sector (0x20), of a 64
/// KiB block (0xD8) and of the chip (0xC7). Programming clears bits and erasing sets them; both
/// take `busy_polls` reads of the status.
class SpiFlash : public SpiDevice {
 public:
  /// Bytes of a W25Q32; its id is 0xEF4016.
  static constexpr std::size_t usual_size = 4u << 20;
  static constexpr unsigned busy_polls = 2;

  /// `size`: a power of two from 64 KiB to 16 MiB. Throws std::invalid_argument.
  explicit SpiFlash(std::size_t size = usual_size);

  void select(bool selected) override;
  std::uint8_t exchange(std::uint8_t byte) override;

  /// For loading and for tests.
  std::vector<std::uint8_t>& contents() { return bytes_; }

 private:
  std::uint8_t answer(std::uint8_t byte);
  std::uint8_t status();
  std::uint8_t identity(std::size_t index) const;
  void command(std::uint8_t byte);
  void erase(std::size_t size);

  std::vector<std::uint8_t> bytes_;
  bool selected_ = false;
  bool may_write_ = false;
  unsigned busy_ = 0;      ///< reads of the status until it is ready
  std::size_t count_ = 0;  ///< bytes since it was selected
  std::uint8_t command_ = 0;
  std::size_t address_ = 0;
  std::vector<std::uint8_t> page_;  ///< to be programmed
};

}  // namespace board
