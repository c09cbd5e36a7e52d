#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include <vp/axi_stream.h>
#include <xilinx/axi_dma/dma_channel.h>

namespace xilinx {

/// Stream to memory: collects beats into bursts and writes each when it is complete (store and
/// forward).
///
/// TREADY is low without a transfer: data waits at the master, nothing is lost.
class S2mmChannel : public DmaChannel {
 public:
  S2mmChannel(Core& core, vp::RegisterBank& bank, vp::Clocked& owner, std::uint32_t burst_beats,
              const DmaWidths& widths);

  MemoryPort m_axi;
  vp::AxiStreamSlave s_axis;

  bool quiet(std::uint64_t cycle) const override;
  /// A beat may pass on the edge after the one that ran last: the master has offered one, and
  /// TREADY is high.
  bool expects_beat() const { return s_axis.tvalid && s_axis.tready.written(); }
  /// A beat passed on the edge that ran last, and the master offers no other.
  bool beat_was_last() const { return beat_ && !s_axis.tvalid; }

 private:
  /// A burst that is complete and waits for the bus, or is on it.
  struct Burst {
    std::uint64_t ready = 0;  ///< edge from which its address may go out
    std::uint64_t address = 0;
    unsigned beats = 0;
    std::vector<unsigned char> data;
  };
  /// A transfer that is not in memory yet.
  struct Transfer {
    bool closed = false;       ///< no more beats belong to it
    bool overflow = false;     ///< the packet is longer, or had no TLAST at its end
    unsigned bursts = 0;       ///< to be written
    std::uint32_t status = 0;  ///< bytes received and frame bits, as descriptors have them
  };
  enum class Bus { free, busy, answering };

  void begin(const Segment& segment, std::uint64_t first_cycle) override;
  bool accepts_segment() const override;
  unsigned withdraw_unused() override;
  std::uint64_t move(std::uint64_t cycle) override;
  void sample(std::uint64_t cycle) override;
  void abandon() override;
  void forget_bursts() override;
  void completed() override;
  WriteOrders* orders() override { return &m_axi.orders; }

  void take_beats(std::uint64_t cycle);
  void take_from_source(std::uint64_t cycle);
  void take_beat(std::uint32_t data, std::uint8_t keep, bool last, std::uint64_t cycle);
  void take_wide_beat(std::uint64_t cycle);
  bool take_byte(unsigned char byte, std::uint64_t cycle);
  void take_words(const vp::BeatSource::Beats& beats, std::uint64_t cycle);
  void append(const std::uint32_t* words, std::uint32_t count);
  void end_beat(bool last, std::uint64_t cycle);
  std::uint64_t next_beat_of_interest(std::uint64_t cycle) const;
  void close_burst(std::uint64_t cycle);
  void drive_bus(std::uint64_t cycle);
  void start_burst(std::uint64_t cycle);
  void end_burst(std::uint64_t cycle);
  void conclude(std::uint64_t cycle);
  void fail_transfer(std::uint64_t cycle, std::uint32_t error);
  std::uint64_t shown_at(std::uint64_t cycle) const;
  unsigned buffered_beats(std::uint64_t cycle) const;
  std::uint64_t next_edge(std::uint64_t cycle);

  const unsigned burst_size_;  ///< bytes
  const unsigned fifo_beats_;
  const unsigned beats_per_clock_, clocks_per_beat_;  ///< of the memory's side
  std::uint64_t write_address_ = 0;                   ///< of the burst being collected
  std::uint32_t capacity_ = 0;                        ///< LENGTH
  std::uint32_t received_ = 0;                        ///< bytes taken that LENGTH has room for
  std::uint64_t ready_from_ = never;
  std::uint64_t take_from_ = 0;  ///< with a source: edge before which no beat has to be taken
  bool closed_ = true;           ///< no more beats belong to the last transfer
  bool overflow_ = false;        ///< the packet has bytes that it has no room for
  bool in_packet_ = false;
  std::deque<Transfer> transfers_;  ///< under way; the last one takes beats until it is closed
  std::vector<unsigned char> collected_;
  std::vector<std::vector<unsigned char>> spare_;  ///< memory of bursts that are over
  unsigned collected_beats_ = 0;
  std::deque<Burst> bursts_;
  unsigned queued_beats_ = 0;  ///< beats in bursts_
  Bus bus_ = Bus::free;
  std::uint64_t burst_start_ = 0, burst_end_ = 0;
  std::uint64_t bus_free_at_ = 0;  ///< edge from which the next burst may start
  bool draining_ = false;          ///< the transfer was dropped, its burst on the bus continues
  bool beat_ = false;              ///< a beat passed on the edge that ran last
};

}  // namespace xilinx
