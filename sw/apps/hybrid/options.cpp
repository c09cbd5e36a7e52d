#include <apps/hybrid/options.h>

namespace hybrid {
namespace {

enum class Option : std::uint32_t {
#define HYBRID_ENUMERATOR(name, ...) name,
  HYBRID_OPTIONS(HYBRID_ENUMERATOR)
#undef HYBRID_ENUMERATOR
      count
};

double value(Option option) {
  return hal_option(static_cast<std::uint32_t>(option));
}

}  // namespace

const hal_option_info option_table[] = {
#define HYBRID_ROW(name, unit, default_value, minimum, maximum, documentation) \
  {#name, unit, default_value, minimum, maximum, documentation},
    HYBRID_OPTIONS(HYBRID_ROW)
#undef HYBRID_ROW
};

const std::uint32_t option_count = static_cast<std::uint32_t>(Option::count);

Options read_options() {
  Options options{};
  static_cast<apps::SearchOptions&>(options) = apps::read_search_options();
  options.upload = value(Option::upload) >= 0.5;
  options.burst_words = static_cast<std::uint32_t>(value(Option::burst_words));
  options.timeout = value(Option::timeout);
  options.binary_timeout = value(Option::binary_timeout);
  return options;
}

}  // namespace hybrid
