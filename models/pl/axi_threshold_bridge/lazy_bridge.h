#pragma once

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include <pl/common/frame_channel.h>
#include <pl/feature_packaging/core.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>

namespace pl {

/// The threshold bridge and its clock crossing without an event for each word: the registers are
/// brought up to date when they are read, simulating only the edges on which something happens.
class LazyBridge {
 public:
  /// `fifo_depth` words besides the output register, `burst_words` words a packet.
  LazyBridge(const BinaryFrames& binary, const vp::Clock& system_clk, std::uint32_t fifo_depth,
             std::uint32_t burst_words);

  /// Runs all system-clock edges up to and including `cycle`.
  void advance(std::uint64_t cycle);
  /// TREADY after the edge that was run last.
  void set_ready(bool ready) { ready_ = ready; }
  /// The system side's state after a reset on the edge that was run last; while it lasts, words
  /// that arrive are not taken.
  void hold_in_reset(bool hold);
  /// Counts words that were overwritten up to now, too, where no edge of the system clock has
  /// followed. For access from outside, between instants.
  void settle();

  /// Before and after a change of either clock's frequency.
  void clock_changes() { advance(system_clock_.cycle()); }
  void clock_changed();

  /// The words of the frame before are about to be overwritten; those under way are kept.
  void frame_begins();
  /// The pixel side is reset on its present edge.
  void frame_cut();

  /// See vp::BeatSource.
  std::uint64_t earliest_pass(std::uint32_t beats);
  vp::BeatSource::Beats take();

  std::uint32_t overflow() const { return overflow_; }
  /// See AxiThresholdBridge::packet_peak().
  std::uint32_t packet_peak() const { return packet_peak_; }
  /// What happened since the last call.
  struct Counts {
    std::uint64_t beats = 0, packets = 0;  ///< that passed
    std::uint64_t stalls = 0;              ///< edges on which a word waited for TREADY
    std::uint32_t lost = 0;                ///< words that were overwritten in the crossing
  };
  Counts take_counts() { return std::exchange(counts_, {}); }

 private:
  /// A word behind the threshold, with the pixel-clock edge at which the crossing takes it.
  struct Word {
    std::uint64_t crossing;
    std::uint32_t data;
  };

  /// The edge on which the crossing takes a word of the present frame: one behind its last pixel.
  std::uint64_t crossing_of(std::uint32_t word) const { return binary_.leaves_at(32 * word + 32); }
  std::uint64_t arrival(std::uint64_t crossing) const;
  bool next_word(Word& word) const;
  void drop_word();
  bool pending() const { return toggle_ != seen_; }
  void send(const Word& word);
  void send_through(std::uint64_t crossing);
  void plan();
  void step(std::uint64_t edge);
  void run_through(std::uint64_t edge);
  std::uint64_t last_crossing(std::uint64_t cycle) const;
  bool words_are_far_apart() const;
  bool run_many_through(std::uint64_t cycle);
  void end_packet();
  void offer();
  void pass();
  void arrive(std::uint32_t waiting);
  std::uint64_t next_edge() const;

  const vp::Clock& pixel_clock_;
  const vp::Clock& system_clock_;
  const BinaryFrames& binary_;
  const std::uint32_t fifo_depth_, burst_words_;

  std::deque<Word> late_;                     ///< of the frame before, still in the crossing
  std::uint32_t next_ = 0;                    ///< word of the present frame that arrives next
  std::uint64_t arrives_ = vp::Clock::never;  ///< system-clock edge on which the next word is taken

  // The crossing's register as CrossingRegister has it: a word is seen by its toggle, which a reset
  // of one side alone turns, too.
  bool toggle_ = false, seen_ = false;
  std::uint32_t crossing_word_ = 0;

  FeatureBuffer fifo_;
  std::uint32_t out_ = 0;  ///< the output register
  bool last_ = false;      ///< its TLAST
  bool valid_ = false;
  std::uint64_t offered_ = 0;  ///< edge from which the word in the output register is offered
  std::uint32_t in_packet_ = 0;
  std::vector<std::uint32_t> passed_;  ///< words that passed, from taken_ on not taken yet
  std::vector<std::size_t> ends_;      ///< where in passed_ a packet ended
  std::size_t taken_ = 0;

  bool ready_ = false;
  bool in_reset_ = false;
  std::uint64_t cycle_ = 0;  ///< edge that was run last
  std::uint32_t overflow_ = 0;
  std::uint32_t peak_ = 0, packet_peak_ = 0;
  Counts counts_;

  std::uint64_t ratio_ = 0;  ///< system clocks a pixel clock, if whole since time 0; else 0
  std::uint64_t changed_pixel_ = 0, changed_system_ = 0;  ///< cycles at the last clock change
};

}  // namespace pl
