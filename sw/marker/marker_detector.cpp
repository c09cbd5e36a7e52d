#include <marker/marker_detector.h>
#include <marker/work.h>

#include <blob_stream.h>

namespace marker {
namespace {

/// The eight directions of Extremes, and of blob_stream's words.
constexpr std::array<std::array<std::int32_t, 2>, 8> directions = {
    {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}}};

std::int32_t reach(std::uint32_t point, unsigned direction) {
  return directions[direction][0] * static_cast<std::int32_t>(blob_stream::x(point)) +
         directions[direction][1] * static_cast<std::int32_t>(blob_stream::y(point));
}

/// Inside of the picture, and each the outermost of the eight in its direction.
bool is_blob(const std::uint32_t* words, const GreyImage& image) {
  for (unsigned i = 0; i < blob_stream::words_per_blob; ++i) {
    const std::uint32_t point = words[i];
    if (blob_stream::x(point) >= image.width || blob_stream::y(point) >= image.height) return false;
    for (unsigned direction = 0; direction < directions.size(); ++direction) {
      if (reach(point, direction) > reach(words[direction], direction)) return false;
    }
  }
  return true;
}

/// Pixels from the first to the last one, both included.
struct Box {
  std::uint32_t left, top, right, bottom;

  std::uint32_t width() const { return right - left + 1; }
  std::uint32_t height() const { return bottom - top + 1; }
};

Box box_of(const std::uint32_t* words) {
  return {blob_stream::x(words[blob_stream::least_x]), blob_stream::y(words[blob_stream::least_y]),
          blob_stream::x(words[blob_stream::greatest_x]),
          blob_stream::y(words[blob_stream::greatest_y])};
}

Extremes extremes_of(const std::uint32_t* words) {
  Extremes extremes{};
  for (unsigned i = 0; i < extremes.size(); ++i) {
    extremes[i] = {blob_stream::x(words[i]) + 0.5, blob_stream::y(words[i]) + 0.5};
  }
  return extremes;
}

/// Takes all that fit_quad and read_cells may read of a blob out of the caches.
void fetch(const GreyImage& image, const Box& box) {
  const auto lowest = [](std::uint32_t at) { return at < fit_margin ? 0 : at - fit_margin; };
  const auto end = [](std::uint32_t at, std::uint32_t size) {
    return size - at <= fit_margin ? size : at + fit_margin + 1;
  };
  const std::uint32_t left = lowest(box.left);
  const std::uint32_t bytes = end(box.right, image.width) - left;
  const std::uint32_t bottom = end(box.bottom, image.height);
  for (std::uint32_t y = lowest(box.top); y < bottom; ++y) {
    hal_cache_invalidate(
        const_cast<std::uint8_t*>(image.pixels + std::size_t{y} * image.width + left), bytes);
  }
}

}  // namespace

bool Board::find(std::uint32_t id, Places& places) const {
  switch (kind) {
    case Kind::none:
      return false;
    case Kind::grid:
      return grid.find(id, places);
    case Kind::charuco:
      return charuco.find(id, places);
  }
  return false;
}

void MarkerDetector::open(const Dictionary& dictionary, const DetectorOptions& options) {
  book_.open(dictionary);
  options_ = options;
}

void MarkerDetector::find_markers(const CameraFrame& frame, const BlobList& blobs,
                                  Detections& found) {
  const FunctionScope scope(Function::marker_detection);
  clear(found);
  BlobCounts& counts = found.blobs;
  counts.received = blobs.count;
  work(Work::blobs_checked, blobs.count);
  DetectionOptions options = options_.detection;
  options.fit.in_dma_memory = frame.in_dma_memory;
  for (std::uint32_t i = 0; i < blobs.count; ++i) {
    const std::uint32_t* const words = blobs.words + i * blob_stream::words_per_blob;
    if (!is_blob(words, frame.image)) {
      ++counts.malformed;
      continue;
    }
    const Box box = box_of(words);
    if (box.width() < options_.minimum_side || box.height() < options_.minimum_side) {
      ++counts.small;
      continue;
    }
    Quad guess{};
    if (!largest_quad(extremes_of(words), guess)) {
      ++counts.refused[static_cast<std::uint32_t>(Refusal::shape)];
      continue;
    }
    if (frame.in_dma_memory) fetch(frame.image, box);
    DetectedMarker marker{};
    const Refusal refusal = read_marker(frame.image, frame.lens, guess, book_, options, marker);
    if (refusal != Refusal::none) {
      ++counts.refused[static_cast<std::uint32_t>(refusal)];
    } else if (found.count == max_detections) {
      ++counts.lost;
    } else {
      Detection& detection = found.markers[found.count++];
      detection.marker = marker;
      detection.pose.valid = false;
    }
  }
}

void MarkerDetector::find_poses(const Camera& camera, Detections& found) {
  if (options_.board.kind == Board::Kind::none) {
    for (std::uint32_t i = 0; i < found.count; ++i) {
      const QuadFit& fit = found.markers[i].marker.fit;
      seen_[0] = {single_marker(options_.board.marker_side), fit.ideal, fit.covariance};
      found.markers[i].pose = estimate_board_pose(seen_.data(), 1, camera);
    }
    return;
  }
  for (std::uint32_t i = 0; i < found.count; ++i) {
    const DetectedMarker& marker = found.markers[i].marker;
    std::uint32_t times = 0;
    for (std::uint32_t k = 0; k < found.count; ++k) {
      if (found.markers[k].marker.id == marker.id) ++times;
    }
    SeenMarker& seen = seen_[found.board_markers];
    if (times > 1 || !options_.board.find(marker.id, seen.places)) continue;
    seen.corners = marker.fit.ideal;
    seen.covariance = marker.fit.covariance;
    ++found.board_markers;
  }
  found.board = estimate_board_pose(seen_.data(), found.board_markers, camera);
}

}  // namespace marker
