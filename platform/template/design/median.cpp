#include "median.h"

#include <algorithm>
#include <array>
#include <deque>
#include <stdexcept>
#include <vector>

namespace {

std::uint8_t median_of(std::array<std::uint8_t, 9> values) {
  std::nth_element(values.begin(), values.begin() + 4, values.end());
  return values[4];
}

bool at_border(const pl::Geometry& g, std::uint32_t x, std::uint32_t y) {
  return x == 0 || y == 0 || x + 1 == g.width || y + 1 == g.height;
}

/// Two lines and three pixels go by in a shift register; the output is taken in its middle.
class MedianClocked final : public Median {
 public:
  MedianClocked(sc_core::sc_module_name name, const pl::FilterSite& site)
      : Median(name, site), stages_(2 * site.geometry.width + 3), at_rest_(stages_.size()) {}

  pl::FrameChannel& frames() override { throw std::logic_error("a clocked filter has no frames"); }

 private:
  struct Stage {
    bool ena = false;
    std::uint8_t pixel = 0;
    std::uint16_t x = 0, y = 0;
  };

  void edge() override {
    if (rst) {
      std::fill(stages_.begin(), stages_.end(), Stage{});
      at_rest_ = stages_.size();
      frame_ena = false;
      return sleep();
    }
    newest_ = newest_ + 1 == stages_.size() ? 0 : newest_ + 1;
    stages_[newest_] = ena ? Stage{true, pixel, x, y} : Stage{};
    at_rest_ = ena ? 0 : at_rest_ + 1;
    const Stage& centre = back(geometry_.width + 1);
    frame_ena = centre.ena;
    if (centre.ena) {
      pixel_out = at_border(geometry_, centre.x, centre.y) ? centre.pixel : filtered();
      pixel_x = centre.x;
      pixel_y = centre.y;
    } else if (at_rest_ > stages_.size()) {
      sleep();
    }
  }
  /// What came so many clocks ago.
  const Stage& back(std::uint32_t clocks) const {
    return stages_[newest_ >= clocks ? newest_ - clocks : newest_ + stages_.size() - clocks];
  }
  std::uint8_t filtered() const {
    std::array<std::uint8_t, 9> values{};
    for (std::uint32_t row = 0, i = 0; row < 3; ++row) {
      for (std::uint32_t column = 0; column < 3; ++column)
        values[i++] = back(row * geometry_.width + column).pixel;
    }
    return median_of(values);
  }

  std::vector<Stage> stages_;
  std::size_t newest_ = 0;
  std::size_t at_rest_;  ///< clocks without a pixel
};

/// Filters a frame when it begins, and again what changes before it left the sensor; `frame_ena`
/// follows the sensor's at its clocks.
class MedianTlm final : public Median, public pl::FrameChannel, private pl::FrameListener {
 public:
  MedianTlm(sc_core::sc_module_name name, const pl::FilterSite& site)
      : Median(name, site), source_(site.source) {
    for (auto& frame : frames_) frame.resize(geometry_.pixels());
    source_.add_listener(*this);
  }

  pl::FrameChannel& frames() override { return *this; }
  const std::uint8_t* pixels() const override { return frames_[current_].data(); }

 private:
  void edge() override {
    sleep();
    const std::uint64_t cycle = clock().cycle();
    if (rst) {
      changes_.clear();
      ena_before_ = false;
      frame_ena = false;
      return wake_at(vp::Clock::never);
    }
    if (ena != ena_before_) {
      ena_before_ = ena;
      changes_.push_back({cycle + geometry_.width + 1, ena});
      if (ena) begin();
    }
    if (!changes_.empty() && changes_.front().cycle == cycle) {
      frame_ena = changes_.front().value;
      changes_.pop_front();
    }
    wake_at(changes_.empty() ? vp::Clock::never : changes_.front().cycle);
  }
  void frame_begins() override { begins_ = true; }
  void begin() {
    begins_ = false;
    current_ = 1 - current_;
    filter(0, geometry_.pixels());
  }
  void pixels_changed(std::uint32_t first, std::uint32_t count) override {
    if (begins_) return;  // all of it will be filtered
    const std::uint32_t reach = geometry_.width + 1;
    const std::uint32_t from = first > reach ? first - reach : 0;
    const std::uint32_t to = std::min(first + count + reach, geometry_.pixels());
    filter(from, to);
    for (pl::FrameListener* listener : listeners_) listener->pixels_changed(from, to - from);
  }
  void filter(std::uint32_t from, std::uint32_t to) {
    const std::uint8_t* in = source_.pixels();
    for (std::uint32_t i = from; i < to; ++i) {
      const std::uint32_t x = i % geometry_.width, y = i / geometry_.width;
      frames_[current_][i] = at_border(geometry_, x, y) ? in[i] : filtered(in + i);
    }
  }
  std::uint8_t filtered(const std::uint8_t* centre) const {
    const auto width = static_cast<std::ptrdiff_t>(geometry_.width);
    std::array<std::uint8_t, 9> values{};
    std::size_t i = 0;
    for (std::ptrdiff_t row : {-width, std::ptrdiff_t{0}, width}) {
      for (std::ptrdiff_t column : {-1, 0, 1}) values[i++] = centre[row + column];
    }
    return median_of(values);
  }

  struct Change {
    std::uint64_t cycle;
    bool value;
  };

  pl::FrameChannel& source_;
  std::array<std::vector<std::uint8_t>, 2> frames_;
  std::size_t current_ = 0;
  std::deque<Change> changes_;  ///< of frame_ena, to come
  bool ena_before_ = false;
  bool begins_ = false;  ///< a frame that was not filtered yet
};

}  // namespace

// Two line buffers of block memory, nine registers, and 19 compare-and-exchange steps.
vp::IpEstimate Median::own_estimate() const {
  vp::IpEstimate e;
  e.lut = 19 * 16 + 80;
  e.ff = 9 * 8 + 19 * 16 + 60;
  e.bram36 = 1;
  e.uncertainty_percent = 40;
  e.source = "derived: sorting network of 19 steps, two lines of 8 bit";
  e.fmax_hz = 120'000'000;
  e.fmax_documentation = "assumed: a register behind every second step";
  return e;
}

std::unique_ptr<pl::PixelFilter> make_median(const pl::FilterSite& site) {
  if (site.fidelity == pl::Fidelity::tlm) return std::make_unique<MedianTlm>("median", site);
  return std::make_unique<MedianClocked>("median", site);
}
