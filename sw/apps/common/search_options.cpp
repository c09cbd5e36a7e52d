#include <apps/common/search_options.h>
#include <hal/hal.h>
#include <marker/rectification.h>

namespace apps {
namespace {

enum class Option : std::uint32_t {
#define SEARCH_ENUMERATOR(name, ...) name,
  SEARCH_OPTIONS(SEARCH_ENUMERATOR)
#undef SEARCH_ENUMERATOR
};

double value(Option option) {
  return hal_option(static_cast<std::uint32_t>(option));
}

}  // namespace

SearchOptions read_search_options() {
  SearchOptions options{};
  options.margin = value(Option::margin);
  options.canonical_width = marker::canonical_width(value(Option::canonical_width));
  options.marker_side = value(Option::marker_side);
  options.reprojection_stop = value(Option::reprojection_stop);
  options.iteration_limit = static_cast<std::uint32_t>(value(Option::iteration_limit));
  return options;
}

}  // namespace apps
