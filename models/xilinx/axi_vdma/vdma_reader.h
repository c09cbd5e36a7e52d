#pragma once

#include <vp/axi_stream.h>
#include <xilinx/axi_vdma/vdma_channel.h>

#include <cstdint>
#include <deque>
#include <vector>

namespace xilinx {

/// MM2S: frames from memory, one after the other (free run). Reads bursts ahead as far as its line
/// buffer has room, and sends a beat a clock: TUSER(0) with the first of a frame, TLAST with the
/// last of a line.
class VdmaReader : public VdmaChannel {
 public:
  VdmaReader(sc_core::sc_module_name name, vp::Clock& clock, vp::RegisterBank& bank,
             const VdmaChannelBuild& build, std::uint32_t frame_stores, vp::Signal<bool>& introut);
  const char* kind() const override { return "xilinx::VdmaReader"; }

  vp::Parameter<std::uint32_t> address_clocks;
  vp::Parameter<std::uint32_t> read_clocks;
  vp::Parameter<std::uint32_t> stream_clocks;
  vp::Parameter<std::uint32_t> gap_clocks;

  vp::AxiStreamMaster m_axis{"m_axis_mm2s", *this};

  bool in_frame() const override { return in_frame_; }

 private:
  /// A place in a frame.
  struct Position {
    std::uint32_t line = 0, byte = 0;
  };
  struct Burst {
    std::uint64_t address = 0;
    std::uint64_t first = 0;  ///< edge on which its first beat can go on
    bool pending = true;      ///< the memory port's thread is still at it
    std::vector<unsigned char> data;
  };

  void end_of_elaboration() override;
  void edge() override;
  void started() override;
  void abandon() override;
  std::uint32_t next_store(const VdmaChannel* other) const override;

  std::uint32_t burst_bytes() const;
  bool can_request(std::uint64_t cycle) const;
  void request(std::uint64_t cycle);
  void schedule(Burst& burst, std::uint64_t cycle);
  std::uint64_t beat_at(std::uint32_t bytes) const;
  bool offer(std::uint64_t cycle);
  std::uint64_t next_edge(std::uint64_t cycle) const;

  vp::Signal<std::uint32_t>* start_of_frame_ = nullptr;  ///< TUSER
  Frame frame_;
  bool in_frame_ = false;
  bool offering_ = false;
  Position asked_, sent_;
  std::deque<Burst> bursts_;
  std::uint32_t taken_ = 0;     ///< bytes of the first burst that were sent
  std::uint32_t buffered_ = 0;  ///< bytes asked for and not sent
  std::uint64_t begin_at_ = never, ask_at_ = 0;
};

}  // namespace xilinx
