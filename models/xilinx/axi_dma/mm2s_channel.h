#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include <vp/axi_stream.h>
#include <xilinx/axi_dma/dma_channel.h>

namespace xilinx {

/// Memory to stream: reads bursts ahead into a FIFO and sends one beat per clock.
class Mm2sChannel : public DmaChannel, public vp::BurstSender {
 public:
  Mm2sChannel(Core& core, vp::RegisterBank& bank, vp::Clocked& owner, std::uint32_t burst_beats,
              const DmaWidths& widths);

  MemoryPort m_axi;
  vp::AxiStreamMaster m_axis;

  bool quiet(std::uint64_t cycle) const override;
  void settle(std::uint64_t cycle) override;

 private:
  /// A burst whose data is on its way or in the FIFO.
  struct Burst {
    std::uint64_t first = 0;  ///< edge of its first beat
    unsigned lead = 0;        ///< bytes of the first word before the transfer
    bool pending = false;     ///< the memory port's thread is still at it
    tlm::tlm_response_status response = tlm::TLM_OK_RESPONSE;
    std::vector<unsigned char> data;
  };

  void begin(const Segment& segment, std::uint64_t first_cycle) override;
  bool accepts_segment() const override;
  std::uint64_t move(std::uint64_t cycle) override;
  void sample(std::uint64_t cycle) override;
  void abandon() override;
  void forget_bursts() override;
  void completed() override;

  void request(std::uint64_t cycle);
  std::uint64_t next_request_at(std::uint64_t cycle) const;
  unsigned burst_bytes() const;
  void schedule(Burst& burst, std::uint64_t cycle);
  bool offer(std::uint64_t cycle);
  bool collect(unsigned char* beat, unsigned bytes);
  void show(const unsigned char* beat, unsigned bytes, bool last);
  void withdraw();
  void end_segment(std::uint64_t cycle);
  std::uint64_t next_edge(std::uint64_t cycle) const;
  std::uint64_t next_beat_at() const;
  bool take_whole_burst(std::uint64_t cycle);

  const unsigned clocks_per_beat_;
  const unsigned burst_size_;  ///< bytes
  const unsigned fifo_size_;   ///< bytes
  std::deque<Burst> bursts_;
  std::uint64_t read_address_ = 0;
  std::uint32_t to_request_ = 0;  ///< bytes of the transfer not requested yet
  std::deque<Segment> segments_;  ///< under way; the first is being sent
  std::uint32_t to_send_ = 0;     ///< bytes of that one not offered yet
  std::uint32_t buffered_ = 0;    ///< bytes requested and not offered yet
  unsigned taken_ = 0;            ///< bytes of the first burst offered already
  std::uint64_t request_at_ = 0;
  std::uint64_t bus_busy_until_ = 0;
  bool offering_ = false;  ///< tvalid, as driven last
  bool accepted_ = false;  ///< the beat on offer passed on this edge
  bool in_packet_ = false;
  std::vector<std::uint32_t>
      whole_burst_;                ///< begins with the words that go to a sink in one call,
  std::uint32_t whole_words_ = 0;  ///< so many
  std::uint64_t whole_first_ = 0;  ///< edge from which its first beat is on offer
};

}  // namespace xilinx
