#pragma once

#include <optional>
#include <string>
#include <vector>

#include <result/verdict.h>
#include <study/results.h>
#include <vp/expression.h>

/// What error bands leave of an order: a point that is better by less than the bands is better
/// perhaps.

namespace platform::study {

/// A figure at both ends of the bands that it is made of. Equal ends: it has none.
struct Span {
  double low = 0;
  double high = 0;
};

/// The names of the metric's ends: "power.total_w.low" and "power.total_w.high" of
/// "power.total_w.nominal"; empty for one that has no band.
std::vector<std::string> band_of(const std::string& metric);

/// The least and the most of a figure while each metric in it that has a band is at one of its
/// ends. None if the point has no value of it, or more than 8 metrics in it have bands.
std::optional<Span> span_in(const ResultRow& row, const vp::Expression& figure);

/// Whether another point is better, of each point the spans of its objectives. Yes: one is, with
/// both points anywhere within their spans. No: none can be. Points of one study are wrong in the
/// same direction, so "unknown" errs on the safe side.
std::vector<result::Holds> surely_dominated(const std::vector<std::vector<Span>>& points,
                                            const std::vector<bool>& maximise);

}  // namespace platform::study
