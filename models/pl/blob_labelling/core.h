#pragma once

#include <cstdint>
#include <vector>

#include <pl/blob_labelling/run_labeller.h>

namespace pl {

/// One pixel a clock: what a pixel is the beginning or the end of happens two clocks after it came,
/// and a run starts in one of two clocks at most.
///
/// At least width + 1 clocks without a pixel follow each frame.
class LabellingCore final : public RunLabeller {
 public:
  LabellingCore(const Geometry& geometry, std::uint32_t labels, std::uint32_t minimum_side);

  void clock(bool ena, std::uint32_t dark, std::uint32_t x, std::uint32_t y) override;
  void reset() override;
  bool ready() const override { return flush_ == 0; }

 private:
  struct Pixel {
    bool valid = false, dark = false;
    std::uint32_t x = 0, y = 0;
  };

  void capture(bool ena, bool dark, std::uint32_t x, std::uint32_t y);
  void step();

  std::vector<std::uint8_t> line_;  ///< pixels of the row above

  Pixel pixel_;                             ///< captured
  Pixel decided_;                           ///< captured a clock before, looked at in the next one
  std::uint32_t flush_ = 0;                 ///< clocks of the bright row behind the frame to come
  bool dark_ = false, dark_above_ = false;  ///< the pixel before, and above it
  Run run_;                                 ///< of this row
  bool run_ended_ = false;
};

}  // namespace pl
