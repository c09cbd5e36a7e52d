#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <optional>

#include <study/axes.h>
#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform::study {

namespace {

std::optional<vp::Unit> unit_of(const std::string& value) {
  using vp::Unit;
  if (value.rfind("0x", 0) == 0) return Unit::address;
  for (const Unit unit : {Unit::none, Unit::frequency, Unit::time, Unit::bytes, Unit::pixels,
                          Unit::length, Unit::power, Unit::energy, Unit::voltage, Unit::cycles,
                          Unit::percent, Unit::angle, Unit::temperature}) {
    try {
      vp::parse_quantity(value, unit);
      return unit;
    } catch (const vp::InputError&) {
    }
  }
  return std::nullopt;
}

bool truth_of(const std::string& text) {
  for (const char* yes : {"true", "yes", "on"}) {
    if (text == yes) return true;
  }
  for (const char* no : {"false", "no", "off"}) {
    if (text == no) return false;
  }
  throw vp::InputError("is neither true nor false");
}

}  // namespace

// A default is written with its unit, and each unit belongs to one dimension.
ParameterKind kind_of(const vp::ParameterDescription& description) {
  if (description.allowed == "true or false") return {ParameterKind::Kind::truth, vp::Unit::none};
  const std::optional<vp::Unit> unit = unit_of(description.default_value);
  if (!unit) return {};
  return {ParameterKind::Kind::quantity, *unit};
}

std::string normalised(const ParameterKind& kind, const std::string& text) {
  if (kind.kind == ParameterKind::Kind::text) return text;
  if (kind.kind == ParameterKind::Kind::truth) return truth_of(text) ? "true" : "false";
  const vp::Decimal value = vp::parse_quantity(text, kind.unit);
  if (value.whole()) return vp::format_quantity(value, kind.unit);
  return vp::format_quantity(vp::Decimal(value.to_double()), kind.unit);
}

double number_of(const ParameterKind& kind, const std::string& text) {
  if (kind.kind == ParameterKind::Kind::truth) return truth_of(text) ? 1 : 0;
  if (kind.kind == ParameterKind::Kind::text) throw vp::InputError("is a text");
  return vp::parse_quantity(text, kind.unit).to_double();
}

vp::ExpressionValue value_of(const ParameterKind& kind, const std::string& text) {
  vp::ExpressionValue value;
  value.is_text = kind.kind == ParameterKind::Kind::text;
  if (value.is_text) {
    value.text = text;
  } else {
    value.unit = kind.unit;
    value.number = number_of(kind, text);
  }
  return value;
}

ParameterTable::ParameterTable(const Elaborated& elaborated)
    : parameters_(elaborated.parameters), input_(elaborated.input) {
  for (std::size_t i = 0; i < parameters_.size(); ++i) index_[parameters_[i].path] = i;
}

const vp::ParameterDescription& ParameterTable::find(const std::string& path,
                                                     const std::string& where) const {
  const auto found = index_.find(path);
  if (found != index_.end()) return parameters_[found->second];
  const std::string nearest = vp::nearest_match(path, paths());
  throw vp::InputError(
      (where.empty() ? "" : where + ": ") + "unknown parameter '" + path + "': " +
      (nearest.empty() ? "'markervp config' prints them all" : "did you mean '" + nearest + "'?"));
}

ParameterKind ParameterTable::kind(const std::string& path) const {
  return kind_of(find(path));
}

std::vector<std::string> ParameterTable::paths() const {
  std::vector<std::string> paths;
  for (const vp::ParameterDescription& parameter : parameters_) paths.push_back(parameter.path);
  return paths;
}

std::map<std::string, std::string> ParameterTable::defaults() const {
  std::map<std::string, std::string> values;
  for (const vp::ParameterDescription& parameter : parameters_)
    values[parameter.path] = parameter.default_value;
  return values;
}

std::map<std::string, std::string> ParameterTable::values() const {
  std::map<std::string, std::string> values;
  for (const vp::ParameterDescription& parameter : parameters_)
    values[parameter.path] = parameter.value;
  return values;
}

namespace {

/// A longer list is a mistake, and would fill the memory.
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
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(count); ++i)
    values_.push_back(written(start_ + static_cast<double>(i) * step));
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

std::vector<std::string> AxisValues::neighbours(const std::string& value) const {
  std::vector<std::string> found;
  if (!ordered()) {
    std::copy_if(values_.begin(), values_.end(), std::back_inserter(found),
                 [&](const std::string& other) { return other != value; });
    return found;
  }
  const double here = number_of(kind_, value);
  if (continuous_) {
    const double level = logarithmic_ ? std::log(here / start_) / std::log(stop_ / start_)
                                      : (here - start_) / (stop_ - start_);
    for (const double step : {-0.05, 0.05}) {
      const std::string other = written(between(std::clamp(level + step, 0.0, 1.0)));
      if (other != value) found.push_back(other);
    }
    return found;
  }
  const std::string* below = nullptr;
  const std::string* above = nullptr;
  for (const std::string& other : values_) {
    const double number = number_of(kind_, other);
    if (number < here && (below == nullptr || number > number_of(kind_, *below))) below = &other;
    if (number > here && (above == nullptr || number < number_of(kind_, *above))) above = &other;
  }
  for (const std::string* other : {below, above}) {
    if (other != nullptr) found.push_back(*other);
  }
  return found;
}

double AxisValues::level_of(double level) const {
  if (continuous_ || values_.size() < 2) return level;
  const auto last = static_cast<double>(values_.size() - 1);
  return static_cast<double>(std::lround(level * last)) / last;
}

}  // namespace platform::study
