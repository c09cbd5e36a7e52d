#include <axi/rtl_links.h>

#include <algorithm>
#include <utility>

#include <vp/error.h>

namespace axi {

using vp::bits_per_byte;

SlaveLink::SlaveLink(const Interface& interface, std::size_t clock, const pl::RtlObject& rtl,
                     const vp::Clock& clk, TlmToPins::Begin begin)
    : RtlLink(interface, clock),
      pins_(interface, rtl),
      adapter_(name.c_str(), clk, pins_.shape(), wires_, std::move(begin)),
      checker_(adapter_, clk, pins_.shape(), LinkChecker::Resets::subordinate) {
  pins_.write(wires_);
}

void SlaveLink::sample(bool in_reset) {
  if (adapter_.idle() && !in_reset && checker_.idle() && !pins_.rtl_sends()) return;
  pins_.read(wires_);
  if (watched_) checker_.edge(wires_, in_reset);
  adapter_.sample();
}

bool SlaveLink::drive() {
  if (!busy()) return false;
  adapter_.drive();
  driving_ = wires_.aw.valid || wires_.ar.valid || wires_.w.valid;
  pins_.write(wires_);
  return true;
}

MasterLink::MasterLink(const Interface& interface, std::size_t clock, const pl::RtlObject& rtl,
                       const vp::Clock& clk)
    : RtlLink(interface, clock),
      pins_(interface, rtl),
      adapter_(name.c_str(), clk, pins_.shape(), wires_),
      checker_(adapter_, clk, pins_.shape(), LinkChecker::Resets::manager) {}

void MasterLink::sample(bool in_reset) {
  quiet_ = quiet_ && !in_reset && checker_.idle() && !pins_.rtl_sends();
  if (quiet_) return;
  pins_.read(wires_);
  if (watched_) checker_.edge(wires_, in_reset);
  adapter_.sample();
}

bool MasterLink::drive() {
  if (quiet_) return false;
  const bool ready[] = {wires_.aw.ready, wires_.w.ready, wires_.ar.ready};
  const bool answers = wires_.b.valid || wires_.r.valid;
  adapter_.drive();
  const bool same = ready[0] == wires_.aw.ready && ready[1] == wires_.w.ready &&
                    ready[2] == wires_.ar.ready && !answers && !wires_.b.valid && !wires_.r.valid;
  if (!same) pins_.write(wires_);
  quiet_ = same && adapter_.idle() && wires_.quiet();
  return !same;
}

StreamPins::StreamPins(const Interface& interface, const pl::RtlObject& rtl) {
  const auto pin = [&](const char* signal) -> Pin {
    const auto found = interface.ports.find(signal);
    if (found == interface.ports.end()) return {};
    return {rtl.pin(found->second), rtl.descriptor().ports[found->second].bits};
  };
  const auto refuse = [&](const char* signal, const std::string& why) {
    const RtlPort& port = rtl.descriptor().ports[interface.ports.at(signal)];
    throw vp::InputError(std::string(port.place) + ": port '" + port.name + "' of RTL '" +
                         rtl.file() + "' has " + std::to_string(port.bits) + " bits, and " + why);
  };
  data = pin("tdata");
  valid = pin("tvalid");
  ready = pin("tready");
  last = pin("tlast");
  keep = pin("tkeep");
  strobe = pin("tstrb");
  user = pin("tuser");
  id = pin("tid");
  dest = pin("tdest");
  if (data.bits() % bits_per_byte != 0 || data.bits() > bits_per_byte * vp::most_stream_bytes)
    refuse("tdata", "a stream has whole bytes, 8 to 1024 bits");
  const std::string lanes = std::to_string(data.bits() / bits_per_byte);
  for (const auto& [field, signal] : {std::pair{&keep, "tkeep"}, {&strobe, "tstrb"}}) {
    if (*field && field->bits() != data.bits() / bits_per_byte)
      refuse(signal, "one for each of " + lanes + " bytes is needed");
  }
}

vp::StreamShape StreamPins::shape(const std::string& end) const {
  return {end, data.bits() / bits_per_byte, strobe.bits(), user.bits(), id.bits(), dest.bits()};
}

const Pin& StreamPins::of(vp::StreamField field) const {
  switch (field) {
    case vp::StreamField::data:
      return data;
    case vp::StreamField::keep:
      return keep;
    case vp::StreamField::strobe:
      return strobe;
    case vp::StreamField::user:
      return user;
    case vp::StreamField::id:
      return id;
    case vp::StreamField::dest:
      break;
  }
  return dest;
}

Pin StreamPins::of(const vp::StreamPart& part) const {
  return of(part.field).part(part.low, part.bits);
}

Pin StreamPins::low_data() const {
  return data.part(0, std::min(data.bits(), 32u));
}

Pin StreamPins::low_keep() const {
  return keep.part(0, std::min(keep.bits(), 8u));
}

StreamInLink::StreamInLink(const Interface& interface, std::size_t clock, const pl::RtlObject& rtl,
                           vp::Clocked& side)
    : RtlLink(interface, clock), pins_(interface, rtl), port_(name.c_str(), side) {
  port_.set_shape(pins_.shape(rtl.instance() + "." + name));
}

// What sends no TSTRB has it as TKEEP.
void StreamInLink::connect(const Follow& follow) {
  follow(*port_.tdata.signal(), pins_.low_data());
  follow(*port_.tvalid.signal(), pins_.valid);
  follow(*port_.tlast.signal(), pins_.last);
  follow(*port_.tkeep.signal(), pins_.low_keep());
  auto& parts = port_.link().parts();
  const bool strobes = std::any_of(parts.begin(), parts.end(), [](const auto& one) {
    return one.part.field == vp::StreamField::strobe;
  });
  if (!strobes && pins_.strobe)
    follow(*port_.tkeep.signal(), pins_.strobe.part(0, std::min(pins_.strobe.bits(), 8u)));
  for (auto& [part, wire, reader] : parts) {
    follow(wire, pins_.of(part));
    if (!strobes && part.field == vp::StreamField::keep)
      follow(wire, pins_.strobe.part(part.low, part.bits));
  }
  port_.link().tready.defer_writes();
}

// A receiver without TREADY takes every beat.
void StreamInLink::show_outputs() {
  const bool ready = pins_.ready.get(1) != 0;
  if (ready != port_.tready.written()) port_.tready = ready;
}

StreamOutLink::StreamOutLink(const Interface& interface, std::size_t clock,
                             const pl::RtlObject& rtl, vp::Clocked& side, unsigned packet_beats)
    : RtlLink(interface, clock),
      pins_(interface, rtl),
      low_data_(pins_.low_data()),
      low_keep_(pins_.low_keep()),
      packet_beats_(packet_beats),
      port_(name.c_str(), side) {
  port_.set_shape(pins_.shape(rtl.instance() + "." + name));
}

void StreamOutLink::connect(const Follow& follow) {
  whole_word_ = (1u << std::min(port_.link().bytes(), 8u)) - 1;
  follow(*port_.tready.signal(), pins_.ready);
  vp::AxiStream& link = port_.link();
  link.tdata.defer_writes();
  link.tkeep.defer_writes();
  link.tvalid.defer_writes();
  link.tlast.defer_writes();
  for (auto& [part, wire, reader] : link.parts()) {
    const Pin pin = pins_.of(part);
    if (!pin) continue;  // TKEEP that the RTL does not have
    wire.defer_writes();
    parts_.push_back({pin, &wire, wire.get()});
  }
}

void StreamOutLink::sample(bool) {
  if (!port_.accepted()) return;
  beat_ = last() ? 0 : beat_ + 1;
}

void StreamOutLink::show_outputs() {
  if (pins_.valid.get() == 0) {
    if (std::exchange(shown_.valid, false)) port_.withdraw();
    return;
  }
  const Shown now{true, last(), static_cast<std::uint8_t>(low_keep_.get(whole_word_)),
                  static_cast<std::uint32_t>(low_data_.get())};
  const bool same =
      shown_.valid && shown_.data == now.data && shown_.last == now.last && shown_.keep == now.keep;
  if (!same) port_.offer(now.data, now.last, now.keep);
  shown_ = now;
  for (Part& part : parts_) {
    const auto value = static_cast<std::uint32_t>(part.pin.get());
    if (value != part.shown) *part.wire = value;
    part.shown = value;
  }
}

}  // namespace axi
