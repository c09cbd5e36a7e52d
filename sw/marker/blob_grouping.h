#pragma once

#include <marker/feature_set.h>
#include <marker/images.h>
#include <marker/label_pool.h>

#include <array>
#include <cstdint>

namespace marker {

struct BlobOptions {
  std::uint32_t labels = 128;       ///< the background's included, 4 to max_labels
  std::uint32_t minimum_side = 24;  ///< px: smallest Ex − Sx and Ey − Sy (thesis 4.3.6.4)
};

/// Blobs of dark pixels on the PS (thesis 3.4.3, A.3.2.2): the same boxes as those of the PL, in
/// the same order. A dark pixel takes the label of the widest neighbouring blob; labels never
/// merge.
class BlobGrouping {
 public:
  /// Appends the blobs of `image` (at most max_image_width wide) to `features`.
  void detect(const BinaryImage& image, const BlobOptions& options, FeatureSet& features);

  /// Dark pixels of the last image that found no free label.
  std::uint32_t label_overflow() const { return overflow_; }

 private:
  using Label = std::uint16_t;
  static constexpr std::uint32_t margin = 2;  ///< the window reaches so far over both ends

  /// Labels of one row, with room for the window left and right of it.
  using Row = std::array<Label, max_image_width + 2 * margin>;

  void group_row(const BinaryImage& image, std::uint32_t y, const Label* above, Label* here);
  std::uint32_t start_run(std::uint32_t x, std::uint32_t y, const Label* above, const Label* here);
  std::uint32_t widest_neighbour(const Label* above, const Label* here) const;
  std::uint32_t new_label(std::uint32_t x, std::uint32_t y);
  void join(std::uint32_t label, std::uint32_t x, std::uint32_t y);
  void end_run(std::uint32_t label, std::uint32_t last);
  void ended(const BoundingBox& box);
  void count_work(const BinaryImage& image) const;

  LabelPool pool_;
  std::array<Row, 2> rows_{};
  BlobOptions options_;
  FeatureSet* features_ = nullptr;
  std::uint32_t width_ = 0;
  std::uint32_t number_ = 0;
  std::uint32_t overflow_ = 0;
  // What was done, for annotations.
  std::uint32_t dark_ = 0, runs_ = 0, rivals_ = 0, labels_ = 0, ends_ = 0;
};

}  // namespace marker
