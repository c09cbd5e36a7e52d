#include <algorithm>
#include <map>
#include <set>

#include <sweep/axis_check.h>
#include <vp/decimal.h>
#include <vp/error.h>

namespace platform::sweep {

namespace {

using Kind = ParameterKind::Kind;

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
  if (built.size.width != base.size().width || built.size.height != base.size().height) return true;
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
  if (kind.kind == Kind::quantity) values = extremes(values, kind);
  bool influences = kind.kind != Kind::quantity;
  for (const std::string& value : values) {
    for (const Base& base : bases) {
      Build build = base.build;
      build.settings[axis.path()] = value;
      try {
        if (changes_others(platform.elaborate(build, axis.where()), base.table, axis.path()))
          influences = true;
      } catch (const vp::InputError& error) {
        // Other errors come from values together; such a point fails, and says why.
        if (std::string(error.what()).rfind(axis.path() + ":", 0) == 0) throw;
        influences = true;
      }
    }
  }
  return influences;
}

}  // namespace platform::sweep
