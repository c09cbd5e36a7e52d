// C.5: the corner detection finds the one corner of a picture. Beside it a view of the 3x3 array of
// corners that enters the suppression, computed with the core's own functions from the 9x9 window.
#include "suppression_example.h"

#include <pl/corner_detection/corner_detection.h>

#include <algorithm>

#include "bench.h"
#include "worked_corner.h"

namespace appendix_c {

namespace {

constexpr unsigned width = 64, height = 32;
constexpr unsigned corner_x = 20, corner_y = 12;
/// The pixel that completes the window around the corner is there from this edge on.
constexpr std::uint64_t window_edge = (corner_y + 4) * width + (corner_x + 4) + 1;

struct Offset {
  int x, y;
};
constexpr Offset circle_offsets[16] = {{0, -3}, {1, -3},  {2, -2},  {3, -1}, {3, 0},  {3, 1},
                                       {2, 2},  {1, 3},   {0, 3},   {-1, 3}, {-2, 2}, {-3, 1},
                                       {-3, 0}, {-3, -1}, {-2, -2}, {-1, -3}};

unsigned index_of(unsigned x, unsigned y, Offset offset = {0, 0}) {
  return static_cast<unsigned>(static_cast<int>(y) + offset.y) * width +
         static_cast<unsigned>(static_cast<int>(x) + offset.x);
}

std::vector<std::uint8_t> picture() {
  std::vector<std::uint8_t> image(width * height, background_level);
  const pl::fast::Circle circle = worked_circle();
  image[index_of(corner_x, corner_y)] = point_level;
  for (unsigned n = 0; n < 16; ++n) {
    image[index_of(corner_x, corner_y, circle_offsets[n])] = circle[n];
  }
  return image;
}

/// The nine FAST modules side by side and the first clock of the suppression, as the thesis builds
/// them.
class CornerArrayView : public vp::Clocked {
 public:
  CornerArrayView(sc_core::sc_module_name name, vp::Clock& clk) : Clocked(name, clk) {}

  vp::In<bool> ena{"ena", this};
  vp::In<std::uint8_t> pixel{"pixel", this};
  vp::In<std::uint16_t> x{"x", this}, y{"y", this};
  SignalArray<std::uint16_t> strength{"strength", 9, 12};
  SignalArray<bool> contiguous{"contiguous", 9};
  SignalArray<std::uint16_t> row_strength{"row_strength", 3, 12};

 private:
  /// Newest pixel of a window; 0, 0 while missing.
  struct Position {
    unsigned x = 0, y = 0;
  };

  void edge() override {
    for (unsigned row = 0; row < 3; ++row) row_strength[row] = strongest_of(row);
    for (unsigned i = 0; i < 9; ++i) evaluate(i);
    threshold_ = window_;
    if (ena) {
      pixels_[index_of(x, y)] = pixel;
      window_ = x >= 8 && y >= 8 ? Position{x, y} : Position{};
    }
  }
  std::uint16_t strongest_of(unsigned row) {
    std::uint16_t strongest = 0;
    for (unsigned i = 3 * row; i < 3 * row + 3; ++i) {
      if (contiguous[i]) strongest = std::max(strongest, strength[i].get());
    }
    return strongest;
  }
  void evaluate(unsigned i) {
    pl::fast::Thresholded result;
    if (threshold_.y != 0) {
      const unsigned poi_x = threshold_.x - 5 + i % 3, poi_y = threshold_.y - 5 + i / 3;
      pl::fast::Circle circle;
      for (unsigned n = 0; n < 16; ++n) {
        circle[n] = pixels_[index_of(poi_x, poi_y, circle_offsets[n])];
      }
      result = pl::fast::threshold(circle, pixels_[index_of(poi_x, poi_y)], corner_threshold);
    }
    strength[i] = static_cast<std::uint16_t>(pl::fast::strength(result.difference));
    contiguous[i] = pl::fast::contiguous(result.bright);
  }

  std::vector<std::uint8_t> pixels_ = std::vector<std::uint8_t>(width * height);
  Position window_, threshold_;
};

struct SuppressionBench : sc_core::sc_module {
  SuppressionBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
      : sc_module(name), clk("clk", scheduler, clock_hz) {
    corner_detection.ena(source.ena);
    corner_detection.rst(rst);
    corner_detection.pixel(source.pixel);
    corner_detection.x(source.x);
    corner_detection.y(source.y);
    corners.ena(source.ena);
    corners.pixel(source.pixel);
    corners.x(source.x);
    corners.y(source.y);
  }
  /// A field of the packet, while there is one.
  std::uint16_t field(unsigned low, std::uint32_t mask) const {
    const std::uint32_t packet = corner_detection.corner_out ? corner_detection.corner_data : 0u;
    return static_cast<std::uint16_t>(packet >> low & mask);
  }

  vp::Clock clk;
  vp::Signal<bool> rst{"rst"};
  RasterSource<std::uint8_t> source{"source", clk, picture(), width};
  CornerArrayView corners{"corners", clk};
  pl::CornerDetectionClocked corner_detection{"corner_detection", {clk, {width, height}}};
  vp::Probe<std::uint16_t> packet_strength{"packet_strength", [this] { return field(21, 0x3FF); },
                                           10};
  vp::Probe<std::uint16_t> packet_direction{"packet_direction", [this] { return field(19, 3); }, 2};
  vp::Probe<std::uint16_t> packet_y{"packet_y", [this] { return field(10, 0x1FF); }, 9};
  vp::Probe<std::uint16_t> packet_x{"packet_x", [this] { return field(0, 0x3FF); }, 10};
};

}  // namespace

void trace_non_maximum_suppression(const std::filesystem::path& file) {
  trace<SuppressionBench>("non_maximum_suppression", file, window_edge - 1, window_edge + 9);
}

}  // namespace appendix_c
