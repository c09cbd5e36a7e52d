#pragma once

#include <marker/feature_set.h>
#include <marker/geometry.h>

#include <array>
#include <cstdint>

namespace marker {

/// Candidates of one frame. A candidate takes four corners to itself, and a blob gives one at most.
inline constexpr std::uint32_t max_candidates = 1024;

/// Quadrants in the order in which a corner is offered to them.
enum Quadrant : unsigned { top_left = 0, top_right = 1, bottom_left = 2, bottom_right = 3 };

/// A blob with four suitable corners.
struct Candidate {
  std::uint16_t blob;                    ///< index into FeatureSet::blobs
  std::array<std::uint16_t, 4> corners;  ///< indices into FeatureSet::corners by Quadrant
};

struct CandidateList {
  std::uint32_t count;  ///< candidates stored
  std::uint32_t lost;   ///< candidates for which there was no room
  std::array<Candidate, max_candidates> candidates;
};

struct EvaluationOptions {
  /// How far outside its bounding box a blob's corner may lie, in px: thresholding shrinks a
  /// blurred marker (thesis 3.5.1). 4 px is a decision.
  double margin = 4.0;
};

/// Algorithm 1 of the thesis: gives each blob in turn the best unassigned corner of each quadrant
/// of its bounding box and keeps the blobs whose four corners make a convex quadrilateral. Corners
/// of the others are free again.
void evaluate_features(FeatureSet& features, const EvaluationOptions& options,
                       CandidateList& candidates);

/// The corners of a candidate as pixel indices, by Quadrant.
Quad candidate_corners(const FeatureSet& features, const Candidate& candidate);

/// Quadrant order (top left, top right, bottom left, bottom right) to clockwise order, and back: it
/// is its own inverse.
constexpr Quad swap_bottom(const Quad& q) {
  return {q[0], q[1], q[3], q[2]};
}

}  // namespace marker
