#include <study/axis_check.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <vp/error.h>
#include <vp/unit.h>

namespace platform::study {

namespace {

/// The smallest, the largest, and one that is not whole.
std::vector<std::string> extremes(const std::vector<std::string>& values,
                                  const ParameterKind& kind) {
  const auto less = [&](const std::string& a, const std::string& b) {
    return number_of(kind, a) < number_of(kind, b);
  };
  std::set<std::string> chosen{*std::min_element(values.begin(), values.end(), less),
                               *std::max_element(values.begin(), values.end(), less)};
  for (const std::string& value : values) {
    if (!vp::parse_quantity(value, kind.unit).whole()) {
      chosen.insert(value);
      break;
    }
  }
  return {chosen.begin(), chosen.end()};
}

bool changes_others(const Elaborated& built, const ParameterTable& base, const std::string& path) {
  if (built.input < base.input() || base.input() < built.input) return true;
  const std::map<std::string, std::string> before = base.values();
  for (const vp::ParameterDescription& parameter : built.parameters) {
    const auto found = before.find(parameter.path);
    if (parameter.path != path && (found == before.end() || found->second != parameter.value))
      return true;
  }
  return built.parameters.size() != before.size();
}

}  // namespace

bool check_values(const AxisValues& axis, const std::vector<Base>& bases,
                  const Platform& platform) {
  const ParameterKind kind = bases.front().table.kind(axis.path());
  std::vector<std::string> values = axis.values();
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (kind.kind == ParameterKind::Kind::quantity) values = extremes(values, kind);
  bool influences = kind.kind != ParameterKind::Kind::quantity;
  for (const std::string& value : values) {
    for (const Base& base : bases) {
      Setup build = base.build;
      build.settings[axis.path()] = value;
      try {
        if (changes_others(platform.elaborate(build, axis.where()), base.table, axis.path()))
          influences = true;
      } catch (const vp::ParameterError& error) {
        if (error.path() == axis.path()) throw;
        influences = true;
      } catch (const vp::InputError&) {
        // Values that do not go together: such a point fails, and says why.
        influences = true;
      }
    }
  }
  return influences;
}

}  // namespace platform::study
