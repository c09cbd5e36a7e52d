#include <axi/mm_pins.h>

#include <algorithm>
#include <array>
#include <utility>

#include <vp/error.h>

namespace axi {

MmPins::MmPins(const Interface& interface, const pl::RtlObject& rtl)
    : interface_(interface), rtl_(rtl), aw_(address_pins("aw")), ar_(address_pins("ar")) {
  for (const auto& [place, signal] : {std::pair{&wvalid_, "wvalid"},
                                      {&wready_, "wready"},
                                      {&wdata_, "wdata"},
                                      {&wstrb_, "wstrb"},
                                      {&wlast_, "wlast"},
                                      {&bvalid_, "bvalid"},
                                      {&bready_, "bready"},
                                      {&bid_, "bid"},
                                      {&bresp_, "bresp"},
                                      {&rvalid_, "rvalid"},
                                      {&rready_, "rready"},
                                      {&rid_, "rid"},
                                      {&rdata_, "rdata"},
                                      {&rresp_, "rresp"},
                                      {&rlast_, "rlast"}}) {
    *place = pin(signal);
  }
  find_shape();
}

Pin MmPins::pin(const std::string& signal) const {
  const auto found = interface_.ports.find(signal);
  if (found == interface_.ports.end()) return {};
  return {rtl_.pin(found->second), rtl_.descriptor().ports[found->second].bits};
}

MmPins::AddressPins MmPins::address_pins(const std::string& prefix) const {
  const auto of = [&](const char* signal) { return pin(prefix + signal); };
  return {of("valid"), of("ready"), of("addr"), of("id"),  of("len"),    of("size"), of("burst"),
          of("lock"),  of("cache"), of("prot"), of("qos"), of("region"), {},         false};
}

void MmPins::refuse(const std::string& signal, const std::string& why) const {
  const RtlPort& port = rtl_.descriptor().ports[interface_.ports.at(signal)];
  throw vp::InputError(std::string(port.place) + ": port '" + port.name + "' of RTL '" +
                       rtl_.file() + "' has " + std::to_string(port.bits) + " bits: " + why);
}

unsigned MmPins::data_bytes(const std::string& signal) const {
  const unsigned bits = pin(signal).bits();
  const bool power_of_two = (bits & (bits - 1)) == 0;
  if (interface_.kind == Kind::axi_lite && bits != 32 && bits != 64)
    refuse(signal, "AXI4-Lite has data of 32 or 64");
  if (!power_of_two || bits < 32 || bits > 8 * most_data_bytes)
    refuse(signal, "AXI4 has data of 32, 64, 128, 256, 512 or 1024");
  return bits / 8;
}

void MmPins::find_shape() {
  shape_.lite = interface_.kind == Kind::axi_lite;
  shape_.writes = static_cast<bool>(aw_.valid);
  shape_.reads = static_cast<bool>(ar_.valid);
  shape_.data_bytes = data_bytes(shape_.writes ? "wdata" : "rdata");
  if (shape_.reads && shape_.writes && rdata_.bits() != wdata_.bits())
    refuse("rdata", "its write data have " + std::to_string(wdata_.bits()));
  if (wstrb_ && wstrb_.bits() != shape_.data_bytes)
    refuse("wstrb", "one for each of " + std::to_string(shape_.data_bytes) + " bytes is needed");
  const Pin& address = shape_.writes ? aw_.address : ar_.address;
  shape_.address_bits = std::max(address.bits(), ar_.address.bits());
  if (shape_.address_bits > 64)
    refuse(shape_.writes ? "awaddr" : "araddr", "an address has 64 at most");
  const Pin& length = shape_.writes ? aw_.length : ar_.length;
  shape_.burst_beats =
      shape_.lite || !length ? 1 : std::min(256u, 1u << std::min(length.bits(), 8u));
  while (1u << full_size_ < shape_.data_bytes) ++full_size_;
}

void MmPins::read_address(const AddressPins& pins, AddressChannel& channel) const {
  channel.valid = pins.valid.get() != 0;
  if (!channel.valid) return;
  Address& a = channel.beat;
  a.address = pins.address.get();
  a.id = static_cast<std::uint32_t>(pins.id.get());
  a.beats = static_cast<unsigned>(pins.length.get()) + 1;
  a.size = static_cast<unsigned>(pins.size.get(full_size_));
  a.burst = static_cast<BurstType>(pins.burst.get(static_cast<unsigned>(BurstType::incr)));
  a.lock = (pins.lock.get() & 1) != 0;
  a.cache = static_cast<std::uint8_t>(pins.cache.get());
  a.prot = static_cast<std::uint8_t>(pins.prot.get());
  a.qos = static_cast<std::uint8_t>(pins.qos.get());
  a.region = static_cast<std::uint8_t>(pins.region.get());
}

void MmPins::write_address(const AddressPins& pins, const AddressChannel& channel) const {
  pins.valid.set(channel.valid);
  if (!channel.valid) return;
  const Address& a = channel.beat;
  if (std::exchange(pins.any, true) && pins.shown == a) return;
  pins.shown = a;
  pins.address.set(a.address);
  pins.id.set(a.id);
  pins.length.set(a.beats - 1);
  pins.size.set(a.size);
  pins.burst.set(static_cast<unsigned>(a.burst));
  pins.lock.set(a.lock);
  pins.cache.set(a.cache);
  pins.prot.set(a.prot);
  pins.qos.set(a.qos);
  pins.region.set(a.region);
}

void MmPins::read(Wires& wires) const {
  if (interface_.slave) return read_answers(wires);
  read_address(aw_, wires.aw);
  read_address(ar_, wires.ar);
  read_data(wires);
  wires.b.ready = bready_.get() != 0;
  wires.r.ready = rready_.get() != 0;
}

void MmPins::read_data(Wires& wires) const {
  wires.w.valid = wvalid_.get() != 0;
  if (!wires.w.valid) return;
  wdata_.get_bytes(wires.w.data.data(), shape_.data_bytes);
  // Without WLAST each beat is a burst of its own.
  wires.w.last = wlast_.get(1) != 0;
  if (!wstrb_) {
    wires.w.strobes.set();
  } else if (shape_.data_bytes <= 64) {
    wires.w.strobes = Strobes(wstrb_.get());
  } else {
    std::array<std::uint64_t, 2> halves{};
    wstrb_.get_bytes(reinterpret_cast<unsigned char*>(halves.data()), sizeof halves);
    wires.w.strobes = Strobes(halves[1]) << 64 | Strobes(halves[0]);
  }
}

void MmPins::read_answers(Wires& wires) const {
  wires.aw.ready = aw_.ready.get() != 0;
  wires.ar.ready = ar_.ready.get() != 0;
  wires.w.ready = wready_.get() != 0;
  wires.b.valid = bvalid_.get() != 0;
  if (wires.b.valid) {
    wires.b.id = static_cast<std::uint32_t>(bid_.get());
    wires.b.response = static_cast<Response>(bresp_.get() & 3);
  }
  wires.r.valid = rvalid_.get() != 0;
  if (!wires.r.valid) return;
  rdata_.get_bytes(wires.r.data.data(), shape_.data_bytes);
  wires.r.id = static_cast<std::uint32_t>(rid_.get());
  wires.r.response = static_cast<Response>(rresp_.get() & 3);
  wires.r.last = rlast_.get(1) != 0;
}

void MmPins::write(const Wires& wires) const {
  if (!interface_.slave) return write_answers(wires);
  write_address(aw_, wires.aw);
  write_address(ar_, wires.ar);
  bready_.set(wires.b.ready);
  rready_.set(wires.r.ready);
  wvalid_.set(wires.w.valid);
  if (!wires.w.valid) return;
  wdata_.set_bytes(wires.w.data.data(), shape_.data_bytes);
  wlast_.set(wires.w.last);
  if (shape_.data_bytes <= 64) {
    wstrb_.set((wires.w.strobes & Strobes(~std::uint64_t{0})).to_ullong());
  } else {
    const std::array<std::uint64_t, 2> halves{
        (wires.w.strobes & Strobes(~std::uint64_t{0})).to_ullong(),
        (wires.w.strobes >> 64).to_ullong()};
    wstrb_.set_bytes(reinterpret_cast<const unsigned char*>(halves.data()), sizeof halves);
  }
}

void MmPins::write_answers(const Wires& wires) const {
  aw_.ready.set(wires.aw.ready);
  ar_.ready.set(wires.ar.ready);
  wready_.set(wires.w.ready);
  bvalid_.set(wires.b.valid);
  if (wires.b.valid) {
    bid_.set(wires.b.id);
    bresp_.set(static_cast<unsigned>(wires.b.response));
  }
  rvalid_.set(wires.r.valid);
  if (!wires.r.valid) return;
  rdata_.set_bytes(wires.r.data.data(), shape_.data_bytes);
  rid_.set(wires.r.id);
  rresp_.set(static_cast<unsigned>(wires.r.response));
  rlast_.set(wires.r.last);
}

}  // namespace axi
