#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <systemc>
#include <tlm>
#include <utility>
#include <vector>

#include <axi_dma_registers.h>
#include <vp/clock.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <xilinx/axi_dma/memory_port.h>

namespace xilinx {

/// FIFO of the DataMover in bursts: its address pipeline of 4 + 2, rounded up to a power of two
/// (HDL of v5.1).
constexpr unsigned fifo_bursts = 8;
/// Commands that the DataMover holds (HDL of v5.1).
constexpr unsigned command_queue = 4;

/// Latencies of an AXI DMA and of the memory behind it, in cycles of its clock.
///
/// They give 10 000 bytes at 100 MHz and 32 bits the published throughput: memory to stream 399.0
/// MB/s from the first data on, stream to memory 298.6 MB/s with latency (PG021).
struct DmaTiming {
  /// A latency in cycles.
  struct Cycles : vp::Parameter<std::uint32_t> {
    Cycles(const char* name, std::uint32_t usual, vp::Source source, const char* documentation)
        : Parameter(name, usual, vp::Unit::cycles, {0, 10'000}, source, documentation) {}
  };
  using Source = vp::Source;

  Cycles run_latency{"run_latency", 2, Source::published,
                     "RS written to Halted changed (HDL of v7.1)"};
  Cycles address_latency{"address_latency", 2, Source::published,
                         "LENGTH written to the address register sampled (HDL of v7.1)"};
  Cycles start_latency{
      "start_latency", 11, Source::published,
      "LENGTH written to first address or TREADY: state machine 3, DataMover 8 (PG022)"};
  Cycles read_latency{"read_latency", 6, Source::published,
                      "read address to first TVALID without the memory (PG021)"};
  Cycles memory_read_latency{
      "memory_read_latency", 20, Source::measured,
      "read address to first data from DDR through a high performance port, 100 MHz "
      "(pynqz2-ram-tester: about 21 for bursts of 16)"};
  Cycles write_latency{
      "write_latency", 23, Source::derived,
      "last beat of a burst to its write address: 39 after the first of 16 (PG021)"};
  Cycles write_gap{"write_gap", 10, Source::derived,
                   "between two write bursts: from 298.6 MB/s for 10 000 bytes (PG021)"};
  Cycles memory_write_latency{"memory_write_latency", 20, Source::assumed,
                              "last write data to write response; as for reads"};
  Cycles completion_latency{"completion_latency", 5, Source::assumed,
                            "last beat or write response to the status register"};
  Cycles reset_cycles{"reset_cycles", 8, Source::published,
                      "soft reset, once outstanding bursts are over (HDL of v7.1)"};
};

/// Bytes of a beat of a channel's memory map and stream: powers of two, 4 to 128, the memory's no
/// less than the stream's (PG021).
///
/// The port of the PS has 8 bytes (UG585): a beat of more takes it for several clocks. Behind S2MM
/// a clock writes as many beats of the stream as memory and port have room for; MM2S reads one
/// (assumed: the FIFO hides what a wider memory gains).
struct DmaWidths {
  std::uint32_t memory_bytes = 4;
  std::uint32_t stream_bytes = 4;

  /// Beats of the stream that a clock brings to memory.
  std::uint32_t beats_per_clock() const;
  /// Clocks that the port of the PS takes for a beat of the stream.
  std::uint32_t clocks_per_beat() const;
};

class DescriptorRing;
struct Descriptor;
struct ScatterGather;

/// What both channels share: the registers, run and halt, descriptors, completion, errors and the
/// interrupt. Derived classes move the data.
class DmaChannel {
 public:
  /// The part of the core that a channel needs.
  class Core {
   public:
    virtual ~Core() = default;
    virtual const DmaTiming& timing() const = 0;
    virtual const vp::Clock& channel_clock() const = 0;
    /// Runs edge `cycle`, or an earlier one.
    virtual void plan_edge(std::uint64_t cycle) = 0;
    /// Runs the next edge if an interrupt output has to follow its channel.
    virtual void plan_interrupts() = 0;
    /// An error in one channel stops both.
    virtual void stop_channels() = 0;
    virtual void request_soft_reset() = 0;
    virtual bool in_soft_reset() const = 0;
    /// An error was reported and the core was not reset since.
    virtual bool stopped() const = 0;
    /// Every edge is observed.
    virtual bool watched() const = 0;
    virtual void warn(const char* id, const std::string& message) const = 0;
    /// Called before `who` moves that many bytes: warns if they are outside memory made for it.
    virtual void check_buffer(const std::string& who, std::uint32_t address,
                              std::uint32_t bytes) const = 0;
  };

  struct Offsets {
    std::uint32_t dmacr, dmasr, curdesc, taildesc, address, address_msb, length;
  };

  static constexpr std::uint64_t never = vp::Clock::never;

  /// `counts_at_rest`: sample() is to run without a transfer, too.
  DmaChannel(Core& core, vp::RegisterBank& bank, const Offsets& offsets, std::string name,
             const DmaWidths& widths, bool counts_at_rest);
  virtual ~DmaChannel();

  vp::Register& dmacr;
  vp::Register& dmasr;
  vp::Register& curdesc;
  vp::Register& taildesc;
  vp::Register& address;
  vp::Register& address_msb;
  vp::Register& length;

  /// Bits of LENGTH, and of what the address must be a multiple: bytes, 1 with a data realignment
  /// engine.
  void configure(std::uint32_t length_width, unsigned alignment);
  /// Descriptors say what is to be moved, instead of the address and LENGTH registers. After
  /// configure().
  void use(ScatterGather& engine);

  /// Called when a transfer is accepted (true) and when its end shows in the status register
  /// (false), at exactly these times; with descriptors, when the first of a row begins to move and
  /// when the last has moved. May be null.
  using TransferListener = std::function<void(bool begins)>;
  void on_transfer(TransferListener listener) { transfer_listener_ = std::move(listener); }

  /// An edge changes nothing: it has nothing to do, and counts nothing on its stream.
  bool rests() const { return at_rest() && !counts_at_rest_; }
  /// One clock edge. Returns the next one that the channel needs (signals may wake it earlier).
  std::uint64_t edge(std::uint64_t cycle);
  /// A transfer was accepted, and its end does not show yet at the edge of now.
  bool is_moving() const { return phase_ != Phase::idle && !(finishing() && now() >= finish_at_); }
  /// "64 bytes", or a ring of descriptors.
  std::string what_moves() const;
  /// Its descriptors go round without an end.
  bool cyclic() const { return dmacr.any(axi_dma::dmacr::Cyclic_BD_Enable); }
  /// The end of the transfer is known and not shown yet.
  bool finishing() const { return finish_at_ != never; }
  /// Shows an end up to edge `cycle`. An end that raises an interrupt is shown on the edge of the
  /// interrupt, or when the register is read before that.
  void bring_up_to(std::uint64_t cycle) {
    if (finishing() && cycle >= finish_at_) report_status(finish_at_);
  }
  /// Status AND enable: what the interrupt output shows one clock later.
  bool interrupt() const { return (dmasr & dmacr & axi_dma::dmasr::interrupts) != 0; }

  /// No burst is on the bus, no status of a descriptor on its way.
  bool settled(std::uint64_t cycle) const;
  /// RS = 0, the transfer is dropped; halts when outstanding bursts are over.
  void stop();
  /// Drops the transfer under way; bursts on the bus finish.
  void drop();
  /// No burst is on the bus.
  virtual bool quiet(std::uint64_t cycle) const = 0;
  /// State after reset. The registers are the bank's to reset.
  void reset();

 protected:
  /// What a transfer moves: all of it in direct register mode, or the buffer of a descriptor.
  struct Segment {
    std::uint32_t address = 0;
    std::uint32_t bytes = 0;
    bool ends_packet = true;  ///< to a stream: TLAST comes with its last beat
  };

  /// A transfer begins: first address or TREADY on edge `first_cycle`.
  virtual void begin(const Segment& segment, std::uint64_t first_cycle) = 0;
  /// Another one may begin while those before it are still under way.
  virtual bool accepts_segment() const = 0;
  /// Moves data on one edge; calls finish() or fail(). Returns the next edge that it needs.
  virtual std::uint64_t move(std::uint64_t cycle) = 0;
  /// The part of an edge that always runs: sampling the stream.
  virtual void sample(std::uint64_t cycle) = 0;
  /// Drops the transfer and idles the stream's outputs; bursts on the bus continue.
  virtual void abandon() = 0;
  virtual void forget_bursts() = 0;
  /// The transfer has reached memory or stream.
  virtual void completed() {}
  /// Of what it writes: where software's orders are kept. Null: it writes nothing.
  virtual WriteOrders* orders() { return nullptr; }

  /// The oldest transfer is done and shows in the status register on edge `cycle`, or in that of
  /// its descriptor later: bytes and frame bits of its status are `status`.
  void finish(std::uint64_t cycle, std::uint32_t status, bool ends_packet);
  /// It is not: something came in between.
  void unfinish() { finish_at_ = never; }
  /// The transfer failed; `error` is one of the error bits of DMASR.
  void fail(std::uint64_t cycle, std::uint32_t error) {
    finish_at_ = cycle;
    error_ = error;
  }
  /// The error bit for a bus response; 0 for OK.
  static std::uint32_t error_bit(tlm::tlm_response_status response);
  bool keyhole() const { return dmacr.any(axi_dma::dmacr::Keyhole); }

  bool uses_descriptors() const { return ring_ != nullptr; }
  /// Begins what descriptors are there for, as far as the channel accepts it.
  void begin_descriptors(std::uint64_t cycle);
  /// The stream's packets, for the delay timer.
  void packet_begins();
  void packet_ends(std::uint64_t cycle);
  /// The delay timer wants to know of the next packet's first beat.
  bool waits_for_packet() const;
  /// Takes back what began and has moved nothing yet; tells how many that were.
  virtual unsigned withdraw_unused() { return 0; }

  /// Bytes that a burst may have: it crosses no 4 KiB.
  static unsigned burst_size(std::uint32_t beats, const DmaWidths& widths);

  Core& core_;
  const unsigned beat_bytes_;  ///< of the stream

 private:
  enum class Phase { idle, accepted, moving };

  void control_written(std::uint32_t word);
  void status_written(std::uint32_t word);
  void length_written(std::uint32_t word);
  void latch_address();
  void current_written(std::uint32_t word);
  void tail_written(std::uint32_t word);
  bool at_rest() const {
    return phase_ == Phase::idle && run_at_ == never && halt_at_ == never && !halting_ &&
           (!ring_ || ring_rests());
  }
  bool ring_rests() const;
  void order(const Segment& segment);
  void run_ring(std::uint64_t cycle);
  void pause_ring(std::uint64_t cycle);
  void begin_descriptor(const Descriptor& next, std::uint64_t cycle);
  void leave(unsigned count);
  Segment segment_of(const Descriptor& from) const;
  std::uint32_t aligned(std::uint32_t address) const;
  std::uint64_t starts_at() const;
  void start(std::uint64_t cycle);
  std::uint64_t shows_at() const;
  void report_status(std::uint64_t cycle);
  void report_error(std::uint64_t cycle, std::uint32_t error);
  void warn_of_bus_error() const;
  void warn_of_pointer(const std::string& pointer, std::uint32_t word) const;
  void warn_of_descriptor(std::uint32_t at, std::uint32_t error) const;
  void set_interrupt(std::uint32_t bit, std::uint64_t cycle);
  std::uint64_t run_and_halt(std::uint64_t cycle);
  void halt_after(std::uint64_t cycle);
  void plan_after_write();
  std::uint64_t now() const { return clock_.cycle(); }
  bool running() const { return dmacr.any(axi_dma::dmacr::RS); }

  const vp::Clock& clock_;
  std::string name_;
  std::unique_ptr<DescriptorRing> ring_;  ///< null in direct register mode
  unsigned under_way_ = 0;                ///< descriptors whose data is being moved
  bool in_order_ = false;                 ///< descriptors go on: Idle comes when they are done
  std::uint32_t control_ = 0;             ///< DMACR before the last write
  TransferListener transfer_listener_;
  const bool counts_at_rest_;
  unsigned alignment_ = 1;
  std::uint32_t length_width_ = 0;
  Phase phase_ = Phase::idle;
  std::uint32_t requested_bytes_ = 0;
  std::uint64_t accepted_at_ = 0;
  std::uint32_t sampled_address_ = 0;
  std::uint64_t finish_at_ = never;
  std::uint32_t error_ = 0;
  std::uint64_t run_at_ = never;   ///< Halted falls
  std::uint64_t halt_at_ = never;  ///< Halted rises
  bool halting_ = false;           ///< waits for the bus to become quiet
  bool complete_on_halt_ = false;
  std::uint32_t fresh_interrupts_ = 0;  ///< set by hardware on edge fresh_at_
  std::uint64_t fresh_at_ = never;
};

}  // namespace xilinx
