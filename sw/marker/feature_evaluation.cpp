#include <marker/feature_evaluation.h>
#include <marker/work.h>

namespace marker {
namespace {

constexpr std::uint16_t no_corner = 0xFFFF;

/// Table 3.1 with its first two rows exchanged: as printed 6 of the 12 roll angles of the thesis'
/// tests are lost.
constexpr bool is_suitable(Direction direction, unsigned quadrant) {
  switch (quadrant) {
    case top_left:
      return direction == Direction::north || direction == Direction::west;
    case top_right:
      return direction == Direction::north || direction == Direction::east;
    case bottom_left:
      return direction == Direction::south || direction == Direction::west;
    default:
      return direction == Direction::south || direction == Direction::east;
  }
}

/// One blob looking for its corners.
class BlobEvaluation {
 public:
  BlobEvaluation(FeatureSet& features, const BoundingBox& box, double margin)
      : features_(features),
        left_(box.sx - margin),
        right_(box.ex + margin),
        top_(box.sy - margin),
        bottom_(box.ey + margin),
        centre_x_((box.sx + box.ex) / 2.0),
        centre_y_((box.sy + box.ey) / 2.0),
        half_width_((box.ex - box.sx) / 2.0 + margin),
        half_height_((box.ey - box.sy) / 2.0 + margin) {}

  void run() {
    if (!(half_width_ > 0 && half_height_ > 0)) return;
    for (std::uint32_t i = 0; i < features_.corner_count; ++i) {
      const Corner& corner = features_.corners[i];
      if (corner.assigned || !contains(corner)) continue;
      offer(static_cast<std::uint16_t>(i), corner);
    }
    work(Work::corner_tests, features_.corner_count);
    work(Work::quadrant_tests, quadrant_tests_);
    work(Work::score_evaluations, score_evaluations_);
  }

  bool is_candidate() const {
    for (const std::uint16_t corner : best_) {
      if (corner == no_corner) return false;
    }
    return is_convex_clockwise(swap_bottom(candidate_corners(features_, {0, best_})));
  }

  void release() {
    for (const std::uint16_t corner : best_) {
      if (corner != no_corner) features_.corners[corner].assigned = 0;
    }
  }

  const std::array<std::uint16_t, 4>& corners() const { return best_; }

 private:
  bool contains(const Corner& c) const {
    return c.x >= left_ && c.x <= right_ && c.y >= top_ && c.y <= bottom_;
  }

  /// The mid-lines belong to both sides.
  bool is_in_quadrant(const Corner& c, unsigned quadrant) const {
    const bool is_left = quadrant == top_left || quadrant == bottom_left;
    const bool is_top = quadrant == top_left || quadrant == top_right;
    return (is_left ? c.x <= centre_x_ : c.x >= centre_x_) &&
           (is_top ? c.y <= centre_y_ : c.y >= centre_y_);
  }

  /// Equation 3.2: outer corners win over false ones on the border and inside.
  double score(const Corner& c) const {
    const double x = c.x < centre_x_ ? centre_x_ - c.x : c.x - centre_x_;
    const double y = c.y < centre_y_ ? centre_y_ - c.y : c.y - centre_y_;
    return c.strength * (x / half_width_ + y / half_height_);
  }

  /// The first quadrant that accepts the corner takes it.
  void offer(std::uint16_t index, const Corner& corner) {
    for (unsigned quadrant = 0; quadrant < 4; ++quadrant) {
      ++quadrant_tests_;
      if (!is_in_quadrant(corner, quadrant) || !is_suitable(corner.direction, quadrant)) continue;
      ++score_evaluations_;
      const double corner_score = score(corner);
      if (!(corner_score > best_score_[quadrant])) continue;
      if (best_[quadrant] != no_corner) features_.corners[best_[quadrant]].assigned = 0;
      best_[quadrant] = index;
      best_score_[quadrant] = corner_score;
      features_.corners[index].assigned = 1;
      return;
    }
  }

  FeatureSet& features_;
  double left_, right_, top_, bottom_;
  double centre_x_, centre_y_, half_width_, half_height_;
  std::array<std::uint16_t, 4> best_{no_corner, no_corner, no_corner, no_corner};
  std::array<double, 4> best_score_{};
  std::uint32_t quadrant_tests_ = 0;
  std::uint32_t score_evaluations_ = 0;
};

}  // namespace

Quad candidate_corners(const FeatureSet& features, const Candidate& candidate) {
  Quad quad{};
  for (unsigned i = 0; i < 4; ++i) {
    const Corner& corner = features.corners[candidate.corners[i]];
    quad[i] = {static_cast<double>(corner.x), static_cast<double>(corner.y)};
  }
  return quad;
}

void evaluate_features(FeatureSet& features, const EvaluationOptions& options,
                       CandidateList& candidates) {
  const FunctionScope scope(Function::feature_evaluation);
  candidates.count = candidates.lost = 0;
  for (std::uint32_t i = 0; i < features.corner_count; ++i) features.corners[i].assigned = 0;

  for (std::uint32_t blob = 0; blob < features.blob_count; ++blob) {
    BlobEvaluation evaluation(features, features.blobs[blob], options.margin);
    evaluation.run();
    if (!evaluation.is_candidate()) {
      evaluation.release();
    } else if (candidates.count == max_candidates) {
      ++candidates.lost;
    } else {
      candidates.candidates[candidates.count++] = {static_cast<std::uint16_t>(blob),
                                                   evaluation.corners()};
    }
  }
  work(Work::blobs_evaluated, features.blob_count);
  work(Work::candidates, candidates.count);
}

}  // namespace marker
