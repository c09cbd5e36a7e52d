#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include <axi/interfaces.h>
#include <axi/wires.h>
#include <pl/common/rtl_object.h>

namespace axi {

/// A port of RTL, or none: it then reads as a value that the interface gives it, and writes vanish.
class Pin {
 public:
  Pin() = default;
  Pin(void* place, unsigned bits) : place_(place), bits_(bits) {}

  explicit operator bool() const { return place_ != nullptr; }
  unsigned bits() const { return bits_; }
  /// Of up to 64 bits.
  std::uint64_t get(std::uint64_t otherwise = 0) const {
    return place_ ? pl::load_pin(place_, bits_) : otherwise;
  }
  /// Of up to 64 bits; bits that the port lacks are dropped.
  void set(std::uint64_t value) const {
    if (place_)
      pl::store_pin(place_, bits_, bits_ < 64 ? value & ((std::uint64_t{1} << bits_) - 1) : value);
  }
  /// Bits of a port from `low` on: `bits` of them, in a place of their own size (vp::StreamPart).
  Pin part(unsigned low, unsigned bits) const {
    return place_ && low + bits <= bits_ ? Pin(static_cast<unsigned char*>(place_) + low / 8, bits)
                                         : Pin();
  }
  /// Whole bytes, the lowest first.
  void get_bytes(unsigned char* bytes, std::size_t count) const {
    if (place_) copy_bytes(bytes, place_, count);
  }
  void set_bytes(const unsigned char* bytes, std::size_t count) const {
    if (place_) copy_bytes(place_, bytes, count);
  }

 private:
  void* place_ = nullptr;
  unsigned bits_ = 0;
};

/// The pins of a memory-mapped interface of RTL.
class MmPins {
 public:
  /// Throws vp::InputError for widths that are not AXI's.
  MmPins(const Interface& interface, const pl::RtlObject& rtl);

  const Shape& shape() const { return shape_; }
  /// One of its VALIDs is high.
  bool rtl_sends() const {
    if (interface_.slave) return (bvalid_.get() | rvalid_.get()) != 0;
    return (aw_.valid.get() | ar_.valid.get() | wvalid_.get()) != 0;
  }
  /// Takes what the RTL drives. What it leaves out has the defaults of PG059 and PG247.
  void read(Wires& wires) const;
  /// Shows it what it samples.
  void write(const Wires& wires) const;

 private:
  struct AddressPins {
    Pin valid, ready, address, id, length, size, burst, lock, cache, prot, qos, region;
    mutable Address shown;  ///< on the pins, once a request was
    mutable bool any = false;
  };
  AddressPins address_pins(const std::string& prefix) const;
  Pin pin(const std::string& signal) const;
  void find_shape();
  unsigned data_bytes(const std::string& signal) const;
  [[noreturn]] void refuse(const std::string& signal, const std::string& why) const;
  void read_address(const AddressPins& pins, AddressChannel& channel) const;
  void write_address(const AddressPins& pins, const AddressChannel& channel) const;
  void read_data(Wires& wires) const;
  void read_answers(Wires& wires) const;
  void write_answers(const Wires& wires) const;

  const Interface interface_;
  const pl::RtlObject& rtl_;
  AddressPins aw_, ar_;
  Pin wvalid_, wready_, wdata_, wstrb_, wlast_, bvalid_, bready_, bid_, bresp_, rvalid_, rready_,
      rid_, rdata_, rresp_, rlast_;
  Shape shape_;
  unsigned full_size_ = 2;  ///< log2 of the bytes of a word
};

}  // namespace axi
