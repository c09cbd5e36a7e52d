#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <axi/interfaces.h>
#include <axi/link_checker.h>
#include <axi/mm_pins.h>
#include <axi/pins_to_tlm.h>
#include <axi/tlm_to_pins.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/signal.h>
#include <vp/stream_shape.h>

namespace axi {

/// One interface of RTL and what it is connected to.
class RtlLink {
 public:
  /// `clock`: the number of its clock.
  RtlLink(const Interface& interface, std::size_t clock) : name(interface.name), clock(clock) {}
  virtual ~RtlLink() = default;
  const std::string name;
  const std::size_t clock;

  /// Whether sample() is to be called.
  virtual bool samples() const { return true; }
  /// Before an edge of its clock. `in_reset`: that samples an active reset of the RTL.
  virtual void sample(bool in_reset) = 0;
  /// Behind it. True if an input of the RTL has changed.
  virtual bool drive() = 0;
  /// The next edge may count, whatever the RTL does.
  virtual bool busy() const = 0;
  /// Before the simulation: whether a checker looks at it.
  virtual void watch(bool /*on*/) {}
  /// Signals follow the outputs of the RTL, once they have settled: those that have changed.
  virtual void show_outputs() {}
  /// At the end of the simulation.
  virtual void finish() {}
  /// When all is bound: `follow` makes an input of the RTL follow a signal.
  using Follow = std::function<void(vp::SignalBase&, const Pin&)>;
  virtual void connect(const Follow&) {}
};

/// RTL answers transactions.
class SlaveLink final : public RtlLink {
 public:
  SlaveLink(const Interface& interface, std::size_t clock, const pl::RtlObject& rtl,
            const vp::Clock& clk, TlmToPins::Begin begin);
  TlmToPins& adapter() { return adapter_; }
  void sample(bool in_reset) override;
  bool drive() override;
  bool busy() const override { return !adapter_.idle() || driving_; }
  void watch(bool on) override { watched_ = on; }
  void finish() override {
    if (watched_) checker_.finish();
  }

 private:
  const MmPins pins_;
  Wires wires_;
  TlmToPins adapter_;
  LinkChecker checker_;
  bool watched_ = true;
  bool driving_ = false;
};

/// RTL sends transactions.
class MasterLink final : public RtlLink {
 public:
  MasterLink(const Interface& interface, std::size_t clock, const pl::RtlObject& rtl,
             const vp::Clock& clk);
  PinsToTlm& adapter() { return adapter_; }
  /// Both of its ports are connected. During elaboration.
  bool is_bound() {
    return adapter_.read.link.socket.bind_count() > 0 &&
           adapter_.write.link.socket.bind_count() > 0;
  }
  void sample(bool in_reset) override;
  bool drive() override;
  bool busy() const override { return !adapter_.idle() || !wires_.quiet(); }
  void watch(bool on) override { watched_ = on; }
  void finish() override {
    if (watched_) checker_.finish();
  }

 private:
  const MmPins pins_;
  Wires wires_;
  PinsToTlm adapter_;
  LinkChecker checker_;
  bool watched_ = true;
  bool quiet_ = false;  ///< nothing is under way, and the RTL sends nothing
};

/// The pins of a stream of RTL, whichever way it goes.
struct StreamPins {
  /// Throws vp::InputError unless TDATA has whole bytes, 128 at most.
  StreamPins(const Interface& interface, const pl::RtlObject& rtl);
  /// `end`: what messages call it.
  vp::StreamShape shape(const std::string& end) const;
  /// Of a field; where the RTL has none, none.
  const Pin& of(vp::StreamField field) const;
  /// The pins of some wires of a link. Of a narrower field the bits that it has.
  Pin of(const vp::StreamPart& part) const;
  /// The lowest 32 of TDATA and 8 of TKEEP, of links of any width.
  Pin low_data() const;
  Pin low_keep() const;
  Pin data, valid, ready, last, keep, strobe, user, id, dest;
};

/// RTL receives a stream.
class StreamInLink final : public RtlLink {
 public:
  StreamInLink(const Interface& interface, std::size_t clock, const pl::RtlObject& rtl,
               vp::Clocked& side);
  vp::AxiStreamSlave& port() { return port_; }
  void sample(bool) override { port_.sample(); }
  bool drive() override { return false; }
  bool busy() const override { return port_.tvalid.read() && port_.tready.get(); }
  void show_outputs() override;
  void connect(const Follow& follow) override;

 private:
  const StreamPins pins_;
  vp::AxiStreamSlave port_;
};

/// RTL sends a stream.
class StreamOutLink final : public RtlLink {
 public:
  /// `packet_beats` counts where the RTL has no TLAST; 0: no packets.
  StreamOutLink(const Interface& interface, std::size_t clock, const pl::RtlObject& rtl,
                vp::Clocked& side, unsigned packet_beats);
  vp::AxiStreamMaster& port() { return port_; }
  bool samples() const override { return !pins_.last && packet_beats_ != 0; }
  void sample(bool in_reset) override;
  bool drive() override { return false; }
  bool busy() const override { return false; }
  void show_outputs() override;
  void connect(const Follow& follow) override;

 private:
  bool last() const { return pins_.last ? pins_.last.get() != 0 : beat_ + 1 == packet_beats_; }

  /// Wires of the link beyond the lowest, and the pins that they follow.
  struct Part {
    Pin pin;
    vp::Signal<std::uint32_t>* wire;
    std::uint32_t shown;
  };

  /// What the lowest wires show.
  struct Shown {
    bool valid = false, last = false;
    std::uint8_t keep = 0;
    std::uint32_t data = 0;
  };

  const StreamPins pins_;
  const Pin low_data_, low_keep_;
  const unsigned packet_beats_;
  Shown shown_;
  std::vector<Part> parts_;
  std::uint64_t whole_word_ = 0;  ///< TKEEP where the RTL has none
  unsigned beat_ = 0;             ///< of a packet, where the RTL has no TLAST
  vp::AxiStreamMaster port_;
};

}  // namespace axi
