#include <sweep/axis_values.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include <vp/decimal.h>
#include <vp/error.h>

namespace platform::sweep {

namespace {

/// A list that nobody types, and that would fill the memory.
constexpr double most_values = 10e6;

/// Steps that miss the end by less are meant to reach it.
constexpr double step_tolerance = 1e-9;

/// Models keep these in whole base units, which are small.
bool always_whole(vp::Unit unit) {
  return unit == vp::Unit::frequency || unit == vp::Unit::time || unit == vp::Unit::bytes ||
         unit == vp::Unit::address;
}

bool may_be_whole(vp::Unit unit) {
  return unit == vp::Unit::none || unit == vp::Unit::pixels || unit == vp::Unit::cycles;
}

bool has_point(const std::string& text) {
  return text.find('.') != std::string::npos;
}

}  // namespace

AxisValues::AxisValues(const Axis& axis, const ParameterKind& kind)
    : path_(axis.path), where_(axis.where), kind_(kind) {
  if (axis.range) {
    if (kind.kind != ParameterKind::Kind::quantity) fail("takes no range: list its values in [ ]");
    make_range(*axis.range);
  } else {
    make_list(axis.values, kind);
  }
}

void AxisValues::fail(const std::string& problem) const {
  throw vp::InputError(where_ + ": " + path_ + " " + problem);
}

void AxisValues::make_list(const std::vector<std::string>& written, const ParameterKind& kind) {
  for (const std::string& value : written) {
    try {
      values_.push_back(normalised(kind, value));
    } catch (const vp::InputError& error) {
      throw vp::InputError(where_ + ": " + path_ + ": '" + value + "' " + error.what());
    }
  }
}

double AxisValues::end(const std::string& text, const char* name) const {
  try {
    return number_of(kind_, text);
  } catch (const vp::InputError& error) {
    throw vp::InputError(where_ + ": " + path_ + ": " + name + " '" + text + "' " + error.what());
  }
}

void AxisValues::make_range(const ValueRange& range) {
  start_ = end(range.start, "start");
  stop_ = end(range.stop, "stop");
  logarithmic_ = range.logarithmic;
  const bool written_whole =
      !has_point(range.start) && !has_point(range.stop) && !(range.step && has_point(*range.step));
  whole_ = always_whole(kind_.unit) || (may_be_whole(kind_.unit) && written_whole);
  if (start_ > stop_) fail("starts at " + range.start + ", behind its stop " + range.stop);
  if (logarithmic_ && start_ <= 0) fail("has a logarithmic range that does not start above 0");
  if (range.step) return add_steps(end(*range.step, "step"), *range.step);
  if (range.count) {
    if (*range.count == 1 && start_ != stop_) fail("has count 1: write the value, without a range");
    const double last = std::max<double>(1, *range.count - 1);
    for (std::uint32_t i = 0; i < *range.count; ++i) values_.push_back(written(between(i / last)));
    return;
  }
  continuous_ = true;
  values_ = {written(start_), written(stop_)};
}

void AxisValues::add_steps(double step, const std::string& written_step) {
  if (!(step > 0)) fail("has the step " + written_step + ", which is not above 0");
  const double count = std::floor((stop_ - start_) / step + step_tolerance) + 1;
  if (count > most_values)
    fail(
        "has a range of more than 10 million values, too many also for --yes and --limit: make "
        "'step' larger, or leave it out and draw a sample ('sample: {method: sobol, points: "
        "1000}')");
  for (double i = 0; i < count; ++i) values_.push_back(written(start_ + i * step));
}

double AxisValues::between(double u) const {
  if (logarithmic_) return start_ * std::pow(stop_ / start_, u);
  return start_ + u * (stop_ - start_);
}

// Twelve digits: what binary fractions add behind them says nothing.
std::string AxisValues::written(double value) const {
  if (whole_) value = std::round(value);
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", value);
  const std::optional<vp::Decimal> decimal = vp::Decimal::parse(text);
  return normalised(kind_, vp::format_quantity(decimal.value_or(vp::Decimal(value)), kind_.unit));
}

std::string AxisValues::sampled(double u) const {
  if (!continuous_) {
    const auto index = static_cast<std::size_t>(u * static_cast<double>(values_.size()));
    return values_[std::min(index, values_.size() - 1)];
  }
  // Each whole number is as likely as the others, the ends too.
  if (whole_ && !logarithmic_ && may_be_whole(kind_.unit))
    return written(std::min(stop_, start_ + std::floor(u * (stop_ - start_ + 1))));
  return written(between(u));
}

std::string AxisValues::at_level(double level) const {
  if (continuous_) return written(between(level));
  return values_[static_cast<std::size_t>(
      std::lround(level * static_cast<double>(values_.size() - 1)))];
}

double AxisValues::level_of(double level) const {
  if (continuous_ || values_.size() < 2) return level;
  const auto last = static_cast<double>(values_.size() - 1);
  return static_cast<double>(std::lround(level * last)) / last;
}

}  // namespace platform::sweep
