#pragma once

#include <axi_vdma_registers.h>
#include <vp/clock.h>
#include <vp/counter.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <xilinx/axi_dma/engine.h>
#include <xilinx/axi_dma/memory_port.h>

#include <cstdint>
#include <string>
#include <systemc>
#include <vector>

namespace xilinx {

/// Who leads in the choice of frame stores: C_MM2S_GENLOCK_MODE and C_S2MM_GENLOCK_MODE.
enum class GenlockMode : std::uint8_t { master, slave, dynamic_master, dynamic_slave };

/// Build options of a channel, as Vivado asks for them; the defaults of its parameters.
struct VdmaChannelBuild {
  bool include = true;
  GenlockMode genlock = GenlockMode::master;
  std::uint32_t memory_bytes = 8;   ///< of a beat: 4 to 128
  std::uint32_t stream_bytes = 4;   ///< of a beat: 1 to 128
  std::uint32_t burst_beats = 16;   ///< 2 to 256
  std::uint32_t line_buffer = 512;  ///< beats of the stream that it holds, 128 to 65536
  bool dre = false;                 ///< addresses need no alignment
};

/// What both channels do: registers, frame stores, the count of frames, errors and the interrupt.
class VdmaChannel : public vp::Clocked, public Engine {
 public:
  /// The core has a bus between both channels.
  void lock_to(const VdmaChannel& other);
  GenlockMode genlock() const { return genlock_; }
  /// Addresses need no alignment.
  bool has_dre() const { return dre_; }
  /// The one under way, or the last one.
  std::uint32_t store() const { return store_; }
  /// A frame is under way.
  virtual bool in_frame() const = 0;
  /// A frame has begun since the reset.
  bool has_begun() const { return begun_; }
  /// The store of the last complete frame; -1: none.
  std::int64_t newest() const { return newest_; }
  std::string under_way() const override;
  /// A hardware reset of the core, or a soft reset of the channel.
  void reset();

  vp::Parameter<std::uint32_t> memory_bytes;
  vp::Parameter<std::uint32_t> stream_bytes;
  vp::Parameter<std::uint32_t> burst_beats;
  vp::Parameter<std::uint32_t> line_buffer;

  MemoryPort m_axi;  ///< bind m_axi.link.socket, or connect it through an AxiInterconnect
  vp::Counter frames;

 protected:
  VdmaChannel(sc_core::sc_module_name name, vp::Clock& clock, vp::RegisterBank& bank,
              const axi_vdma::ChannelOffsets& offsets, const VdmaChannelBuild& build,
              std::uint32_t frame_stores, const char* memory_name, vp::Signal<bool>& introut);

  static constexpr std::uint64_t never = vp::Clock::never;
  static constexpr std::uint32_t burst_boundary = 4096;  ///< AXI: a burst never crosses it
  /// A frame as the registers described it when it began.
  struct Frame {
    std::uint32_t lines = 0, bytes = 0, stride = 0, address = 0;
  };

  /// It runs, and VSIZE was written since.
  bool armed() const { return armed_; }
  /// Says which memory the first round of frames is to fill.
  void order_stores();
  /// Takes what the registers say, for a frame in the store that is next.
  Frame begin_frame();
  /// Counts it: may raise the interrupt, and halts the channel if that was all.
  void end_frame();
  void raise(std::uint32_t errors, bool interrupts = true);
  /// Halts with what the memory port answered for `address`.
  void fail_on_bus(std::uint64_t address);

  /// It may begin from now on.
  virtual void started() = 0;
  /// Nothing of a frame is left.
  virtual void abandon() = 0;
  /// The store of the next frame where the other channel leads, or has one of its own.
  virtual std::uint32_t next_store(const VdmaChannel* other) const = 0;

  std::uint32_t store_behind(std::uint32_t store, std::uint32_t frames) const;
  std::uint32_t following() const { return begun_ ? (store_ + 1) % frame_stores_ : 0; }
  std::uint32_t frame_stores() const { return frame_stores_; }
  std::uint32_t delay() const { return stride_ >> 24 & 0x1F; }

 private:
  void wire();
  void control(std::uint32_t word);
  void start();
  bool is_order_possible();
  void halt();
  void update();

  const char* const title_;  ///< "MM2S"
  const GenlockMode genlock_;
  const bool dre_;
  const std::uint32_t frame_stores_;
  const unsigned park_shift_;
  vp::Register &cr_, &sr_, &vsize_, &hsize_, &stride_, &park_;
  std::vector<vp::Register*> addresses_;
  vp::Signal<bool>& introut_;
  const VdmaChannel* other_ = nullptr;
  bool armed_ = false;
  bool told_of_genlock_ = false;
  bool begun_ = false;
  std::int64_t newest_ = -1;
  std::uint32_t store_ = 0;
};

}  // namespace xilinx
