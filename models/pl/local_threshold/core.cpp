#include <pl/local_threshold/core.h>

#include <algorithm>

namespace pl {

LocalThresholdCore::LocalThresholdCore(const Geometry& geometry, std::uint32_t radius)
    : geometry_(geometry),
      radius_(radius),
      window_(2 * radius + 1),
      rows_(window_ * geometry.width),
      column_sum_(geometry.width) {}

void LocalThresholdCore::begin(const LocalRule& rule) {
  rule_ = rule;
  std::fill(rows_.begin(), rows_.end(), std::uint8_t{0});
  std::fill(column_sum_.begin(), column_sum_.end(), 0);
  position_ = 0;
}

void LocalThresholdCore::push(std::uint8_t pixel) {
  const std::uint32_t column = position_ % geometry_.width;
  std::uint8_t& place = stored(column, position_ / geometry_.width);
  column_sum_[column] += std::uint32_t{pixel} - place;
  place = pixel;
  leave();
}

// A row of zeros behind the last one takes the oldest row out of the sums, as any other does.
void LocalThresholdCore::push_nothing() {
  push(0);
}

void LocalThresholdCore::leave() {
  const std::uint32_t entered = position_++;
  if (entered < lag()) return;
  const std::uint32_t leaving = entered - lag();
  const std::uint32_t column = leaving % geometry_.width, row = leaving / geometry_.width;
  slide(column);
  dark_ = rule_.dark(stored(column, row), sum_,
                     window_reach(column, radius_, geometry_.width) *
                         window_reach(row, radius_, geometry_.height));
}

// The window moves to the right, or to the beginning of the next row.
void LocalThresholdCore::slide(std::uint32_t column) {
  if (column == 0) {
    sum_ = 0;
    for (std::uint32_t c = 0; c < radius_; ++c) sum_ += column_sum_[c];
  }
  if (column + radius_ < geometry_.width) sum_ += column_sum_[column + radius_];
  if (column > radius_) sum_ -= column_sum_[column - radius_ - 1];
}

}  // namespace pl
