// The median filter of the design, at both fidelities.
#include "median.h"

#include <algorithm>
#include <array>
#include <deque>
#include <vector>

namespace {

/// The median of a pixel and its eight neighbours; pixels at the border pass as they are. Its
/// last neighbour is one line and one pixel behind it.
class Median : public pl::PixelFilter {
 protected:
  using PixelFilter::PixelFilter;

  /// Clocks from the one that takes a pixel to the one in which it leaves, filtered.
  std::uint32_t latency() const { return geometry_.width + 1; }

 private:
  vp::IpEstimate own_estimate() const override;
};

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
  MedianClocked(sc_core::sc_module_name name, const pl::Site& site)
      : Median(name, site), stages_(2 * geometry_.width + 3), at_rest_(stages_.size()) {}

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
    const Stage& centre = back(latency());
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
class MedianTlm final : public Median, private pl::FrameListener {
 public:
  MedianTlm(sc_core::sc_module_name name, const pl::Site& site) : Median(name, site) {
    for (auto& image : images_) image.resize(geometry_.pixels());
  }

 private:
  void end_of_elaboration() override {
    Median::end_of_elaboration();
    frames_in.channel().add_listener(*this);
  }
  void edge() override {
    sleep();
    const std::uint64_t cycle = clock().cycle();
    if (rst) {
      changes_.clear();
      ena_before_ = false;
      frame_ena = false;
      frames.cut();
      return wake_at(vp::Clock::never);
    }
    if (ena != ena_before_) {
      ena_before_ = ena;
      changes_.push_back({cycle + latency(), ena});
      if (ena) begin(cycle + latency());
    }
    if (!changes_.empty() && changes_.front().cycle == cycle) {
      frame_ena = changes_.front().value;
      changes_.pop_front();
    }
    wake_at(changes_.empty() ? vp::Clock::never : changes_.front().cycle);
  }
  void frame_begins() override { begins_ = true; }
  void begin(std::uint64_t first_cycle) {
    begins_ = false;
    frames.announce();
    current_ = 1 - current_;
    filter(0, geometry_.pixels());
    frames.begin(images_[current_].data(), geometry_.pixels(), first_cycle);
  }
  void pixels_changed(std::uint32_t first, std::uint32_t count) override {
    if (begins_) return;  // all of it will be filtered
    const std::uint32_t from = first > latency() ? first - latency() : 0;
    const std::uint32_t to = std::min(first + count + latency(), geometry_.pixels());
    filter(from, to);
    frames.change(from, to - from);
  }
  void filter(std::uint32_t from, std::uint32_t to) {
    const std::uint8_t* in = frames_in->data();
    for (std::uint32_t i = from; i < to; ++i) {
      const std::uint32_t x = i % geometry_.width, y = i / geometry_.width;
      images_[current_][i] = at_border(geometry_, x, y) ? in[i] : filtered(in + i);
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

  std::array<std::vector<std::uint8_t>, 2> images_;
  std::size_t current_ = 0;
  std::deque<Change> changes_;  ///< of frame_ena, to come
  bool ena_before_ = false;
  bool begins_ = false;  ///< a frame that was not filtered yet
};

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

}  // namespace

const pl::Models<pl::PixelFilter>& median_models() {
  static const pl::Models<pl::PixelFilter> models{
      "median",
      {pl::model<pl::PixelFilter, MedianClocked>("clocked", pl::by_pixel, pl::by_pixel),
       pl::model<pl::PixelFilter, MedianTlm>("tlm", pl::by_frame, pl::by_frame)}};
  return models;
}
