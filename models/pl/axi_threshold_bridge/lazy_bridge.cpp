#include <pl/axi_threshold_bridge/lazy_bridge.h>

#include <algorithm>

namespace pl {

namespace {

constexpr std::uint64_t never = vp::Clock::never;

}  // namespace

LazyBridge::LazyBridge(const BinaryFrames& binary, const vp::Clock& system_clk,
                       std::uint32_t fifo_depth, std::uint32_t burst_words)
    : pixel_clock_(binary.clock()),
      system_clock_(system_clk),
      binary_(binary),
      fifo_depth_(fifo_depth),
      burst_words_(burst_words),
      fifo_(fifo_depth) {
  const std::uint64_t pixel = pixel_clock_.frequency_hz(), system = system_clock_.frequency_hz();
  if (pixel != 0 && system % pixel == 0) ratio_ = system / pixel;
}

// A word is in the crossing's register after its edge, and seen by the next edge of the system
// clock; at coincident edges that clock comes first.
std::uint64_t LazyBridge::arrival(std::uint64_t crossing) const {
  if (ratio_ != 0) return crossing * ratio_ + 1;
  if (crossing <= changed_pixel_) return changed_system_ + 1;
  const std::uint64_t crossed = pixel_clock_.time_of(crossing);
  return crossed == never ? never : system_clock_.cycle_at_or_after(crossed + 1);
}

bool LazyBridge::next_word(Word& word) const {
  if (!late_.empty()) {
    word = late_.front();
    return true;
  }
  if (next_ >= binary_.size()) return false;
  word = {crossing_of(next_), binary_.data()[next_]};
  return true;
}

void LazyBridge::drop_word() {
  if (!late_.empty()) {
    late_.pop_front();
  } else {
    ++next_;
  }
}

void LazyBridge::plan() {
  Word word;
  if (pending()) {
    arrives_ = in_reset_ ? never : cycle_ + 1;
  } else {
    arrives_ = next_word(word) ? arrival(word.crossing) : never;
  }
}

// See CrossingRegister::send().
void LazyBridge::send(const Word& word) {
  if (pending()) {
    ++counts_.lost;
  } else {
    toggle_ = !toggle_;
  }
  crossing_word_ = word.data;
  drop_word();
}

void LazyBridge::send_through(std::uint64_t crossing) {
  Word word{};
  while (next_word(word) && word.crossing <= crossing) send(word);
}

void LazyBridge::settle() {
  advance(system_clock_.cycle());
  send_through(pixel_clock_.cycle());
  plan();
}

void LazyBridge::frame_begins() {
  advance(system_clock_.cycle());
  for (; next_ < binary_.size(); ++next_) {
    late_.push_back({crossing_of(next_), binary_.data()[next_]});
  }
  next_ = 0;
  arrives_ = never;  // the next look plans, with the new frame
}

void LazyBridge::frame_cut() {
  advance(system_clock_.cycle());
  send_through(pixel_clock_.cycle() - 1);
  toggle_ = false;
  late_.clear();
  next_ = binary_.size();
  plan();
}

void LazyBridge::clock_changed() {
  ratio_ = 0;
  changed_pixel_ = pixel_clock_.cycle();
  changed_system_ = system_clock_.cycle();
  plan();
}

std::uint64_t LazyBridge::next_edge() const {
  const bool moves = valid_ ? ready_ : fifo_.count() != 0;
  return moves ? cycle_ + 1 : arrives_;
}

void LazyBridge::advance(std::uint64_t cycle) {
  if (arrives_ == never) plan();
  for (std::uint64_t edge = next_edge(); edge <= cycle; edge = next_edge()) {
    if (edge == arrives_ && ready_ && !valid_ && edge + 2 <= cycle) {
      if (!run_many_through(cycle)) run_through(edge);
    } else {
      step(edge);
    }
  }
  cycle_ = std::max(cycle_, cycle);
}

// One edge of the bridge, computed from the state before it.
void LazyBridge::step(std::uint64_t edge) {
  const std::uint32_t waiting = fifo_.count();
  cycle_ = edge;
  if (valid_ && ready_) pass();
  if (!valid_ && waiting != 0) offer();
  if (edge == arrives_) arrive(waiting);
  peak_ = std::max(peak_, fifo_.count());
}

// A word that arrives in an empty bridge is offered one edge later and passes after another.
void LazyBridge::run_through(std::uint64_t edge) {
  const std::uint32_t waiting = fifo_.count();
  if (waiting != 0) return step(edge);
  cycle_ = edge;
  arrive(waiting);
  peak_ = std::max(peak_, fifo_.count());
  if (fifo_.count() == 0 || arrives_ <= edge + 2) return;
  cycle_ = edge + 1;
  offer();
  cycle_ = edge + 2;
  pass();
}

// The last edge of the pixel clock on which a word crosses that passes by `cycle`, two edges behind
// its arrival.
std::uint64_t LazyBridge::last_crossing(std::uint64_t cycle) const {
  if (ratio_ != 0) return (cycle - 3) / ratio_;
  return pixel_clock_.cycle_at_or_after(system_clock_.time_of(cycle - 2)) - 1;
}

// From one word to the next, 32 pixels, are four edges of the system clock or more: they arrive at
// least three apart, whatever the clocks' phase.
bool LazyBridge::words_are_far_apart() const {
  return pixel_clock_.frequency_hz() <= 8 * system_clock_.frequency_hz();
}

// The same for as many words of a packet as there are, where their arrivals are far enough apart.
bool LazyBridge::run_many_through(std::uint64_t cycle) {
  if (fifo_.count() != 0 || in_reset_ || pending() || !late_.empty()) return false;
  const bool crosses_since_change =
      crossing_of(next_) > changed_pixel_ && cycle - 2 > changed_system_;
  if (!crosses_since_change || !words_are_far_apart()) return false;
  const std::uint64_t arrived = (last_crossing(cycle) - crossing_of(next_)) / 32 + 1;
  const auto count = static_cast<std::uint32_t>(
      std::min<std::uint64_t>({arrived, binary_.size() - next_, burst_words_ - in_packet_}));
  const std::uint32_t* words = binary_.data() + next_;
  passed_.insert(passed_.end(), words, words + count);
  next_ += count;
  in_packet_ += count;
  counts_.beats += count;
  peak_ = std::max(peak_, 1u);  // each waits for one clock
  toggle_ = seen_ = toggle_ != (count % 2 != 0);
  crossing_word_ = words[count - 1];
  if (in_packet_ == burst_words_) {
    in_packet_ = 0;
    end_packet();
  }
  cycle_ = arrival(crossing_of(next_ - 1)) + 2;
  plan();
  return true;
}

void LazyBridge::end_packet() {
  ends_.push_back(passed_.size());
  ++counts_.packets;
  packet_peak_ = std::exchange(peak_, 0);
}

void LazyBridge::offer() {
  const bool last = ++in_packet_ == burst_words_;
  if (last) in_packet_ = 0;
  out_ = fifo_.pop();
  last_ = last;
  valid_ = true;
  offered_ = cycle_;
}

void LazyBridge::pass() {
  passed_.push_back(out_);
  if (last_) end_packet();
  valid_ = false;
  ++counts_.beats;
  counts_.stalls += cycle_ - offered_ - 1;
}

void LazyBridge::arrive(std::uint32_t waiting) {
  Word word{};
  while (next_word(word) && arrival(word.crossing) <= cycle_) send(word);
  if (!in_reset_) {
    seen_ = toggle_;
    if (waiting < fifo_depth_) {
      fifo_.push(crossing_word_);
    } else {
      ++overflow_;
    }
  }
  plan();
}

void LazyBridge::hold_in_reset(bool hold) {
  in_reset_ = hold;
  if (hold) {
    if (valid_) counts_.stalls += cycle_ - offered_;
    fifo_.clear();
    valid_ = false;
    in_packet_ = 0;
    overflow_ = 0;
    peak_ = packet_peak_ = 0;
    seen_ = false;
  }
  plan();
}

std::uint64_t LazyBridge::earliest_pass(std::uint32_t beats) {
  if (arrives_ == never) plan();
  if (taken_ != passed_.size()) return cycle_;
  beats = std::min(beats, burst_words_ - in_packet_ + (valid_ && !last_ ? 1 : 0));
  if (valid_ && last_) beats = 1;
  const std::uint32_t held = fifo_.count() + (valid_ ? 1 : 0);
  if (beats <= held) return cycle_ + beats;
  std::uint32_t words_ahead = beats - held - 1;
  if (pending()) {
    if (words_ahead == 0) return in_reset_ ? never : cycle_ + 3;
    --words_ahead;
  }
  if (words_ahead < late_.size()) return arrival(late_[words_ahead].crossing) + 2;
  const std::uint64_t index = std::uint64_t{next_} + words_ahead - late_.size();
  if (index >= binary_.size()) return never;
  return arrival(crossing_of(static_cast<std::uint32_t>(index))) + 2;
}

vp::BeatSource::Beats LazyBridge::take() {
  if (taken_ == passed_.size()) {
    passed_.clear();
    ends_.clear();
    taken_ = 0;
    return {};
  }
  const auto end = std::upper_bound(ends_.begin(), ends_.end(), taken_);
  const bool last = end != ends_.end();
  const std::size_t stop = last ? *end : passed_.size();
  const vp::BeatSource::Beats beats{&passed_[taken_], static_cast<std::uint32_t>(stop - taken_),
                                    last};
  taken_ = stop;
  return beats;
}

}  // namespace pl
