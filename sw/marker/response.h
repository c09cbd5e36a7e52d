#pragma once

#include <marker/inner_edges.h>
#include <marker/light_curves.h>
#include <marker/optics.h>

#include <cstdint>

namespace marker {

/// What a table leaves of the common shift, deviations of an edge's transition (measured): where
/// the curve is known, and where nothing is.
inline constexpr double shift_left = 0.004, unknown_shift = 0.40;

/// Finds the exponent of a camera's response curve from the edges inside markers, over the frames
/// of a run.
class ResponseFinder {
 public:
  /// Begins anew: nothing is known. For static memory.
  void open();

  /// How to look at the frame.
  const std::uint16_t* light() const { return table_.data(); }
  double common_shift() const { return common_shift_; }
  ResponseOrigin origin() const {
    return weight_ > 0 ? ResponseOrigin::found : ResponseOrigin::unknown;
  }
  /// 1 while nothing is known.
  double exponent() const { return exponent_; }

  /// True if so much was seen that single frames change little.
  bool is_settled() const;

  /// Begins a frame.
  void begin_frame();
  /// A marker of the frame, looked at with light().
  void add(const InnerShift& seen);
  /// Takes in what was added. True if the curve has changed so much that the frame's markers are
  /// worth another look.
  bool end_look();

 private:
  void make_table(double logarithm);
  void note_scatter();
  void begin_look();

  double logarithm_, weight_;  ///< what is known of the exponent: 1 / variance of its logarithm
  double scatter_;             ///< variance of single markers' shifts, in transitions
  double scatter_markers_;     ///< how many made it
  double common_shift_;
  // The look under way.
  double sum_, sum_weight_;  ///< logarithms, weighted
  double square_, noise_;    ///< of single markers' shifts, and what their edges explain
  std::uint32_t markers_;
  double vague_, vague_weight_;  ///< logarithms of blurred markers, weighted
  // The frame under way.
  double before_, before_weight_;  ///< what was known when it began
  std::uint32_t looks_;
  // The table.
  double table_logarithm_, exponent_;
  LightTable table_;
};

}  // namespace marker
