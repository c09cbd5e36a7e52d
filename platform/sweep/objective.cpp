#include <sweep/objective.h>

#include <vp/error.h>
#include <vp/text.h>

namespace platform::sweep {

namespace {

/// What stands behind "max " or "min ".
std::string figure_text(const std::string& text, const std::string& where) {
  const std::string trimmed(vp::trim(text));
  const std::string first = trimmed.substr(0, 4);
  if ((first != "max " && first != "min ") || trimmed.size() < 5)
    throw vp::InputError(where + ": the objective '" + text +
                         "' does not say which way is better: write 'max METRIC' or 'min METRIC'");
  return trimmed.substr(4);
}

}  // namespace

Objective::Objective(const std::string& text, const std::string& where)
    : maximise_(vp::trim(text).substr(0, 3) == "max"), figure_(figure_text(text, where), where) {}

}  // namespace platform::sweep
