#pragma once

#include <marker/images.h>
#include <marker/marker_detector.h>

#include <blob_stream.h>

#include <array>
#include <cstdint>

namespace marker {

/// Dark blobs of a picture by a threshold of each pixel's own, as the logic has them with
/// pl.threshold_rule=local: for a picture with a background so dark that its one threshold takes
/// background and markers for one blob. For static memory.
class LocalBlobs {
 public:
  /// More are counted as lost.
  static constexpr std::uint32_t most_blobs = 2048;

  /// Blobs whose box is at least `minimum_side` px wide and high, in the order in which they end.
  /// `image`: at most max_image_width wide, 11 px at least in both directions. Valid until the next
  /// call.
  BlobList find(const GreyImage& image, std::uint32_t minimum_side);

  /// Of the picture: blobs for which there was no room.
  std::uint32_t lost() const { return lost_; }

 private:
  static constexpr std::uint32_t most_runs = max_image_width / 2 + 1;
  /// No two blobs share a run, and only those with a run in either of two rows are alive.
  static constexpr std::uint32_t most_alive = 2 * most_runs;

  /// Dark pixels beside each other.
  struct Run {
    std::uint32_t begin, last;  ///< columns
    std::uint32_t blob;
  };
  struct Row {
    std::uint32_t count;
    std::array<Run, most_runs> runs;
  };
  struct Blob {
    std::array<std::uint32_t, blob_stream::words_per_blob> extremes;
    std::uint32_t last_row;
  };

  void find_runs(const GreyImage& image, std::uint32_t row);
  void join(std::uint32_t row);
  void unite(std::uint32_t kept, std::uint32_t gone);
  void extend(std::uint32_t blob, std::uint32_t point);
  void end_blobs(std::uint32_t row, std::uint32_t minimum_side);

  std::array<std::uint16_t, max_image_width> columns_;  ///< sums of each over the window's rows
  std::array<Row, 2> rows_;
  Row *before_, *now_;  ///< the one above, and the present one
  std::array<Blob, most_alive> blobs_;
  std::array<std::uint32_t, most_alive> free_;
  std::uint32_t free_count_;
  std::array<std::uint32_t, most_blobs * blob_stream::words_per_blob> words_;
  std::uint32_t count_, lost_;
  std::uint32_t runs_, joins_;  ///< work
};

}  // namespace marker
