#include <marker/marker_detector.h>
#include <marker/outline.h>
#include <marker/work.h>

#include <blob_stream.h>

#include <algorithm>

namespace marker {
namespace {

/// So much of a picture around a blob is taken out of the caches, and looked at, px: its corners
/// may be 3 px off, an edge is looked for 4.5 px along a strip, and the paper's grey level is read
/// behind it. More changes nothing in the corners.
constexpr std::uint32_t fetch_margin = 10;

/// Of a marker whose outline is no quadrilateral so many cells of the border may be white: what
/// hides a corner may be bright. Then its word must be exact (measured: nothing false in 335
/// pictures).
constexpr std::uint32_t hidden_cells = 3;
/// And the ends of its sides are what hides it, px (measured).
constexpr double hidden_raggedness = 0.8;

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

Box box_of(const std::uint32_t* words) {
  return {blob_stream::x(words[blob_stream::least_x]), blob_stream::y(words[blob_stream::least_y]),
          blob_stream::x(words[blob_stream::greatest_x]) + 1,
          blob_stream::y(words[blob_stream::greatest_y]) + 1};
}

Extremes extremes_of(const std::uint32_t* words) {
  Extremes extremes{};
  for (unsigned i = 0; i < extremes.size(); ++i) {
    extremes[i] = {static_cast<std::int32_t>(blob_stream::x(words[i])),
                   static_cast<std::int32_t>(blob_stream::y(words[i]))};
  }
  return extremes;
}

/// True if a side runs along the border of the picture: what is beyond it is not visible.
bool is_cut(const Quad& quad, const GreyImage& image) {
  for (unsigned i = 0; i < 4; ++i) {
    const Point a = quad[i], b = quad[(i + 1) % 4];
    if ((a.x < 1 && b.x < 1) || (a.y < 1 && b.y < 1) ||
        (a.x > image.width - 1.0 && b.x > image.width - 1.0) ||
        (a.y > image.height - 1.0 && b.y > image.height - 1.0)) {
      return true;
    }
  }
  return false;
}

/// True if a blob is what is around the markers: its box has half of the picture, and reaches two
/// of the picture's borders at least (decision).
bool is_background(const Box& box, const GreyImage& image) {
  const unsigned borders = (box.left == 0 ? 1 : 0) + (box.top == 0 ? 1 : 0) +
                           (box.right == image.width ? 1 : 0) +
                           (box.bottom == image.height ? 1 : 0);
  return borders >= 2 &&
         2 * (box.right - box.left) * (box.bottom - box.top) >= image.width * image.height;
}

/// The surroundings of a blob that are looked at.
Box around(const Box& box, const GreyImage& image) {
  return {box.left - std::min(box.left, fetch_margin), box.top - std::min(box.top, fetch_margin),
          std::min(box.right + fetch_margin, image.width),
          std::min(box.bottom + fetch_margin, image.height)};
}

/// Takes a part of a picture out of the caches.
void fetch(const GreyImage& image, const Box& part) {
  for (std::uint32_t y = part.top; y < part.bottom; ++y) {
    hal_cache_invalidate(
        const_cast<std::uint8_t*>(image.pixels + std::size_t{y} * image.width + part.left),
        part.right - part.left);
  }
}

/// What is known of a marker's corners but for what all of them share.
CornerWeights own_weights(const QuadFit& fit) {
  std::array<double, 64> own = fit.covariance;
  for (unsigned i = 0; i < 8; ++i) {
    for (unsigned k = 0; k < 8; ++k) own[8 * i + k] -= fit.common[i] * fit.common[k];
  }
  return weights_of(own);
}

double variance_of(const QuadFit& fit) {
  double sum = 0;
  for (unsigned i = 0; i < 8; ++i) sum += fit.covariance[9 * i];
  return sum;
}

/// True if all corners are within a quarter of a side.
bool is_same_place(const Quad& one, const Quad& other) {
  for (unsigned i = 0; i < 4; ++i) {
    const Point off = other[i] - one[i], side = one[(i + 1) % 4] - one[i];
    if (!(16 * dot(off, off) < dot(side, side))) return false;
  }
  return true;
}

}  // namespace

void add_marker(const Detection& marker, Detections& found) {
  for (std::uint32_t i = 0; i < found.count; ++i) {
    Detection& other = found.markers[i];
    if (other.marker.id != marker.marker.id ||
        !is_same_place(other.marker.fit.image, marker.marker.fit.image)) {
      continue;
    }
    ++found.blobs.refused[static_cast<std::uint32_t>(Refusal::twice)];
    if (variance_of(marker.marker.fit) < variance_of(other.marker.fit)) other = marker;
    return;
  }
  if (found.count == max_detections) {
    ++found.blobs.lost;
  } else {
    found.markers[found.count++] = marker;
  }
}

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
  clear(found);
  add_markers(frame, blobs, found);
}

void MarkerDetector::add_markers(const CameraFrame& frame, const BlobList& blobs,
                                 Detections& found) {
  const FunctionScope scope(Function::marker_detection);
  BlobCounts& counts = found.blobs;
  counts.received += blobs.count;
  work(Work::blobs_checked, blobs.count);
  CameraFrame near = frame;
  for (std::uint32_t i = 0; i < blobs.count; ++i) {
    const std::uint32_t* const words = blobs.words + i * blob_stream::words_per_blob;
    if (!is_blob(words, frame.image)) {
      ++counts.malformed;
      continue;
    }
    const Box box = box_of(words);
    if (box.right - box.left < options_.minimum_side ||
        box.bottom - box.top < options_.minimum_side) {
      ++counts.small;
      continue;
    }
    near.part = around(box, frame.image);
    DetectedMarker marker{};
    const Refusal refusal = read_blob(near, extremes_of(words), marker);
    if (refusal != Refusal::none) {
      ++counts.refused[static_cast<std::uint32_t>(refusal)];
      if (is_background(box, frame.image)) ++counts.background;
    } else {
      Detection detection{};
      detection.marker = marker;
      add_marker(detection, found);
    }
  }
}

void MarkerDetector::measure_again(const CameraFrame& frame, Detections& found) const {
  const FunctionScope scope(Function::marker_detection);
  for (std::uint32_t i = 0; i < found.count; ++i) {
    marker::measure_again(frame, book_.dictionary(), options_.detection, found.markers[i].marker);
  }
}

Refusal MarkerDetector::read_blob(const CameraFrame& near, const Extremes& extremes,
                                  DetectedMarker& marker) const {
  const bool has_outline = near.optics != nullptr && near.optics->reads_outlines;
  Quad guess{};
  Refusal refusal = Refusal::none;
  if (!largest_quad(extremes, guess)) {
    refusal = Refusal::shape;
  } else if (is_cut(guess, near.image)) {
    refusal = Refusal::hidden;
  }
  if (refusal != Refusal::none && !has_outline) return refusal;
  if (near.in_dma_memory) fetch(near.image, near.part);
  if (refusal == Refusal::none) {
    refusal = read_marker(near, guess, book_, options_.detection, marker);
  }
  if (refusal == Refusal::none || refusal == Refusal::plain || !has_outline) return refusal;
  return read_outline(near, extremes, marker) ? Refusal::none : refusal;
}

bool MarkerDetector::read_outline(const CameraFrame& near, const Extremes& extremes,
                                  DetectedMarker& marker) const {
  DetectionOptions options = options_.detection;
  options.white_border = std::max(options.white_border, hidden_cells);
  options.exact = true;
  options.fit.maximum_raggedness = std::max(options.fit.maximum_raggedness, hidden_raggedness);
  const OutlineQuads outline = quads_of_outline(near, extremes[0]);
  for (std::uint32_t i = 0; i < outline.count; ++i) {
    if (read_marker(near, outline.quads[i], book_, options, marker) == Refusal::none) return true;
  }
  for (std::uint32_t i = 0; i < outline.count; ++i) {
    if (read_narrow_marker(near, outline.quads[i], book_, options, marker) == Refusal::none) {
      return true;
    }
  }
  Quad guess{};
  return largest_quad(extremes, guess) &&
         read_narrow_marker(near, guess, book_, options, marker) == Refusal::none;
}

void MarkerDetector::find_poses(const Camera& camera, Detections& found) {
  if (options_.board.kind == Board::Kind::none) {
    for (std::uint32_t i = 0; i < found.count; ++i) {
      const QuadFit& fit = found.markers[i].marker.fit;
      seen_[0] = {single_marker(options_.board.marker_side), fit.ideal, own_weights(fit),
                  fit.common};
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
    seen.weights = own_weights(marker.fit);
    seen.common = marker.fit.common;
    ++found.board_markers;
  }
  found.board = estimate_board_pose(seen_.data(), found.board_markers, camera);
}

}  // namespace marker
