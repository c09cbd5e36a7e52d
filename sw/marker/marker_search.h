#pragma once

#include <marker/feature_evaluation.h>
#include <marker/identification.h>
#include <marker/images.h>

#include <cstdint>

namespace marker {

/// A marker found, before its pose.
struct FoundMarker {
  bool found;
  std::uint32_t candidate;  ///< index into CandidateList::candidates
  std::uint32_t examined;   ///< candidates rectified until then
  Identification identity;
  Quad corners;  ///< px (pixel index + 0.5), clockwise from the marker's own top left
};

/// Rectifies and identifies one candidate's corners (pixel indices by Quadrant).
Identification identify_candidate(const BinaryImage& image, const Quad& corners,
                                  std::uint32_t canonical_width);

/// The corners, pixel indices by Quadrant, of a marker turned by `rotation` quarters: in px,
/// clockwise from the marker's own top left (thesis 4.5.5).
Quad marker_corners(const Quad& corners, unsigned rotation);

/// Identifies the candidates in their order; the first marker ends the search.
FoundMarker find_first_marker(const FeatureSet& features, const CandidateList& candidates,
                              const BinaryImage& image, std::uint32_t canonical_width);

}  // namespace marker
