#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <systemc>
#include <utility>
#include <vector>

#include <vp/clock.h>
#include <vp/counter.h>
#include <vp/signal.h>
#include <vp/stream_shape.h>

namespace vp {

/// A master that knows when its beats pass: a slave that asks needs no event for each. TVALID and
/// TDATA rest then; TREADY is a wire as ever.
class BeatSource {
 public:
  /// Whole words that passed one after the other.
  struct Beats {
    const std::uint32_t* words = nullptr;
    std::uint32_t count = 0;
    bool last = false;  ///< TLAST came with the last of them
  };
  virtual ~BeatSource() = default;
  /// No edge before this one passes the `beats`th beat from now on, nor one with TLAST before it,
  /// while TREADY stays high; Clock::never if none is in sight. The slave is woken when that
  /// changes.
  virtual std::uint64_t earliest_pass(std::uint32_t beats) = 0;
  /// Takes the oldest beats that passed on edges up to `cycle`, up to the first with TLAST. Their
  /// words are valid until the source is called again.
  virtual Beats take(std::uint64_t cycle) = 0;
};

/// A slave that takes whole bursts while its TREADY is high and single beats are not observed.
class BurstSink {
 public:
  virtual ~BurstSink() = default;
  virtual bool takes_bursts() const = 0;
  /// `count` beats that passed one after the other, the last of them on this edge.
  virtual void take_burst(const std::uint32_t* words, std::uint32_t count) = 0;
};

/// A master that sends bursts to a BurstSink.
class BurstSender {
 public:
  virtual ~BurstSender() = default;
  /// Gives what passed on edges up to `cycle` of a burst under way; the rest comes beat by beat.
  virtual void settle(std::uint64_t cycle) = 0;
};

/// Lets beats go wrong on their way.
class StreamFault {
 public:
  virtual ~StreamFault() = default;
  /// The master offers a beat: what its wires show, of TDATA the first 32 bits.
  virtual void offered(std::uint32_t& data, bool& last) = 0;
  /// A beat passes on this edge, and the slave does not see it.
  virtual bool drops() = 0;
  /// A beat passes on this edge, and the master does not see that.
  virtual bool repeats() = 0;
};

class AxiStreamMaster;
class AxiStreamSlave;
class StreamChecker;

/// One AXI4-Stream connection, a named object with the five wires of thesis figure 4.18 and TKEEP.
///
/// Its ends say how wide it is: models 32 bits, RTL what its ports have. Wider beats have further
/// wires, and TSTRB, TUSER, TID and TDEST if the master drives them.
///
/// The master's module drives all wires but tready, the slave's module drives that. A beat passes
/// on each clock edge that samples tvalid and tready high. Both ends belong to the same clock. A
/// checker watches the rules of the handshake (vp/protocol_rules.h).
class AxiStream : public sc_core::sc_module {
 public:
  explicit AxiStream(sc_core::sc_module_name name);
  ~AxiStream() override;
  const char* kind() const override { return "vp::AxiStream"; }

  Signal<std::uint32_t> tdata{"tdata"};
  Signal<std::uint8_t> tkeep{"tkeep", 4, 0xF};  ///< bit i: byte lane i carries data, of 8 at most
  Signal<bool> tvalid{"tvalid"};
  Signal<bool> tlast{"tlast"};
  Signal<bool> tready{"tready"};

  /// Beats pass without an event for each: of the wires, only tready moves.
  bool rests() const { return source_ || sink_; }
  /// No beat passes without one, and `fault` decides about each; null: they only pass one by one.
  /// During elaboration, or later if they do already.
  void pass_singly(StreamFault* fault);
  bool has_fault() const { return fault_ != nullptr; }

  /// Further wires: there once both ends are bound.
  struct Part {
    Part(const StreamPart& of, std::uint32_t initial, Clocked& master, Clocked& slave)
        : part(of),
          wire(of.name().c_str(), of.bits, initial),
          read_by_slave(of.name().c_str(), &slave) {
      wire.set_writer(master);
      read_by_slave(wire);
    }
    StreamPart part;
    Signal<std::uint32_t> wire;
    In<std::uint32_t> read_by_slave;  ///< so that the scheduler knows who samples it
  };
  std::deque<Part>& parts() { return parts_; }
  /// Of a beat, once both ends are bound.
  unsigned bytes() const { return bytes_; }
  /// All bytes of the beat on the wires, for links of any width.
  StreamBytes beat() const;
  void show(const StreamBytes& beat);

  // Counted by the slave on its clock edges.
  Counter beats{"beats", "beats passed"};
  Counter packets{"packets", "packets completed: beats with TLAST"};
  Counter stalls{"stalls", "clock edges on which the master waited: TVALID without TREADY"};

 private:
  friend class AxiStreamMaster;
  friend class AxiStreamSlave;

  void start_of_simulation() override;
  void end_of_simulation() override;
  void check_beat(bool last);
  void excuse();
  void join();

  unsigned bytes_ = 4;
  std::uint8_t whole_keep_ = 0xF;  ///< tkeep of a beat whose bytes all count
  bool more_lanes_ = false;        ///< parts_ has further bits of TKEEP, or TSTRB
  std::deque<Part> parts_;
  std::unique_ptr<StreamChecker> checker_;
  AxiStreamMaster* master_ = nullptr;
  AxiStreamSlave* slave_end_ = nullptr;
  Clocked* slave_ = nullptr;
  bool slave_takes_source_ = false;
  BeatSource* source_ = nullptr;
  bool source_changed_ = false;  ///< since the slave asked
  BurstSink* sink_ = nullptr;
  BurstSender* sender_ = nullptr;
  StreamFault* fault_ = nullptr;
};

/// The port bundle of a module that sends: `vp::AxiStreamMaster m_axis{"m_axis", *this};`
class AxiStreamMaster {
 public:
  AxiStreamMaster(const char* name, Clocked& owner);

  /// How wide it is, if not 32 bits of TDATA alone: before the binding.
  void set_shape(const StreamShape& shape) { shape_ = shape; }
  const StreamShape& shape() const { return shape_; }
  /// Throws std::logic_error if the link has a master already, vp::InputError if both ends do not
  /// fit.
  void bind(AxiStream& link);
  void operator()(AxiStream& link) { bind(link); }
  bool bound() const { return link_ != nullptr; }
  AxiStream& link() const { return *link_; }

  /// The master may drop a beat that waits while `reset` is high: no violation of the link.
  void reset_by(const InBase& reset) {
    resets_.push_back({[&reset] { return reset.signal(); }, false});
  }
  void reset_by(SignalBase& reset, bool active_low) {
    resets_.push_back({[&reset] { return &reset; }, active_low});
  }
  /// It is reset on this edge, in a way that no wire shows.
  void excuse() { link_->excuse(); }

  /// In edge(): the beat that was offered passes on this edge.
  bool accepted() const { return tvalid.get() && taken(); }
  /// In edge(): a new beat may be offered, since none is waiting.
  bool free() const { return !tvalid.get() || taken(); }
  /// Offers a beat from this edge on.
  void offer(std::uint32_t data, bool last, std::uint8_t keep = 0xF) {
    if (link_->fault_) link_->fault_->offered(data, last);
    tdata = data;
    tkeep = keep;
    tlast = last;
    tvalid = true;
  }
  /// The same, of any width.
  void offer(const StreamBytes& beat, bool last) {
    link_->show(beat);
    if (link_->fault_) {
      std::uint32_t data = tdata.written();
      link_->fault_->offered(data, last);
      tdata = data;
    }
    tlast = last;
    tvalid = true;
  }
  /// Offers nothing from this edge on.
  void withdraw() {
    tvalid = false;
    tlast = false;
  }

  // Without an event for each beat, where the slave can: after the binding.
  bool slave_takes_source() const { return link_->slave_takes_source_; }
  void set_source(BeatSource& source) { link_->source_ = &source; }
  /// More, or other, beats are in sight of the source than before.
  void wake_slave() {
    link_->source_changed_ = true;
    link_->slave_->wake();
  }
  /// Counts what passed from the source, and the edges on which it waited for TREADY.
  void count(std::uint64_t beats, std::uint64_t packets, std::uint64_t stalls) {
    link_->beats.add(beats);
    link_->packets.add(packets);
    link_->stalls.add(stalls);
  }
  /// Null if the slave wants single beats.
  BurstSink* sink() const { return link_->sink_; }
  void set_sender(BurstSender& sender) { link_->sender_ = &sender; }
  /// Gives the sink a burst of which `count` beats have passed; `last`: the last one with TLAST.
  void send_burst(const std::uint32_t* words, std::uint32_t count, bool last) {
    link_->sink_->take_burst(words, count);
    link_->beats.add(count);
    link_->packets.add(last ? 1 : 0);
  }

  Out<std::uint32_t> tdata;
  Out<std::uint8_t> tkeep;
  Out<bool> tvalid;
  Out<bool> tlast;
  In<bool> tready;

 private:
  friend class AxiStream;

  bool taken() const { return tready.read() && !(link_->fault_ && link_->fault_->repeats()); }

  Clocked& owner_;
  StreamShape shape_;
  AxiStream* link_ = nullptr;
  struct Reset {
    std::function<SignalBase*()> signal;  ///< known when all is bound
    bool active_low;
  };
  std::vector<Reset> resets_;
};

/// The port bundle of a module that receives: `vp::AxiStreamSlave s_axis{"s_axis", *this};`
class AxiStreamSlave {
 public:
  AxiStreamSlave(const char* name, Clocked& owner);

  /// How wide it is, if not 32 bits of TDATA alone: before the binding.
  void set_shape(const StreamShape& shape) { shape_ = shape; }
  const StreamShape& shape() const { return shape_; }
  /// Throws std::logic_error if the link has a slave already, vp::InputError if both ends do not
  /// fit.
  void bind(AxiStream& link);
  void operator()(AxiStream& link) { bind(link); }
  bool bound() const { return link_ != nullptr; }
  AxiStream& link() const { return *link_; }

  /// Once in every edge() of the slave: counts, and tells whether a beat passes on this edge. A
  /// slave that sleeps wakes on tvalid; the edges it slept through count as stalls where the master
  /// waited. It does not sleep behind a beat, when the next one may wait already: TVALID would not
  /// change.
  bool sample() {
    const bool valid = tvalid.read();
    const bool ready = tready.get();
    if (valid && ready) {
      if (link_->fault_ && link_->fault_->drops()) return waiting_ = false;
      ++link_->beats;
      link_->packets.add(tlast.read());
      if ((tkeep.read() & link_->whole_keep_) != link_->whole_keep_ || link_->more_lanes_)
        link_->check_beat(tlast.read());
      waiting_ = false;
      return true;
    }
    if (valid || waiting_) count_stall(valid);
    return false;
  }

  // Without an event for each beat, where the master can.
  /// The slave asks source() if there is one. Before the binding.
  void accept_source() { takes_source_ = true; }
  BeatSource* source() const { return link_->source_; }
  /// Whether what was in sight of the source has changed since the last call.
  bool source_changed() { return std::exchange(link_->source_changed_, false); }
  /// Before the binding.
  void set_sink(BurstSink& sink) { sink_ = &sink; }
  /// A burst under way is given up to edge `cycle`, the rest beat by beat.
  void settle(std::uint64_t cycle) {
    if (link_->sender_) link_->sender_->settle(cycle);
  }

  In<std::uint32_t> tdata;
  In<std::uint8_t> tkeep;
  In<bool> tvalid;
  In<bool> tlast;
  Out<bool> tready;

 private:
  friend class AxiStream;

  void count_stall(bool valid);

  Clocked& owner_;
  StreamShape shape_;
  AxiStream* link_ = nullptr;
  bool takes_source_ = false;
  BurstSink* sink_ = nullptr;
  bool waiting_ = false;  ///< the last edge looked at was a stall
  std::uint64_t last_stall_cycle_ = 0;
};

/// The master of a stream in a test bench, of any width: sends the beats it is given, one a clock.
/// Bytes beyond the fourth are 0.
class StreamSource : public Clocked {
 public:
  StreamSource(sc_core::sc_module_name name, Clock& clock) : Clocked(name, clock) {
    m_axis.set_shape({this->name(), 0});
  }

  AxiStreamMaster m_axis{"m_axis", *this};
  unsigned sent = 0;  ///< beats that passed

  /// Queues a beat.
  void send(std::uint32_t data, bool last, std::uint8_t keep = 0xF) {
    queue_.push_back({data, last, keep});
    if (!awake()) wake();
  }
  /// Forgets those that were not offered yet.
  void drop() { queue_.clear(); }

 private:
  struct Beat {
    std::uint32_t data;
    bool last;
    std::uint8_t keep;
  };
  void edge() override {
    if (m_axis.accepted()) ++sent;
    if (!m_axis.free()) return;
    if (queue_.empty()) {
      m_axis.withdraw();
      sleep();
      return;
    }
    const Beat beat = queue_.front();
    queue_.pop_front();
    m_axis.offer(beat.data, beat.last, beat.keep);
  }
  std::deque<Beat> queue_;
};

/// The slave of a stream in a test bench, of any width: takes beats, and keeps them with the cycle
/// on which each passed.
class StreamSink : public Clocked {
 public:
  StreamSink(sc_core::sc_module_name name, Clock& clock) : Clocked(name, clock) {
    s_axis.set_shape({this->name(), 0});
    wake_on(s_axis.tvalid);
  }

  struct Beat {
    std::uint64_t cycle;
    std::uint32_t data;
    bool last;
    std::uint8_t keep;
    std::vector<std::uint32_t> more = {};  ///< what the link's further wires carried
  };

  AxiStreamSlave s_axis{"s_axis", *this};
  std::vector<Beat> beats;
  /// What tready becomes on an edge.
  std::function<bool(std::uint64_t)> ready_on = [](std::uint64_t) { return true; };
  /// tready stays low, and the module asleep as long as it can, until this edge.
  std::uint64_t sleep_until = 0;

 private:
  void edge() override {
    const std::uint64_t cycle = clock().cycle();
    if (s_axis.sample()) {
      beats.push_back({cycle, s_axis.tdata, s_axis.tlast, s_axis.tkeep});
      for (const auto& part : s_axis.link().parts()) beats.back().more.push_back(part.wire.get());
    }
    if (cycle < sleep_until) {
      s_axis.tready = false;
      sleep();
      wake_at(sleep_until);
      return;
    }
    wake();
    s_axis.tready = ready_on(cycle);
  }
};

}  // namespace vp
