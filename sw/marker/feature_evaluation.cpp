#include <marker/feature_evaluation.h>
#include <marker/work.h>

namespace marker {
namespace {

constexpr std::uint16_t no_corner = 0xFFFF;

constexpr std::uint32_t bit(Direction direction) {
  return 1u << static_cast<unsigned>(direction);
}

/// The directions that suit a quadrant: table 3.1 with its first two rows exchanged. As printed 6
/// of the 12 roll angles of the thesis' tests are lost.
constexpr std::uint32_t suitable[] = {
    bit(Direction::north) | bit(Direction::west),  // top left
    bit(Direction::north) | bit(Direction::east),  // top right
    bit(Direction::south) | bit(Direction::west),  // bottom left
    bit(Direction::south) | bit(Direction::east),  // bottom right
};

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
      if (corner.assigned) continue;
      MARKERVP_COUNT(box_tests_);
      if (!contains(corner)) continue;
      offer(static_cast<std::uint16_t>(i), corner);
    }
    work(Work::corner_tests, features_.corner_count);
    work(Work::box_tests, box_tests_);
    work(Work::corners_inside, corners_inside_);
    work(Work::quadrant_tests, quadrant_tests_);
    work(Work::score_evaluations, score_evaluations_);
  }

  bool is_candidate() const {
    for (const std::uint16_t corner : best_) {
      if (corner == no_corner) return false;
    }
    work(Work::quads_checked, 1);
    return is_convex_clockwise(swap_bottom(candidate_corners(features_, {0, best_})));
  }

  void release() {
    for (const std::uint16_t corner : best_) {
      if (corner != no_corner) features_.corners[corner].assigned = 0;
    }
  }

  const std::array<std::uint16_t, 4>& corners() const { return best_; }

 private:
  /// All four sides at once: most corners are outside, and a branch for each would cost more.
  bool contains(const Corner& c) const {
    return (static_cast<unsigned>(c.x >= left_) & (c.x <= right_) & (c.y >= top_) &
            (c.y <= bottom_)) != 0;
  }

  /// A bit for each quadrant that the corner is in. The mid-lines belong to both sides.
  std::uint32_t quadrants_of(const Corner& c) const {
    const unsigned left = c.x <= centre_x_, right = c.x >= centre_x_;
    const unsigned top = c.y <= centre_y_, bottom = c.y >= centre_y_;
    return (left & top) << top_left | (right & top) << top_right | (left & bottom) << bottom_left |
           (right & bottom) << bottom_right;
  }

  /// Equation 3.2: outer corners win over false ones on the border and inside.
  double score(const Corner& c) const {
    const double x = c.x < centre_x_ ? centre_x_ - c.x : c.x - centre_x_;
    const double y = c.y < centre_y_ ? centre_y_ - c.y : c.y - centre_y_;
    return c.strength * (x / half_width_ + y / half_height_);
  }

  /// The first quadrant that accepts the corner takes it.
  void offer(std::uint16_t index, const Corner& corner) {
    const std::uint32_t quadrants = quadrants_of(corner);
    const std::uint32_t direction = bit(corner.direction);
    MARKERVP_COUNT(corners_inside_);
    for (unsigned quadrant = 0; quadrant < 4; ++quadrant) {
      MARKERVP_COUNT(quadrant_tests_);
      const unsigned fits = (quadrants >> quadrant & 1u) & ((suitable[quadrant] & direction) != 0);
      if (fits == 0) continue;
      MARKERVP_COUNT(score_evaluations_);
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
  std::uint32_t box_tests_ = 0;
  std::uint32_t corners_inside_ = 0;
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
  work(Work::corners_freed, features.corner_count);
  work(Work::blobs_evaluated, features.blob_count);
  work(Work::candidates, candidates.count);
}

}  // namespace marker
