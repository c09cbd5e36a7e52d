#include <marker/blob_grouping.h>
#include <marker/work.h>

namespace marker {
namespace {

constexpr std::uint32_t number_mask = 0x7FF;  // as in the thesis' words

}  // namespace

void BlobGrouping::detect(const BinaryImage& image, const BlobOptions& options,
                          FeatureSet& features) {
  const FunctionScope scope(Function::blob_detection);
  options_ = options;
  features_ = &features;
  width_ = image.width;
  number_ = overflow_ = 0;
  dark_ = runs_ = rivals_ = labels_ = ends_ = 0;
  pool_.reset(options.labels, image.width);
  for (Row& row : rows_) row.fill(0);
  for (std::uint32_t y = 0; y < image.height; ++y) {
    group_row(image, y, rows_[(y + 1) % 2].data() + margin, rows_[y % 2].data() + margin);
    pool_.retire((y + 1) * image.width - 1, [this](const BoundingBox& box) { ended(box); });
  }
  pool_.flush([this](const BoundingBox& box) { ended(box); });
  count_work(image);
}

/// Inside a run of dark pixels the label of the left neighbour, which was the widest, stays the
/// widest, unless a wider blob enters the window at its right end.
void BlobGrouping::group_row(const BinaryImage& image, std::uint32_t y, const Label* above,
                             Label* here) {
  const std::uint32_t* const words = image.words + y * (image.width / pixels_per_word);
  std::uint32_t label = 0;  // of the pixel to the left
  for (std::uint32_t x = 0; x < image.width; ++x) {
    if (!(words[x / pixels_per_word] >> x % pixels_per_word & 1u)) {
      if (label != 0) end_run(label, x - 1);
      label = 0;
    } else {
      MARKERVP_COUNT(dark_);
      if (label == 0) {
        label = start_run(x, y, above, here);
      } else if (const std::uint32_t rival = above[x + 2]; rival != 0 && rival != label) {
        MARKERVP_COUNT(rivals_);
        end_run(label, x - 1);
        if (pool_.columns(rival) > pool_.columns(label)) label = rival;
        join(label, x, y);
      }
    }
    here[x] = static_cast<Label>(label);
  }
  if (label != 0) end_run(label, image.width - 1);
}

std::uint32_t BlobGrouping::start_run(std::uint32_t x, std::uint32_t y, const Label* above,
                                      const Label* here) {
  MARKERVP_COUNT(runs_);
  const std::uint32_t label = widest_neighbour(above + x, here + x);
  if (label == 0) return new_label(x, y);
  join(label, x, y);
  return label;
}

/// Both at the pixel. Left far, then above from left to right; the first of the widest wins. Left
/// near has no label where a run starts.
std::uint32_t BlobGrouping::widest_neighbour(const Label* above, const Label* here) const {
  const Label* const window = above - margin;
  std::uint32_t best = *(here - margin);
  std::uint32_t widest = pool_.columns(best);
  for (std::uint32_t i = 0; i < 2 * margin + 1; ++i) {
    const std::uint32_t columns = pool_.columns(window[i]);
    if (columns > widest) {
      widest = columns;
      best = window[i];
    }
  }
  return best;
}

std::uint32_t BlobGrouping::new_label(std::uint32_t x, std::uint32_t y) {
  const std::uint32_t label =
      pool_.take(y * width_ + x, [this](const BoundingBox& box) { ended(box); });
  if (label == 0) {
    ++overflow_;
    return 0;
  }
  MARKERVP_COUNT(labels_);
  const auto column = static_cast<std::uint16_t>(x), row = static_cast<std::uint16_t>(y);
  pool_.box(label) = {column, row, column, row, 0};
  return label;
}

void BlobGrouping::join(std::uint32_t label, std::uint32_t x, std::uint32_t y) {
  BoundingBox& box = pool_.box(label);
  if (x < box.sx) box.sx = static_cast<std::uint16_t>(x);
  if (x > box.ex) box.ex = static_cast<std::uint16_t>(x);
  box.ey = static_cast<std::uint16_t>(y);
}

void BlobGrouping::end_run(std::uint32_t label, std::uint32_t last) {
  BoundingBox& box = pool_.box(label);
  if (last > box.ex) box.ex = static_cast<std::uint16_t>(last);
}

void BlobGrouping::ended(const BoundingBox& box) {
  ++ends_;
  if (static_cast<std::uint32_t>(box.ex - box.sx) < options_.minimum_side ||
      static_cast<std::uint32_t>(box.ey - box.sy) < options_.minimum_side) {
    return;
  }
  features_->push(BoundingBox{box.sx, box.sy, box.ex, box.ey,
                              static_cast<std::uint16_t>(number_++ & number_mask)});
}

void BlobGrouping::count_work(const BinaryImage& image) const {
  work(Work::blob_frames, 1);
  work(Work::blob_rows, image.height);
  work(Work::blob_pixels, std::uint64_t{image.width} * image.height);
  work(Work::blob_dark, dark_);
  work(Work::blob_runs, runs_);
  work(Work::blob_rivals, rivals_);
  work(Work::blob_labels, labels_);
  work(Work::blob_label_checks, pool_.checks());
  work(Work::blobs_ended, ends_);
}

}  // namespace marker
