#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include <axi_dma_registers.h>
#include <vp/register_bank.h>
#include <xilinx/axi_dma/dma_channel.h>

namespace xilinx {

/// The scatter-gather engine of a core (PG021): the memory port of descriptors and its latencies,
/// in cycles of the core's clock. Both channels share it.
struct ScatterGather {
  explicit ScatterGather(vp::ClockScheduler& scheduler) : m_axi("m_axi_sg", scheduler) {}

  MemoryPort m_axi;

  using Source = vp::Source;
  DmaTiming::Cycles tail_latency{"sg_tail_latency", 10, Source::published,
                                 "TAILDESC written to the read address of the descriptor (PG021)"};
  DmaTiming::Cycles fetch_latency{
      "sg_fetch_latency", 28, Source::published,
      "read address of a descriptor to that of its data, or to TREADY, without "
      "the memory (PG021)"};
  DmaTiming::Cycles descriptor_gap{
      "sg_descriptor_gap", 2, Source::published,
      "between the data of two descriptors that were read ahead (PG021)"};
  DmaTiming::Cycles timer_resolution{
      "sg_timer_resolution", 125, Source::published,
      "one count of IRQDelay (C_DLYTMR_RESOLUTION, Vivado's default)"};
};

/// When a channel with scatter-gather interrupts: every so many packets, or some time after one.
class InterruptCoalescing {
 public:
  static constexpr std::uint64_t never = vp::Clock::never;

  InterruptCoalescing(const ScatterGather& engine, const vp::Register& dmacr)
      : engine_(engine), dmacr_(dmacr) {}

  /// Software wrote the control register, which was `before`.
  void control_written(std::uint32_t before, std::uint64_t cycle);
  /// The last descriptor of a packet is back in memory. True: its channel interrupts.
  bool packet_complete();
  /// On the stream, first beat and TLAST: the timer runs between packets.
  void packet_begins() { idle_since_ = never; }
  void packet_ends(std::uint64_t cycle) { idle_since_ = timer_on() ? cycle : never; }
  bool waits_for_packet() const { return idle_since_ != never; }

  /// The edge on which the delay interrupt comes; never if none does.
  std::uint64_t delay_ends() const;
  void delay_ended();

  /// IRQThresholdSts and IRQDelaySts.
  std::uint32_t status(std::uint64_t cycle) const;
  void reset();

 private:
  std::uint32_t threshold() const;
  std::uint32_t delay() const;
  bool timer_on() const;

  const ScatterGather& engine_;
  const vp::Register& dmacr_;
  std::uint32_t packets_left_ = 1;
  std::uint64_t idle_since_ = never;
};

/// A descriptor as the engine read it.
struct Descriptor {
  std::uint32_t at = 0;  ///< its own address
  std::uint32_t next = 0;
  std::uint32_t buffer = 0;
  std::uint32_t control = 0;
  std::uint64_t ready_at = 0;  ///< edge on which its data may begin to move
  std::uint32_t error = 0;     ///< of DMASR: it could not be read, or was complete already
};

/// The descriptors of one channel: reads them ahead up to the tail, in the order of the chain, and
/// writes their statuses back.
class DescriptorRing {
 public:
  static constexpr std::uint64_t never = vp::Clock::never;

  /// `length_mask`: the bits of lengths that are built.
  DescriptorRing(ScatterGather& engine, const DmaTiming& timing, vp::Register& dmacr,
                 vp::Register& curdesc, vp::Register& taildesc, std::uint32_t length_mask)
      : coalescing(engine, dmacr),
        engine(engine),
        length_mask(length_mask),
        timing_(timing),
        curdesc_(curdesc),
        taildesc_(taildesc) {}

  InterruptCoalescing coalescing;
  ScatterGather& engine;
  const std::uint32_t length_mask;

  // What software does.
  /// RS rose: the first descriptor is CURDESC's.
  void start() { next_ = ordered_to_ = curdesc_; }
  /// TAILDESC was written while the channel runs.
  void go_on(std::uint64_t cycle);
  /// Adds the buffers of the descriptors that a new tail brought.
  void order_to_tail(WriteOrders& orders);
  /// Puts back what software wrote to CURDESC while it may not.
  void restore_current() { curdesc_ = current_; }
  void accept_current() { current_ = curdesc_; }

  // What the channel does.
  /// One edge: descriptors and statuses travel. `cyclic`: the chain has no end, and what is
  /// complete is used again.
  void edge(std::uint64_t cycle, bool cyclic);
  std::uint64_t next_edge(std::uint64_t cycle) const;
  /// The next descriptor, if its data may move on this edge; one that stops the channel
  /// only when all before it are back in memory.
  const Descriptor* ready(std::uint64_t cycle) const;
  /// Takes it: it is in work from here on.
  Descriptor take();
  /// The oldest one in work.
  const Descriptor& oldest() const { return working_.front(); }
  /// That is done on edge `cycle`, with this status word.
  void done(std::uint64_t cycle, std::uint32_t status, bool ends_packet);

  /// A status that reached the memory on an edge up to `cycle`.
  struct Written {
    std::uint32_t at;
    bool ends_packet;
    std::uint32_t error;  ///< of DMASR: the memory refused it
  };
  std::optional<Written> take_written(std::uint64_t cycle);

  /// Drops what is not in work and reads no more; statuses go on.
  void flush();
  /// Drops the newest `count` in work, or all of them.
  void drop_newest(std::size_t count) { working_.resize(working_.size() - count); }
  void drop_work() { working_.clear(); }
  /// Nothing is read, in work or to be written.
  bool drained() const;
  /// No access is on the bus, and no status waits for it.
  bool quiet() const { return updates_.empty() && access_ == Access::none; }
  void reset();

 private:
  enum class Access { none, fetch, update };
  struct Update {
    std::uint32_t at = 0;
    std::uint32_t status = 0;
    bool ends_packet = false;
    std::uint64_t due = 0;        ///< edge from which it may go out
    std::uint64_t shown = never;  ///< edge on which the response is there
    std::uint32_t error = 0;
  };

  bool wants_descriptor() const;
  void begin_update(std::uint64_t cycle, bool cyclic);
  void begin_fetch(std::uint64_t cycle, bool cyclic);
  void complete_access(std::uint64_t cycle, bool cyclic);
  void fetched(std::uint64_t cycle, bool cyclic);

  const DmaTiming& timing_;
  vp::Register& curdesc_;
  vp::Register& taildesc_;

  std::uint32_t current_ = 0;     ///< CURDESC
  std::uint32_t next_ = 0;        ///< the descriptor to read next
  std::uint32_t ordered_to_ = 0;  ///< the one behind those whose buffers are ordered
  bool paused_ = true;            ///< at the tail, or not started
  std::uint64_t fetch_from_ = 0;  ///< edge from which the next one may be read
  std::uint64_t fetch_began_ = 0;
  Access access_ = Access::none;
  std::uint32_t words_[axi_dma::descriptor::bytes / 4] = {};  ///< of the access
  std::deque<Descriptor> queue_;                              ///< read, not begun
  std::deque<Descriptor> working_;
  std::deque<Update> updates_;
};

}  // namespace xilinx
