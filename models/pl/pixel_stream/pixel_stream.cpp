#include <pl/pixel_stream/pixel_stream.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>

namespace pl {

namespace {

class PixelStreamClocked : public PixelStream {
 public:
  PixelStreamClocked(sc_core::sc_module_name name, const Site& site) : PixelStream(name, site) {}

 private:
  void edge() override;

  bool ena_before_ = false;
  std::uint32_t lane_ = 0;  ///< of the pixel that comes next
  std::uint32_t word_ = 0;
  vp::Probe<std::uint32_t> lane_probe_{"lane", lane_, 2};
};

void PixelStreamClocked::edge() {
  const bool frame = ena, before = std::exchange(ena_before_, frame);
  if (rst) {
    core_.reset();
    show_counts();
    m.withdraw();
    if (!frame) sleep();
    return;
  }
  PixelStreamCore::Input input;
  input.starts = frame && !before;
  input.ends = before && !frame;
  if (input.starts) lane_ = 0;
  if (frame) {
    word_ = word_ >> 8 | std::uint32_t{pixel} << 24;
    for (const vp::In<std::uint8_t>& next : more_pixels)
      word_ = word_ >> 8 | std::uint32_t{next} << 24;
    lane_ = (lane_ + geometry_.pixels_per_clock) % pixels_per_word;
    input.word = lane_ == 0;
    input.data = word_;
  }
  core_.step(input, m.tready);
  show_counts();
  drive();
  if (!frame && core_.rests(m.tready)) sleep();
}

/// Takes the words from the frame itself and tells the slave when they pass. The core catches up
/// with the present when it is read, simulating only the edges on which something happens. A slave
/// that wants single beats is shown each one.
class PixelStreamTlm final : public PixelStream, private vp::BeatSource, private FrameListener {
 public:
  PixelStreamTlm(sc_core::sc_module_name name, const Site& site) : PixelStream(name, site) {}

  void settle() override;

 private:
  void end_of_elaboration() override;
  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  std::uint64_t earliest_pass(std::uint32_t beats) override;
  Beats take(std::uint64_t cycle) override;
  void frame_begins() override;
  void frame_cut() override;

  std::uint32_t words() const { return frames_->size() / pixels_per_word; }
  std::uint32_t clocks_per_word() const { return pixels_per_word / geometry_.pixels_per_clock; }
  /// The edge that takes the last pixel of a word.
  std::uint64_t arrival(std::uint32_t word) const {
    return frames_->leaves_at(pixels_per_word * word + pixels_per_word - 1) + 1;
  }
  std::uint64_t next_input() const;
  std::uint64_t next_edge() const;
  void advance(std::uint64_t cycle);
  void run_edge(std::uint64_t cycle);
  PixelStreamCore::Input input_of(std::uint64_t cycle);
  bool pass_through(std::uint64_t cycle);
  void pass_out(std::uint64_t cycle);
  void note_beats(std::uint32_t count, bool last);
  void enter_reset(std::uint64_t cycle);
  void count();

  GreyFrames* frames_ = nullptr;
  bool lazy_ = false;   ///< the slave asks when beats pass
  bool ready_ = false;  ///< TREADY after edge cycle_
  bool in_reset_ = false;
  std::uint64_t cycle_ = 0;               ///< edge that was run last
  bool started_ = false;                  ///< the frame's first pixel came
  std::uint32_t next_word_ = 0;           ///< of the frame, that comes next
  std::uint64_t cut_ = vp::Clock::never;  ///< edge after which nothing of the frame comes
  std::uint64_t offered_ = 0;  ///< edge from which the beat in the output register is offered

  std::vector<std::uint32_t> passed_;  ///< words that passed, from taken_ on not taken yet
  std::vector<std::size_t> ends_;      ///< where in passed_ a packet ended
  std::size_t taken_ = 0;
  std::uint64_t beats_ = 0, packets_ = 0, stalls_ = 0;  ///< since they were counted last
};

void PixelStreamTlm::end_of_elaboration() {
  PixelStream::end_of_elaboration();
  frames_ = &frames.channel();
  frames_->add_listener(*this);
  lazy_ = m.slave_takes_source();
  if (lazy_) m.set_source(*this);
}

void PixelStreamTlm::edge() {
  sleep();
  const std::uint64_t cycle = clock().cycle();
  advance(cycle - 1);
  if (!lazy_) ready_ = m.tready;
  in_reset_ = rst;
  if (in_reset_) enter_reset(cycle);
  advance(cycle);
  count();
  if (lazy_) return m.wake_slave();
  drive();
  wake_at(next_edge());
}

// The slave may have asked already what passes on this edge.
void PixelStreamTlm::enter_reset(std::uint64_t cycle) {
  if (core_.valid() && ready_ && cycle_ < cycle) {
    pass_out(cycle);
  } else if (core_.valid()) {
    stalls_ += cycle - offered_;
  }
  core_.reset();
}

void PixelStreamTlm::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (!lazy_ || &signal != m.tready.signal()) return PixelStream::on_change(signal, id);
  advance(clock().cycle());
  count();
  ready_ = m.tready;
}

void PixelStreamTlm::settle() {
  if (!lazy_) return;
  advance(clock().cycle());
  count();
}

void PixelStreamTlm::count() {
  show_counts();
  if (lazy_)
    m.count(std::exchange(beats_, 0), std::exchange(packets_, 0), std::exchange(stalls_, 0));
}

// What waits of the frame before came long ago: see FrameChannel::drain_clocks.
void PixelStreamTlm::frame_begins() {
  advance(clock().cycle());
  count();
  started_ = false;
  next_word_ = 0;
  cut_ = vp::Clock::never;
  wake();
}

void PixelStreamTlm::frame_cut() {
  cut_ = std::min(cut_, clock().cycle());
  wake();
}

// ---- edge by edge

std::uint64_t PixelStreamTlm::next_input() const {
  if (next_word_ == words()) return vp::Clock::never;
  const std::uint64_t edge = started_ ? arrival(next_word_) : frames_->leaves_at(0) + 1;
  if (edge <= cut_) return edge;
  return started_ && cycle_ <= cut_ ? cut_ + 1 : vp::Clock::never;
}

std::uint64_t PixelStreamTlm::next_edge() const {
  return core_.rests(ready_) ? next_input() : cycle_ + 1;
}

void PixelStreamTlm::advance(std::uint64_t cycle) {
  for (std::uint64_t edge = next_edge(); edge <= cycle; edge = next_edge()) {
    if (!pass_through(cycle)) run_edge(edge);
  }
  cycle_ = std::max(cycle_, cycle);
}

void PixelStreamTlm::run_edge(std::uint64_t cycle) {
  cycle_ = cycle;
  const PixelStreamCore::Input input = input_of(cycle);
  if (in_reset_) return;
  if (core_.valid() && ready_) pass_out(cycle);
  const bool waited = core_.valid() && !ready_;
  core_.step(input, ready_);
  if (core_.valid() && !waited) offered_ = cycle;
}

PixelStreamCore::Input PixelStreamTlm::input_of(std::uint64_t cycle) {
  PixelStreamCore::Input input;
  if (next_input() != cycle) return input;
  if (cycle > cut_) {
    input.ends = true;
    return input;
  }
  if (!started_) input.starts = started_ = true;
  if (arrival(next_word_) != cycle) return input;
  input.word = true;
  std::memcpy(&input.data, frames_->data() + pixels_per_word * next_word_++, sizeof input.data);
  return input;
}

/// Words that nothing holds up, all that passed up to edge `cycle`. Those that are held have waited
/// for nothing but their turn.
bool PixelStreamTlm::pass_through(std::uint64_t cycle) {
  if (!ready_ || in_reset_ || core_.missing() == 0) return false;
  const std::uint32_t held = core_.held();
  const std::uint64_t first = arrival(next_word_ - held), until = std::min(cycle, cut_);
  if (until < first + 2 || (held != 0 && first + 2 <= cycle_)) return false;
  core_.take_back();
  next_word_ -= held;
  const auto count = static_cast<std::uint32_t>(
      std::min<std::uint64_t>((until - 2 - first) / clocks_per_word() + 1, core_.missing()));
  const std::size_t at = passed_.size();
  passed_.resize(at + count);
  std::memcpy(&passed_[at], frames_->data() + pixels_per_word * next_word_,
              count * sizeof passed_[0]);
  next_word_ += count;
  core_.skip(count);
  note_beats(count, core_.missing() == 0);
  cycle_ = arrival(next_word_ - 1) + 2;
  return true;
}

void PixelStreamTlm::pass_out(std::uint64_t cycle) {
  passed_.push_back(core_.out().data);
  note_beats(1, core_.out().last);
  stalls_ += cycle - offered_ - 1;
}

void PixelStreamTlm::note_beats(std::uint32_t count, bool last) {
  beats_ += count;
  if (!last) return;
  ++packets_;
  ends_.push_back(passed_.size());
}

// ---- for the slave

// Those that are held pass first, a beat a clock; behind them those of the frame that come.
std::uint64_t PixelStreamTlm::earliest_pass(std::uint32_t beats) {
  if (taken_ != passed_.size()) return cycle_;
  const std::uint32_t held = core_.held();
  const bool rests = held == 0 && core_.rests(true);
  const bool comes = next_word_ != words() && (core_.missing() != 0 || (rests && !started_));
  if (comes && beats > held) {
    const std::uint32_t word = std::min(next_word_ + beats - held, words()) - 1;
    if (arrival(word) <= cut_) return arrival(word) + 2;
    if (rests) return cut_ + 1;
  }
  return rests ? vp::Clock::never : cycle_ + std::min(beats, std::max(held, 1u));
}

vp::BeatSource::Beats PixelStreamTlm::take(std::uint64_t cycle) {
  advance(cycle);
  if (taken_ == passed_.size()) {
    passed_.clear();
    ends_.clear();
    taken_ = 0;
    return {};
  }
  const auto end = std::upper_bound(ends_.begin(), ends_.end(), taken_);
  const bool last = end != ends_.end();
  const std::size_t stop = last ? *end : passed_.size();
  const Beats beats{&passed_[taken_], static_cast<std::uint32_t>(stop - taken_), last};
  taken_ = stop;
  return beats;
}

}  // namespace

Models<PixelStream>& PixelStream::models() {
  static Models<PixelStream> models{
      "pixel_stream",
      {model<PixelStream, PixelStreamClocked>("clocked", by_pixel, no_image),
       model<PixelStream, PixelStreamTlm>("tlm", by_frame, no_image)},
      rtl_model<PixelStream, PixelStreamClocked>()};
  return models;
}

PixelStream::PixelStream(sc_core::sc_module_name name, const Site& site)
    : Clocked(name, site.clk),
      Ip(&site.clk),
      more_pixels("pixel", site.geometry.pixels_per_clock, this),
      core_(site.geometry.pixels() / pixels_per_word, fifo_depth),
      geometry_(site.geometry) {
  wake_on(rst);
  wake_on(ena);
  m.reset_by(rst);
  wake_on(m.tready);
}

void PixelStream::connect(IpPorts& ports) {
  ports.input(rst);
  ports.input(ena);
  ports.input(pixel, more_pixels);
  add_stream(ports, m);
  ports.report(dropped_frames);
  ports.report(cut_frames);
  ports.parameter("WIDTH", "pl.width", geometry_.width);
  ports.parameter("HEIGHT", "pl.height", geometry_.height);
  ports.parameter("FIFO_DEPTH", fifo_depth.name(), fifo_depth);
  ports.pixels_per_clock(geometry_.pixels_per_clock);
}

void PixelStream::show_counts() {
  dropped_frames = core_.dropped_frames();
  cut_frames = core_.cut_frames();
}

void PixelStream::drive() {
  if (core_.valid()) {
    m.offer(core_.out().data, core_.out().last);
  } else {
    m.withdraw();
  }
}

vp::IpEstimate PixelStream::own_estimate() const {
  vp::IpEstimate e = synthesised_ip(
      "pixel_stream",
      {{"PIXELS_PER_CLOCK", geometry_.pixels_per_clock}, {"FIFO_DEPTH", fifo_depth}});
  e.bram36 = fifo_memory(fifo_depth, 33);
  return e;
}

}  // namespace pl
