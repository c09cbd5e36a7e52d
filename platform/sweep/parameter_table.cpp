#include <sweep/parameter_table.h>

#include <algorithm>
#include <optional>

#include <vp/decimal.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::sweep {

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

ParameterTable::ParameterTable(const Elaborated& elaborated)
    : parameters_(elaborated.parameters), size_(elaborated.size) {
  for (std::size_t i = 0; i < parameters_.size(); ++i) index_[parameters_[i].path] = i;
}

const vp::ParameterDescription& ParameterTable::find(const std::string& path,
                                                     const std::string& where) const {
  const auto found = index_.find(path);
  if (found != index_.end()) return parameters_[found->second];
  const std::string nearest = vp::nearest_match(path, paths());
  throw vp::InputError(
      where + ": unknown parameter '" + path + "': " +
      (nearest.empty() ? "'markervp config' prints them all" : "did you mean '" + nearest + "'?"));
}

ParameterKind ParameterTable::kind(const std::string& path) const {
  return kind_of(find(path, "sweep"));
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

}  // namespace platform::sweep
