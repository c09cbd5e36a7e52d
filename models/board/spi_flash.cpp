#include <board/spi_flash.h>

#include <stdexcept>

namespace board {

namespace {

constexpr std::size_t page_size = 256, sector_size = 4096, block_size = 0x1'0000;
constexpr std::uint8_t write_in_progress = 1, write_enable_latch = 2;
constexpr std::uint8_t program = 0x02, read_data = 0x03, write_disable = 0x04, read_status = 0x05,
                       write_enable = 0x06, fast_read = 0x0B, erase_sector = 0x20, read_id = 0x9F,
                       erase_chip = 0xC7, erase_block = 0xD8;

}  // namespace

SpiFlash::SpiFlash(std::size_t size) : bytes_(size, 0xFF) {
  if (size < block_size || size > 16u << 20 || (size & (size - 1)) != 0) {
    throw std::invalid_argument("an SPI flash has a power of two of bytes, 64 KiB to 16 MiB");
  }
}

// Program and erase begin when the select rises.
void SpiFlash::select(bool selected) {
  if (selected == selected_) return;
  selected_ = selected;
  if (selected) {
    count_ = 0;
    page_.clear();
    return;
  }
  const bool has_address = count_ >= 4;
  if (!may_write_ || busy_ != 0) return;
  if (command_ == program && has_address && !page_.empty()) {
    const std::size_t page = address_ & ~(page_size - 1);
    for (const std::uint8_t byte : page_) {
      bytes_[page | (address_ & (page_size - 1))] &= byte;
      ++address_;
    }
    busy_ = busy_polls;
  } else if (command_ == erase_chip && count_ == 1) {
    erase(bytes_.size());
  } else if (command_ == erase_sector && has_address) {
    erase(sector_size);
  } else if (command_ == erase_block && has_address) {
    erase(block_size);
  }
  if (busy_ != 0) may_write_ = false;
}

void SpiFlash::erase(std::size_t size) {
  const std::size_t first = address_ & ~(size - 1) & (bytes_.size() - 1);
  for (std::size_t i = 0; i < size; ++i) bytes_[first + i] = 0xFF;
  busy_ = busy_polls;
}

std::uint8_t SpiFlash::exchange(std::uint8_t byte) {
  if (!selected_) return 0xFF;
  const std::uint8_t out = count_ == 0 ? 0xFF : answer(byte);
  if (count_ == 0) command(byte);
  ++count_;
  return out;
}

void SpiFlash::command(std::uint8_t byte) {
  command_ = byte;
  address_ = 0;
  if (busy_ != 0) return;
  if (byte == write_enable) may_write_ = true;
  if (byte == write_disable) may_write_ = false;
}

// While it writes, only the status answers.
std::uint8_t SpiFlash::answer(std::uint8_t byte) {
  if (command_ == read_status) return status();
  if (busy_ != 0) return 0xFF;
  if (command_ == read_id) return identity(count_ - 1);
  if (count_ <= 3) {
    address_ = (address_ << 8 | byte) & (bytes_.size() - 1);
    return 0xFF;
  }
  if (command_ == program) page_.push_back(byte);
  const bool reads = command_ == read_data || (command_ == fast_read && count_ > 4);
  if (!reads) return 0xFF;
  const std::uint8_t out = bytes_[address_];
  address_ = (address_ + 1) & (bytes_.size() - 1);
  return out;
}

std::uint8_t SpiFlash::status() {
  const std::uint8_t bits = static_cast<std::uint8_t>((busy_ != 0 ? write_in_progress : 0) |
                                                      (may_write_ ? write_enable_latch : 0));
  if (busy_ != 0) --busy_;
  return bits;
}

// Winbond's numbers: maker, type, log2 of the size.
std::uint8_t SpiFlash::identity(std::size_t index) const {
  if (index == 0) return 0xEF;
  if (index == 1) return 0x40;
  std::uint8_t log2 = 0;
  while (std::size_t{1} << log2 < bytes_.size()) ++log2;
  return index == 2 ? log2 : 0;
}

}  // namespace board
