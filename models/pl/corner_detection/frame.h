#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pl/common/geometry.h>

namespace pl {

/// Corner Detection over a whole frame: the packets of CornerDetectionClocked at the same clocks.
///
/// Works in bands of rows, so that a caller can stop anywhere: it shows the frame as the sensor
/// plays it, and takes back rows that were found before the image memory changed under them.
class CornerFrame {
 public:
  /// `threshold` 0 to 255 grey levels.
  CornerFrame(const Geometry& geometry, std::uint32_t threshold);

  /// The clock at which a corner centred on (x, y) leaves: CornerCore::latency behind that of the
  /// pixel at (x + reach, y + reach).
  static std::uint64_t clock(const Geometry& geometry, std::uint32_t x, std::uint32_t y);

  /// A new frame. `image` holds width x height pixels, and stays valid as long as advance() is
  /// used.
  void begin(const std::uint8_t* image);
  /// Appends, in the order of their clocks, the packets of all corners that pixel rows up to
  /// `rows` - 1 complete and that were not given yet. Reads no row from `rows` on for a result.
  void advance(std::uint32_t rows, std::vector<StampedWord>& corners);
  /// Pixels of row `row` or below changed since they were used: the corners that row `row` or a
  /// later one completes are found, and given, again.
  void rewind(std::uint32_t row);

  /// begin() and advance() over the whole frame.
  void detect(const std::uint8_t* image, std::vector<StampedWord>& corners);

 private:
  /// Strengths of one row of points; the lines of the hardware's 3 x 3 grid.
  struct ScoreRow {
    std::uint32_t y = none;
    bool any = false;
    std::vector<std::uint64_t> corners;   ///< bit k: the point at x = 3 + k is a corner
    std::vector<std::uint16_t> strength;  ///< by x; 0: not a corner
  };
  static constexpr std::uint32_t none = ~0u;

  ScoreRow& scores(std::uint32_t y) { return rows_[y % rows_.size()]; }
  void score(std::uint32_t y);
  void mark(std::uint32_t y, std::uint64_t* bits);
  void find_maxima(std::uint32_t y, std::vector<StampedWord>& corners);

  Geometry geometry_;
  std::uint32_t threshold_;
  const std::uint8_t* image_ = nullptr;
  std::uint32_t next_;  ///< the first row whose corners were not given yet
  std::array<ScoreRow, 4> rows_;
  std::vector<std::uint8_t> last_rows_;  ///< the frame's last rows with room behind each
};

namespace fast {

/// Bytes behind the last pixel of a row that mark_corners() may read.
constexpr std::size_t mark_corners_overread = 80;

/// Tells which of `count` pixels from `points` on have nine contiguous circle pixels brighter than
/// the pixel itself by more than `threshold` (0 to 255): bit k of `bits` (bit k % 64 of word k /
/// 64, whole words are written). The circles lie `stride` bytes a row around the points.
void mark_corners(const std::uint8_t* points, std::ptrdiff_t stride, std::uint32_t count,
                  std::uint32_t threshold, std::uint64_t* bits);

}  // namespace fast

}  // namespace pl
