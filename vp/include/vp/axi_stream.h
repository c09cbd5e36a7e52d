#pragma once

#include <cstdint>
#include <systemc>

#include <vp/clock.h>
#include <vp/counter.h>
#include <vp/signal.h>

namespace vp {

/// One 32-bit AXI4-Stream connection, a named object with the five wires of thesis figure 4.18 and
/// TKEEP.
///
/// The master's module drives all wires but tready, the slave's module drives that. A beat passes
/// on each clock edge that samples tvalid and tready high. Both ends belong to the same clock.
class AxiStream : public sc_core::sc_module {
 public:
  explicit AxiStream(sc_core::sc_module_name name) : sc_module(name) {}
  const char* kind() const override { return "vp::AxiStream"; }

  Signal<std::uint32_t> tdata{"tdata"};
  Signal<std::uint8_t> tkeep{"tkeep", 4, 0xF};  ///< bit i: byte lane i carries data
  Signal<bool> tvalid{"tvalid"};
  Signal<bool> tlast{"tlast"};
  Signal<bool> tready{"tready"};

  // Counted by the slave on its clock edges.
  Counter beats{"beats", "beats passed"};
  Counter packets{"packets", "packets completed: beats with TLAST"};
  Counter stalls{"stalls", "clock edges on which the master waited: TVALID without TREADY"};

 private:
  friend class AxiStreamMaster;
  friend class AxiStreamSlave;

  bool has_master_ = false;
  bool has_slave_ = false;
};

/// The port bundle of a module that sends: `vp::AxiStreamMaster m_axis{"m_axis", *this};`
class AxiStreamMaster {
 public:
  AxiStreamMaster(const char* name, Clocked& owner);

  /// Throws std::logic_error if the link has a master already.
  void bind(AxiStream& link);
  void operator()(AxiStream& link) { bind(link); }
  bool bound() const { return link_ != nullptr; }

  /// In edge(): the beat that was offered passes on this edge.
  bool accepted() const { return tvalid.get() && tready.read(); }
  /// In edge(): a new beat may be offered, since none is waiting.
  bool free() const { return !tvalid.get() || tready.read(); }
  /// Offers a beat from this edge on.
  void offer(std::uint32_t data, bool last, std::uint8_t keep = 0xF) {
    tdata = data;
    tkeep = keep;
    tlast = last;
    tvalid = true;
  }
  /// Offers nothing from this edge on.
  void withdraw() {
    tvalid = false;
    tlast = false;
  }

  Out<std::uint32_t> tdata;
  Out<std::uint8_t> tkeep;
  Out<bool> tvalid;
  Out<bool> tlast;
  In<bool> tready;

 private:
  AxiStream* link_ = nullptr;
};

/// The port bundle of a module that receives: `vp::AxiStreamSlave s_axis{"s_axis", *this};`
class AxiStreamSlave {
 public:
  AxiStreamSlave(const char* name, Clocked& owner);

  /// Throws std::logic_error if the link has a slave already.
  void bind(AxiStream& link);
  void operator()(AxiStream& link) { bind(link); }
  bool bound() const { return link_ != nullptr; }

  /// Once in every edge() of the slave: counts, and tells whether a beat passes on this edge. A
  /// slave that sleeps wakes on tvalid; the edges it slept through count as stalls where the master
  /// waited.
  bool sample() {
    const bool valid = tvalid.read();
    const bool ready = tready.get();
    if (valid && ready) {
      ++link_->beats;
      link_->packets.add(tlast.read());
      waiting_ = false;
      return true;
    }
    if (valid || waiting_) count_stall(valid);
    return false;
  }

  In<std::uint32_t> tdata;
  In<std::uint8_t> tkeep;
  In<bool> tvalid;
  In<bool> tlast;
  Out<bool> tready;

 private:
  void count_stall(bool valid);

  Clocked& owner_;
  AxiStream* link_ = nullptr;
  bool waiting_ = false;  ///< the last edge looked at was a stall
  std::uint64_t last_stall_cycle_ = 0;
};

}  // namespace vp
