#include <vp/error.h>
#include <vp/parameter.h>

#include <algorithm>

namespace vp {

ParameterBase::ParameterBase(const char* name, Unit unit, Source source, std::string documentation)
    : sc_core::sc_object(name),
      unit_(unit),
      source_(source),
      documentation_(std::move(documentation)) {
  if (std::string(basename()) != name)
    misdeclared("a sibling is already called '" + std::string(name) + "'");
}

const Setting* ParameterBase::any_setting() const {
  const Configuration* configuration = Configuration::current();
  return configuration == nullptr ? nullptr : configuration->find(name());
}

const Setting* ParameterBase::setting() const {
  const Setting* given = any_setting();
  if (given && given->is_list) refuse(*given, "is a list: write one value");
  return given;
}

void ParameterBase::publish(std::string value, std::string default_value, std::string allowed) {
  text_ = std::move(value);
  is_changed_ = text_ != default_value;
  if (Configuration* configuration = Configuration::current()) {
    configuration->add(
        {name(), text_, std::move(default_value), std::move(allowed), source_, documentation_});
  }
}

void ParameterBase::follows(const std::string& others) const {
  if (Configuration* configuration = Configuration::current())
    configuration->set_follows(name(), others);
}

Decimal::Whole ParameterBase::whole_value(const Setting& setting, Decimal::Whole min,
                                          Decimal::Whole max) const {
  std::optional<Decimal::Whole> value;
  try {
    value = parse_quantity(setting.text, unit_).whole();
  } catch (const InputError& error) {
    refuse(setting, error.what());
  }
  if (!value) {
    const std::string base = base_unit(unit_);
    refuse(setting, "is not a whole number" + (base.empty() ? "" : " of " + base));
  }
  if (*value < min || *value > max)
    refuse(setting, "is out of range: allowed is " + whole_range(min, max));
  return *value;
}

double ParameterBase::real_value(const Setting& setting, double min, double max) const {
  double value = 0.0;
  try {
    value = parse_quantity(setting.text, unit_).to_double();
  } catch (const InputError& error) {
    refuse(setting, error.what());
  }
  if (!(min <= value && value <= max)) {
    refuse(setting, "is out of range: allowed is " + real_range(min, max));
  }
  return value;
}

bool ParameterBase::truth_value(const Setting& setting) const {
  for (const char* yes : {"true", "yes", "on"}) {
    if (setting.text == yes) return true;
  }
  for (const char* no : {"false", "no", "off"}) {
    if (setting.text == no) return false;
  }
  refuse(setting, "is neither true nor false");
}

std::size_t ParameterBase::choice(const Setting& setting,
                                  const std::vector<std::string>& names) const {
  const auto found = std::find(names.begin(), names.end(), setting.text);
  if (found != names.end()) return found - names.begin();
  const std::string nearest = nearest_match(setting.text, names);
  refuse(setting, "is not one of its values, " + one_of(names) +
                      (nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
}

void ParameterBase::refuse(const Setting& setting, const std::string& problem) const {
  throw ParameterError(
      name(), std::string(name()) + ": '" + setting.text + "' (" + setting.origin + ") " + problem);
}

void ParameterBase::misdeclared(const std::string& problem) const {
  throw std::logic_error("parameter '" + std::string(name()) + "' is declared wrongly: " + problem);
}

std::string ParameterBase::whole_range(Decimal::Whole min, Decimal::Whole max) const {
  return format_quantity(Decimal(min, 0), unit_) + " to " + format_quantity(Decimal(max, 0), unit_);
}

std::string ParameterBase::real_range(double min, double max) const {
  using Limits = std::numeric_limits<double>;
  const bool any_min = min == Limits::lowest();
  const bool any_max = max == Limits::max();
  if (any_min && any_max) return "";
  if (any_min) return "at most " + format_quantity(Decimal(max), unit_);
  if (any_max) return "at least " + format_quantity(Decimal(min), unit_);
  return format_quantity(Decimal(min), unit_) + " to " + format_quantity(Decimal(max), unit_);
}

Parameter<std::string>::Parameter(const char* name, std::string default_value, Source source,
                                  std::string documentation)
    : ParameterBase(name, Unit::none, source, std::move(documentation)), value_(default_value) {
  if (const Setting* given = setting()) value_ = given->text;
  publish(value_, std::move(default_value), "");
}

Parameter<std::string>::Parameter(const char* name, std::string default_value,
                                  std::vector<std::string> choices, Source source,
                                  std::string documentation)
    : ParameterBase(name, Unit::none, source, std::move(documentation)), value_(default_value) {
  if (std::find(choices.begin(), choices.end(), default_value) == choices.end()) {
    misdeclared("its default is not one of its choices");
  }
  if (const Setting* given = setting()) value_ = choices[choice(*given, choices)];
  publish(value_, std::move(default_value), one_of(choices));
}

ListParameter::ListParameter(const char* name, Source source, std::string documentation)
    : ParameterBase(name, Unit::none, source, std::move(documentation)) {
  if (const Setting* given = any_setting()) {
    value_ = given->text;
    origin_ = given->origin;
  }
  publish(value_, "", "");
}

}  // namespace vp
