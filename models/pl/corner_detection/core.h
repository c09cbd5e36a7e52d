#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pl/common/geometry.h>

namespace pl {

/// A corner that survived non-maximum suppression.
struct Corner {
  std::uint32_t x = 0, y = 0;
  std::uint32_t strength = 0;   ///< 12 bits
  std::uint32_t direction = 0;  ///< N 0, S 1, E 2, W 3: where the tip points
};

/// What one FAST module makes of a point of interest and its circle (thesis 4.3.4.3).
namespace fast {

/// The circle's 16 pixels, index 0 on top, clockwise.
using Circle = std::array<std::uint8_t, 16>;

/// What the threshold component gives (equations 4.1 and 4.2).
struct Thresholded {
  std::array<std::uint8_t, 16> difference{};
  std::uint16_t bright = 0;  ///< bit n: circle[n] > point + threshold
};
Thresholded threshold(const Circle& circle, std::uint8_t point, std::uint32_t threshold);

/// True if nine neighbouring bits of the ring of 16 are set.
bool contiguous(std::uint16_t bright);
/// Sum of the differences (equation 4.3), at most 16 · 255 = 4080.
std::uint32_t strength(const std::array<std::uint8_t, 16>& difference);
/// The region of five circle pixels with the most bright ones; the first of N 0, S 1, E 2, W 3 at a
/// tie.
std::uint32_t direction(std::uint16_t bright);

/// Bytes behind the last pixel of a row that mark_corners() may read.
constexpr std::size_t mark_corners_overread = 80;

/// Tells which of `count` pixels from `points` on have nine contiguous circle pixels brighter than
/// the pixel itself by more than `threshold` (0 to 255): bit k of `bits` (bit k % 64 of word k /
/// 64, whole words are written). The circles lie `stride` bytes a row around the points.
void mark_corners(const std::uint8_t* points, std::ptrdiff_t stride, std::uint32_t count,
                  std::uint32_t threshold, std::uint64_t* bits);

}  // namespace fast

/// Finds dark corners in a stream of pixels: FAST-9 on the bright side, then a 3×3 non-maximum
/// suppression.
///
/// The thesis has nine FAST modules side by side; eight of the nine points of interest were seen
/// before, so only the new one is computed here and its result kept for two lines. The outputs are
/// the same, clock for clock.
class CornerCore {
 public:
  /// Clocks from the one in which the window takes a pixel to the one in which the corner leaves:
  /// threshold, {strength, contiguity, direction}, two of non-maximum suppression.
  static constexpr unsigned latency = 4;
  /// The newest pixel lies this far right of and below the centre of the window.
  static constexpr std::uint32_t reach = 4;

  /// `threshold` 0 to 255 grey levels.
  CornerCore(const Geometry& geometry, std::uint32_t threshold);

  /// Takes the pixel at (x, y), in raster order. True if the window's centre (x − 4, y − 4) is a
  /// corner.
  bool push(std::uint8_t pixel, std::uint32_t x, std::uint32_t y, Corner& corner);

  void reset();

  /// What one FAST module found.
  struct Score {
    std::uint16_t strength = 0;  ///< 0: not a corner
    std::uint8_t direction = 0;
  };
  // For traces.
  /// The point of interest that was new in that clock.
  Score newest() const { return x_ < 6 || y_ < 6 ? Score{} : scores(y_ - 3)[x_ - 3]; }
  /// The one in the middle of the 3 x 3 grid.
  Score centre() const {
    return x_ < 2 * reach || y_ < 2 * reach ? Score{} : scores(y_ - reach)[x_ - reach];
  }

 private:
  Score score(std::uint32_t x, std::uint32_t y) const;
  bool is_maximum(std::uint32_t x, std::uint32_t y) const;
  const std::uint8_t* row(std::uint32_t y) const { return &pixels_[(y % 8) * width_]; }
  const Score* scores(std::uint32_t y) const { return &scores_[(y % 4) * width_]; }

  std::uint32_t width_;
  std::uint32_t threshold_;
  std::uint32_t x_ = 0, y_ = 0;       ///< of the newest pixel
  std::vector<std::uint8_t> pixels_;  ///< the last eight lines
  std::vector<Score> scores_;         ///< the last four lines of results
};

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

}  // namespace pl
