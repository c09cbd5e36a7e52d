#pragma once

#include <array>
#include <cstdint>
#include <deque>

#include <blob_stream.h>
#include <pl/common/fidelity.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/probe.h>

namespace pl {

class IpPorts;

/// Sends the blobs of each frame as one packet (blob_stream.h).
///
/// A blob for which the FIFO has no room, or that leaves while another one is sent, is dropped
/// whole and counted; room is what there was before the clock. A frame that begins while the slave
/// is not ready, or the packet of the one before is under way, is dropped whole, with all its
/// blobs.
class BlobStream : public vp::Clocked, public vp::Ip {
 public:
  static Models<BlobStream>& models();

  vp::In<bool> rst{"rst", this};
  vp::In<bool> frame_ena{"frame_ena", this};  ///< the camera's
  vp::In<std::uint32_t> frame_number{"frame_number", this};
  vp::In<std::uint8_t> threshold{"threshold", this};
  // Of the labelling.
  vp::In<bool> idle{"idle", this};  ///< all blobs of the frame have left
  vp::In<bool> blob_out{"blob_out", this};
  std::array<vp::In<std::uint32_t>, ::blob_stream::words_per_blob> extreme;
  vp::In<std::uint32_t> label_overflow{"label_overflow", this};  ///< pixels, since the last reset
  vp::AxiStreamMaster m{"m", *this};

  /// High from the frame's first pixel until the last word of its packet is in the FIFO.
  vp::Signal<bool> busy{"busy"};
  vp::Signal<std::uint16_t> fifo_count{"fifo_count"};
  // No ports of the IP: for traces and reports. Since the last reset.
  vp::Signal<std::uint32_t> dropped_frames{"dropped_frames"};
  vp::Signal<std::uint32_t> dropped_blobs{"dropped_blobs"};

  vp::Parameter<std::uint32_t> fifo_depth{
      "fifo_depth",         512,
      vp::Unit::none,       {::blob_stream::words_per_blob, 65535},
      vp::Source::decision, "words that wait for the DMA, besides the output register"};
  vp::Parameter<bool> checksum{
      "checksum", false, vp::Source::decision,
      "the packet ends with a sum of its words, with which the software finds wrong ones"};
  vp::Signal<std::uint32_t> depth{"depth", 17, fifo_depth};  ///< for traces: what is full

 protected:
  BlobStream(sc_core::sc_module_name name, const Site& site);
  /// All ports but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);

 private:
  vp::IpEstimate own_estimate() const override;
};

/// Blob Stream clock by clock, and the model for both fidelities: it works only while there is a
/// blob.
class BlobStreamClocked : public BlobStream {
 public:
  BlobStreamClocked(sc_core::sc_module_name name, const Site& site) : BlobStream(name, site) {}

 private:
  struct Word {
    std::uint32_t data;
    bool last;
  };

  void edge() override;
  void reset();
  void offer();
  void fill_fifo(bool room);
  void begin_frame(bool free);
  void take_blob(bool room);
  void end_frame();
  bool may_sleep() const;

  std::deque<Word> fifo_;
  std::deque<Word> sender_;  ///< a blob, or the trailer, on its way into the FIFO, a word a clock
  bool frame_before_ = false;
  bool dropping_ = false;  ///< the frame under way gets no packet
  bool mixed_ = false;     ///< another one began in it: its blobs are not the packet's
  std::uint32_t number_ = 0, threshold_ = 0, sent_ = 0, lost_ = 0, overflow_before_ = 0;
  std::uint32_t sum_ = 0;  ///< of the packet's words in or behind the FIFO
  vp::Probe<std::uint32_t> sent_probe_{"sent", sent_, 13};
};

}  // namespace pl
