#include <axi/rtl_links.h>

#include <utility>

#include <vp/error.h>
#include <vp/stream_checker.h>

namespace axi {

SlaveLink::SlaveLink(const Interface& interface, std::size_t clock, const pl::RtlObject& rtl,
                     const vp::Clock& clk, TlmToPins::Begin begin)
    : RtlLink(interface, clock),
      pins_(interface, rtl),
      adapter_(name.c_str(), clk, pins_.shape(), wires_, std::move(begin)),
      checker_(adapter_, clk, pins_.shape(), LinkChecker::Resets::subordinate) {
  pins_.write(wires_);
}

void SlaveLink::sample(bool in_reset) {
  pins_.read(wires_);
  checker_.edge(wires_, in_reset);
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
  pins_.read(wires_);
  checker_.edge(wires_, in_reset);
  adapter_.sample();
}

bool MasterLink::drive() {
  const bool ready[] = {wires_.aw.ready, wires_.w.ready, wires_.ar.ready};
  const bool answers = wires_.b.valid || wires_.r.valid;
  adapter_.drive();
  const bool same = ready[0] == wires_.aw.ready && ready[1] == wires_.w.ready &&
                    ready[2] == wires_.ar.ready && !answers && !wires_.b.valid && !wires_.r.valid;
  if (!same) pins_.write(wires_);
  return !same;
}

StreamPins::StreamPins(const Interface& interface, const pl::RtlObject& rtl) {
  const auto pin = [&](const char* signal) -> Pin {
    const auto found = interface.ports.find(signal);
    if (found == interface.ports.end()) return {};
    return {rtl.pin(found->second), rtl.descriptor().ports[found->second].bits};
  };
  data = pin("tdata");
  valid = pin("tvalid");
  ready = pin("tready");
  last = pin("tlast");
  keep = pin("tkeep");
  strobe = pin("tstrb");
  constexpr unsigned widest = 32, bits_per_byte = 8;
  if (data.bits() % bits_per_byte == 0 && data.bits() <= widest) return;
  const RtlPort& port = rtl.descriptor().ports[interface.ports.at("tdata")];
  throw vp::InputError(std::string(port.place) + ": port '" + port.name + "' of RTL '" +
                       rtl.file() + "' has " + std::to_string(port.bits) +
                       " bits, and streams of the platform 8, 16, 24 or 32: put a width converter "
                       "into the RTL");
}

void StreamPins::check_width(const vp::AxiStream& link) const {
  constexpr unsigned bits_per_byte = 8;
  if (data.bits() == bits_per_byte * vp::beat_bytes(link)) return;
  throw vp::InputError(std::string(link.name()) + " is " +
                       std::to_string(bits_per_byte * vp::beat_bytes(link)) +
                       " bits wide, and the RTL at it " + std::to_string(data.bits()) +
                       ": put a width converter between");
}

StreamInLink::StreamInLink(const Interface& interface, std::size_t clock, const pl::RtlObject& rtl,
                           vp::Clocked& side)
    : RtlLink(interface, clock), pins_(interface, rtl), port_(name.c_str(), side) {}

void StreamInLink::connect(const Follow& follow) {
  pins_.check_width(port_.link());
  follow(*port_.tdata.signal(), pins_.data);
  follow(*port_.tvalid.signal(), pins_.valid);
  follow(*port_.tlast.signal(), pins_.last);
  follow(*port_.tkeep.signal(), pins_.keep);
  follow(*port_.tkeep.signal(), pins_.strobe);
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
      packet_beats_(packet_beats),
      port_(name.c_str(), side) {}

void StreamOutLink::connect(const Follow& follow) {
  pins_.check_width(port_.link());
  whole_word_ = (1u << vp::beat_bytes(port_.link())) - 1;
  follow(*port_.tready.signal(), pins_.ready);
  vp::AxiStream& link = port_.link();
  link.tdata.defer_writes();
  link.tkeep.defer_writes();
  link.tvalid.defer_writes();
  link.tlast.defer_writes();
}

void StreamOutLink::sample(bool) {
  if (pins_.last || packet_beats_ == 0 || !port_.accepted()) return;
  beat_ = last() ? 0 : beat_ + 1;
}

void StreamOutLink::show_outputs() {
  if (pins_.valid.get() == 0) {
    if (port_.tvalid.written()) port_.withdraw();
    return;
  }
  port_.offer(static_cast<std::uint32_t>(pins_.data.get()), last(),
              static_cast<std::uint8_t>(pins_.keep.get(whole_word_)));
}

}  // namespace axi
