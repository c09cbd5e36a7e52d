#include <marker/marker_search.h>

namespace marker {

Identification identify_candidate(const BinaryImage& image, const Quad& corners,
                                  std::uint32_t canonical_width) {
  const Homography homography = make_homography(corners, canonical_width);
  if (!homography.valid) return {};
  CellCounts cells;
  rectify(image, homography, canonical_width, cells);
  return identify(cells);
}

Quad marker_corners(const Quad& corners, unsigned rotation) {
  const Quad clockwise = swap_bottom(corners);
  Quad result{};
  for (unsigned i = 0; i < 4; ++i) {
    const Point& corner = clockwise[(rotation + i) % 4];
    result[i] = {corner.x + 0.5, corner.y + 0.5};
  }
  return result;
}

FoundMarker find_first_marker(const FeatureSet& features, const CandidateList& candidates,
                              const BinaryImage& image, std::uint32_t canonical_width) {
  FoundMarker result{};
  for (std::uint32_t i = 0; i < candidates.count; ++i) {
    const Quad corners = candidate_corners(features, candidates.candidates[i]);
    ++result.examined;
    result.identity = identify_candidate(image, corners, canonical_width);
    if (result.identity.found) {
      result.found = true;
      result.candidate = i;
      result.corners = marker_corners(corners, result.identity.rotation);
      break;
    }
  }
  return result;
}

}  // namespace marker
