#include <board/i2c_bus.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace board {

namespace {

constexpr unsigned most_address = 0x7F;

bool is_power_of_two(std::size_t n) {
  return n != 0 && (n & (n - 1)) == 0;
}

}  // namespace

I2cDevice& I2cBus::attach(unsigned address, std::unique_ptr<I2cDevice> device) {
  if (address > most_address) {
    throw std::invalid_argument("an I2C address has 7 bits: " + std::to_string(address) +
                                " is more than 127 (leave the direction bit out)");
  }
  const auto [place, is_new] = devices_.try_emplace(address, std::move(device));
  if (!is_new) {
    throw std::invalid_argument("a device has the I2C address " + std::to_string(address) +
                                " already");
  }
  return *place->second;
}

I2cDevice* I2cBus::find(unsigned address) const {
  const auto found = devices_.find(address);
  return found == devices_.end() ? nullptr : found->second.get();
}

bool I2cBus::start(unsigned address, bool read) {
  I2cDevice* const device = find(address);
  if (selected_ && selected_ != device) selected_->stop();
  selected_ = device;
  if (selected_ && !selected_->start(read)) selected_ = nullptr;
  return selected_ != nullptr;
}

bool I2cBus::write(std::uint8_t byte) {
  return selected_ && selected_->write(byte);
}

std::uint8_t I2cBus::read() {
  return selected_ ? selected_->read() : 0xFF;
}

void I2cBus::stop() {
  if (selected_) selected_->stop();
  selected_ = nullptr;
}

I2cEeprom::I2cEeprom(std::size_t size, std::size_t page) : bytes_(size, 0xFF), page_(page) {
  if (!is_power_of_two(size) || size > 0x1'0000 || !is_power_of_two(page) || page > size) {
    throw std::invalid_argument(
        "an EEPROM has a power of two of bytes, 65536 at most, in pages of a power of two");
  }
}

bool I2cEeprom::start(bool read) {
  if (!read) to_come_ = address_bytes();
  return true;
}

bool I2cEeprom::write(std::uint8_t byte) {
  if (to_come_ > 0) {
    --to_come_;
    place_ = (place_ << 8 | byte) % bytes_.size();
    return true;
  }
  bytes_[place_] = byte;
  place_ = (place_ & ~(page_ - 1)) | ((place_ + 1) & (page_ - 1));
  return true;
}

std::uint8_t I2cEeprom::read() {
  const std::uint8_t byte = bytes_[place_];
  place_ = (place_ + 1) % bytes_.size();
  return byte;
}

I2cRegisterFile::I2cRegisterFile(unsigned index_bytes, unsigned value_bytes)
    : index_bytes_(index_bytes), value_bytes_(value_bytes) {
  if (index_bytes < 1 || index_bytes > 2 || value_bytes < 1 || value_bytes > 2) {
    throw std::invalid_argument("a register file has indices and values of 1 or 2 bytes");
  }
  bytes_.resize((std::size_t{1} << (8 * index_bytes)) * value_bytes);
}

bool I2cRegisterFile::start(bool read) {
  if (!read) to_come_ = index_bytes_;
  return true;
}

bool I2cRegisterFile::write(std::uint8_t byte) {
  const std::size_t registers = bytes_.size() / value_bytes_;
  if (to_come_ > 0) {
    const std::size_t before = to_come_ == index_bytes_ ? 0 : place_ / value_bytes_;
    --to_come_;
    place_ = (before << 8 | byte) % registers * value_bytes_;
    return true;
  }
  bytes_[place_] = byte;
  place_ = (place_ + 1) % bytes_.size();
  return true;
}

std::uint8_t I2cRegisterFile::read() {
  const std::uint8_t byte = bytes_[place_];
  place_ = (place_ + 1) % bytes_.size();
  return byte;
}

}  // namespace board
