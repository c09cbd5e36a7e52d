#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

#include <axi_dma_registers.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <xilinx/axi_dma/descriptor_ring.h>
#include <xilinx/axi_dma/dma_channel.h>
#include <xilinx/axi_dma/engine.h>
#include <xilinx/axi_dma/mm2s_channel.h>
#include <xilinx/axi_dma/s2mm_channel.h>

namespace xilinx {

/// Build options of an AXI DMA, as Vivado asks for them; the defaults of its parameters.
struct AxiDmaBuild {
  bool include_mm2s = true;
  bool include_s2mm = true;
  bool include_sg = false;  ///< scatter-gather instead of direct register mode
  std::uint32_t length_width = 14;
  bool mm2s_dre = false;  ///< data realignment engine: unaligned addresses
  bool s2mm_dre = false;
  std::uint32_t mm2s_burst_beats = 32;
  std::uint32_t s2mm_burst_beats = 32;
  DmaWidths mm2s, s2mm;
};

/// AXI DMA v7.1 (PG021) in direct register mode or with scatter-gather, register-accurate, streams
/// of 32 to 1024 bits, one clock; without the control and status streams and several channels.
///
///   platform: dma.mm2s().m_axi.link.socket.bind(...); dma.mm2s().m_axis(link);
///   dma.s2mm().s_axis(link); with include_sg dma.scatter_gather().m_axi.link.socket.bind(...);
class AxiDma : public vp::Clocked, public vp::Ip, public Engine, private DmaChannel::Core {
 public:
  /// Throws vp::InputError if neither channel is built, a burst is no power of two, or a width is
  /// none of the core's.
  AxiDma(sc_core::sc_module_name name, vp::Clock& aclk, const AxiDmaBuild& build = {});
  const char* kind() const override { return "xilinx::AxiDma"; }

  vp::Parameter<bool> include_mm2s;
  vp::Parameter<bool> include_s2mm;
  vp::Parameter<bool> include_sg;
  vp::Parameter<std::uint32_t> length_width;
  vp::Parameter<bool> mm2s_dre;
  vp::Parameter<bool> s2mm_dre;
  vp::Parameter<std::uint32_t> mm2s_burst_beats;
  vp::Parameter<std::uint32_t> s2mm_burst_beats;
  DmaTiming latencies;

  vp::In<bool> axi_resetn{"axi_resetn"};  ///< may be left open
  vp::RegisterBank s_axi_lite;
  vp::Signal<bool> mm2s_introut{"mm2s_introut"};
  vp::Signal<bool> s2mm_introut{"s2mm_introut"};

  /// Follows `mm2s_prmry_reset_out_n` and its like, which are low while the engine resets what is
  /// at its streams; before the simulation.
  void drive_reset_out(vp::Signal<bool>& signal) { reset_outs_.push_back(&signal); }

  /// The channels. Throw std::logic_error if the build does not have them.
  Mm2sChannel& mm2s();
  S2mmChannel& s2mm();
  /// The engine that moves descriptors. Throws std::logic_error if the build does not have it.
  ScatterGather& scatter_gather();

  /// Called before each transfer and descriptor begins. Returns what is wrong with its address
  /// range, as the end of a message ("leaves its buffer …"), or "". `who`: "MM2S", "S2MM" …. May be
  /// null.
  using BufferCheck = std::function<std::string(const std::string& who, std::uint32_t address,
                                                std::uint32_t bytes)>;
  void check_buffers(BufferCheck check) { buffer_check_ = std::move(check); }

  /// Of the build.
  const DmaWidths mm2s_widths, s2mm_widths;

  std::string under_way() const override;

  /// Beats of the streams moved between memory and the core so far.
  std::uint64_t beats() const;
  /// All bursts contend with those of other masters on the same path.
  void share_memory_path(MemoryPath& path);

 private:
  /// An interrupt output: a register.
  struct Interrupt {
    DmaChannel* channel;
    vp::Signal<bool>* output;
    bool level = false;
  };

  void edge() override;
  vp::IpEstimate own_estimate() const override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void before_end_of_elaboration() override;
  void start_of_simulation() override;

  // DmaChannel::Core
  const DmaTiming& timing() const override { return latencies; }
  const vp::Clock& channel_clock() const override { return clock(); }
  void plan_edge(std::uint64_t cycle) override;
  void plan_interrupts() override;
  void stop_channels() override;
  void request_soft_reset() override;
  bool in_soft_reset() const override { return resetting_; }
  bool stopped() const override { return stopped_; }
  bool watched() const override;
  void warn(const char* id, const std::string& message) const override;
  void check_buffer(const std::string& who, std::uint32_t address,
                    std::uint32_t bytes) const override;

  void check(const std::string& channel, std::uint32_t burst_beats, const DmaWidths& widths) const;
  void build_channels();
  void build_scatter_gather();
  void drive(Interrupt& interrupt);
  bool interrupts_differ() const;
  void expect_no_beat();
  std::uint64_t run_soft_reset(std::uint64_t cycle);
  void reset();

  std::unique_ptr<Mm2sChannel> mm2s_;
  std::unique_ptr<S2mmChannel> s2mm_;
  std::unique_ptr<ScatterGather> scatter_gather_;
  BufferCheck buffer_check_;
  std::vector<Interrupt> interrupts_;  ///< of the channels that are built
  std::uint64_t planned_ = 0;  ///< the next edge that runs, unless a signal wakes it earlier
  std::uint64_t beat_at_ = vp::Clock::never;  ///< edge that runs for a beat of S2MM besides
  bool stopped_ = false;
  void show_reset(bool is_active);

  std::vector<vp::Signal<bool>*> reset_outs_;
  bool resetting_ = false;
  std::uint64_t reset_done_at_ = vp::Clock::never;
};

}  // namespace xilinx
