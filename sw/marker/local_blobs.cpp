#include <marker/local_blobs.h>
#include <marker/work.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace marker {
namespace {

/// The window around a pixel: 11 x 11. A dark one is darker than its mean by an eighth of it, and
/// by two levels at least, as the logic's default has it (measured: docs/detectors.md).
constexpr std::uint32_t radius = 5;
constexpr std::uint32_t relative = 3, least_offset = 2;

/// Pixels of the window around `middle` that lie within `size`, along one axis.
std::uint32_t window_of(std::uint32_t middle, std::uint32_t size) {
  return std::min(middle + radius, size - 1) - (std::max(middle, radius) - radius) + 1;
}

/// How far out a pixel is in one of the eight directions of blob_stream::Extreme.
std::int32_t reach(std::uint32_t point, std::uint32_t which) {
  const auto x = static_cast<std::int32_t>(blob_stream::x(point));
  const auto y = static_cast<std::int32_t>(blob_stream::y(point));
  switch (which) {
    case blob_stream::least_y:
      return -y;
    case blob_stream::greatest_x_minus_y:
      return x - y;
    case blob_stream::greatest_x:
      return x;
    case blob_stream::greatest_x_plus_y:
      return x + y;
    case blob_stream::greatest_y:
      return y;
    case blob_stream::least_x_minus_y:
      return y - x;
    case blob_stream::least_x:
      return -x;
    default:
      return -x - y;
  }
}

}  // namespace

BlobList LocalBlobs::find(const GreyImage& image, std::uint32_t minimum_side) {
  const FunctionScope scope(Function::blob_detection);
  count_ = lost_ = runs_ = joins_ = 0;
  before_ = &rows_[0];
  now_ = &rows_[1];
  before_->count = now_->count = 0;
  for (free_count_ = 0; free_count_ < most_alive; ++free_count_) free_[free_count_] = free_count_;
  std::fill_n(columns_.begin(), image.width, std::uint16_t{0});
  // The window's lower half of the first row, but for the row that find_runs() takes in.
  for (std::uint32_t row = 0; row < radius; ++row) {
    const std::uint8_t* const pixels = image.pixels + std::size_t{row} * image.width;
    for (std::uint32_t x = 0; x < image.width; ++x) {
      columns_[x] = static_cast<std::uint16_t>(columns_[x] + pixels[x]);
    }
  }
  for (std::uint32_t row = 0; row < image.height; ++row) {
    find_runs(image, row);
    join(row);
    end_blobs(row, minimum_side);
    std::swap(before_, now_);
  }
  end_blobs(image.height, minimum_side);
  work(Work::local_frames, 1);
  work(Work::local_rows, image.height);
  work(Work::local_pixels, std::uint64_t{image.width} * image.height);
  work(Work::local_runs, runs_);
  work(Work::local_joins, joins_);
  return {words_.data(), count_};
}

/// One pass over three rows: the one that the window takes in, the one that leaves it, and the one
/// in its middle, five pixels behind.
void LocalBlobs::find_runs(const GreyImage& image, std::uint32_t row) {
  static constexpr std::array<std::uint8_t, max_image_width> no_row{};
  const std::uint32_t width = image.width, height = window_of(row, image.height);
  const std::uint8_t* const pixels = image.pixels + std::size_t{row} * width;
  const std::size_t way = std::size_t{radius} * width;
  const std::uint8_t* const taken_in = row + radius < image.height ? pixels + way : no_row.data();
  const std::uint8_t* const left = row > radius ? pixels - way - width : no_row.data();
  std::uint16_t* const columns = columns_.data();
  Run* run = now_->runs.data();
  std::uint32_t sum = 0;
  bool was_dark = false;
  const auto enter = [&](std::uint32_t x) {
    const std::uint32_t column = columns[x] + taken_in[x] - left[x];
    columns[x] = static_cast<std::uint16_t>(column);
    sum += column;
  };
  const auto judge = [&](std::uint32_t x, std::uint32_t pixel_count) {
    const std::uint32_t offset = std::max(pixel_count * least_offset, sum >> relative);
    const bool is_dark = pixel_count * pixels[x] + offset <= sum;
    if (is_dark == was_dark) return;
    was_dark = is_dark;
    if (is_dark) {
      *run = {x, x, most_alive};
    } else {
      run++->last = x - 1;
    }
  };
  std::uint32_t x = 0;
  for (; x < radius; ++x) enter(x);
  for (x = 0; x <= radius; ++x) {
    enter(x + radius);
    judge(x, height * (x + radius + 1));
  }
  const std::uint32_t whole = height * (2 * radius + 1);
  for (; x + radius < width; ++x) {
    enter(x + radius);
    sum -= columns[x - radius - 1];
    judge(x, whole);
  }
  for (; x < width; ++x) {
    sum -= columns[x - radius - 1];
    judge(x, height * (width - x + radius));
  }
  if (was_dark) run++->last = width - 1;
  now_->count = static_cast<std::uint32_t>(run - now_->runs.data());
}

/// Gives each run the blob of those above that it touches, over corners, too.
void LocalBlobs::join(std::uint32_t row) {
  MARKERVP_ADD(runs_, now_->count);
  std::uint32_t above = 0;
  for (std::uint32_t i = 0; i < now_->count; ++i) {
    Run& run = now_->runs[i];
    while (above < before_->count && before_->runs[above].last + 1 < run.begin) ++above;
    for (std::uint32_t k = above; k < before_->count && before_->runs[k].begin <= run.last + 1;
         ++k) {
      const std::uint32_t blob = before_->runs[k].blob;
      if (run.blob == most_alive) {
        run.blob = blob;
      } else if (run.blob != blob) {
        unite(run.blob, blob);
      }
    }
    const std::uint32_t begin = blob_stream::point(run.begin, row);
    if (run.blob == most_alive) {
      run.blob = free_[--free_count_];
      blobs_[run.blob].extremes.fill(begin);
    } else {
      extend(run.blob, begin);
    }
    extend(run.blob, blob_stream::point(run.last, row));
    blobs_[run.blob].last_row = row;
  }
}

void LocalBlobs::unite(std::uint32_t kept, std::uint32_t gone) {
  MARKERVP_COUNT(joins_);
  for (const std::uint32_t point : blobs_[gone].extremes) extend(kept, point);
  for (std::uint32_t i = 0; i < before_->count; ++i) {
    if (before_->runs[i].blob == gone) before_->runs[i].blob = kept;
  }
  for (std::uint32_t i = 0; i < now_->count; ++i) {
    if (now_->runs[i].blob == gone) now_->runs[i].blob = kept;
  }
  free_[free_count_++] = gone;
}

void LocalBlobs::extend(std::uint32_t blob, std::uint32_t point) {
  for (std::uint32_t which = 0; which < blob_stream::words_per_blob; ++which) {
    std::uint32_t& extreme = blobs_[blob].extremes[which];
    const std::int32_t way = reach(point, which), farthest = reach(extreme, which);
    if (way > farthest || (way == farthest && point < extreme)) extreme = point;
  }
}

/// Of the blobs of the row above those that this row does not continue.
void LocalBlobs::end_blobs(std::uint32_t row, std::uint32_t minimum_side) {
  for (std::uint32_t i = 0; i < before_->count; ++i) {
    const std::uint32_t which = before_->runs[i].blob;
    Blob& blob = blobs_[which];
    if (blob.last_row + 1 != row) continue;
    blob.last_row = row;  // once, whatever runs it has
    free_[free_count_++] = which;
    const auto& e = blob.extremes;
    const std::uint32_t width =
        blob_stream::x(e[blob_stream::greatest_x]) - blob_stream::x(e[blob_stream::least_x]) + 1;
    const std::uint32_t height =
        blob_stream::y(e[blob_stream::greatest_y]) - blob_stream::y(e[blob_stream::least_y]) + 1;
    if (width < minimum_side || height < minimum_side) continue;
    if (count_ == most_blobs) {
      ++lost_;
      continue;
    }
    std::copy(e.begin(), e.end(), words_.begin() + count_++ * blob_stream::words_per_blob);
  }
}

}  // namespace marker
