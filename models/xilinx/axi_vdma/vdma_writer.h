#pragma once

#include <vp/axi_stream.h>
#include <xilinx/axi_vdma/vdma_channel.h>

#include <cstdint>
#include <deque>
#include <vector>

namespace xilinx {

/// S2MM: frames from a stream into memory. A frame begins with TUSER(0), a line ends with TLAST.
/// What comes before the first, behind a line's HSIZE bytes and behind VSIZE lines is taken and
/// dropped; it and what is missing raise errors, and the next frame is whole again (flush on
/// frame sync). A frame that came as a whole is written before the next one begins: TREADY is low
/// for as long (assumed; streams of video pause there).
class VdmaWriter : public VdmaChannel {
 public:
  VdmaWriter(sc_core::sc_module_name name, vp::Clock& clock, vp::RegisterBank& bank,
             const VdmaChannelBuild& build, std::uint32_t frame_stores, vp::Signal<bool>& introut);
  const char* kind() const override { return "xilinx::VdmaWriter"; }

  vp::Parameter<std::uint32_t> write_clocks;
  vp::Parameter<std::uint32_t> gap_clocks;

  vp::AxiStreamSlave s_axis{"s_axis_s2mm", *this};

  bool in_frame() const override { return in_frame_; }

 private:
  struct Burst {
    std::uint64_t ready = 0;  ///< edge from which its address may go out
    std::uint64_t address = 0;
    std::vector<unsigned char> data;
  };
  enum class Bus { free, busy, answering };
  struct StreamError {
    std::uint32_t status, irq_mask;  ///< bits of S2MM_VDMASR and of S2MM_VDMA_IRQ_MASK
    const char* text;
  };
  static const StreamError few_lines, short_line, many_lines, long_line;

  void end_of_elaboration() override;
  void edge() override;
  void started() override;
  void abandon() override;
  std::uint32_t next_store(const VdmaChannel* other) const override;

  void take_beat(std::uint64_t cycle);
  void begin();
  void take_bytes(const vp::StreamBytes& beat, std::uint64_t cycle);
  void end_line(std::uint64_t cycle);
  void close_burst(std::uint64_t cycle);
  void report(const StreamError& error);
  void drive_bus(std::uint64_t cycle);
  std::uint64_t next_edge(std::uint64_t cycle) const;

  vp::Register& irq_mask_;
  const vp::Signal<std::uint32_t>* start_of_frame_ = nullptr;  ///< TUSER; null: no frame begins
  Frame frame_;
  bool in_frame_ = false;     ///< it is not in memory as a whole
  bool is_closed_ = true;     ///< all its lines came
  bool is_too_long_ = false;  ///< the line, which was reported
  bool was_late_ = false;     ///< beats behind the frame, which were reported
  std::uint32_t line_ = 0, byte_ = 0;
  std::uint32_t buffered_ = 0;  ///< bytes taken and not in memory
  std::vector<unsigned char> collected_;
  std::deque<Burst> bursts_;
  Bus bus_ = Bus::free;
  bool dropped_ = false;  ///< the burst on the bus is of a frame that was abandoned
  std::uint64_t burst_end_ = 0, bus_free_at_ = 0;
};

}  // namespace xilinx
