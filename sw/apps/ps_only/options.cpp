#include <apps/ps_only/options.h>

namespace ps_only {
namespace {

enum class Option : std::uint32_t {
#define PS_ONLY_ENUMERATOR(name, ...) name,
  PS_ONLY_OPTIONS(PS_ONLY_ENUMERATOR)
#undef PS_ONLY_ENUMERATOR
      count
};

double value(Option option) {
  return hal_option(static_cast<std::uint32_t>(option));
}

std::uint32_t whole(Option option) {
  return static_cast<std::uint32_t>(value(option));
}

}  // namespace

const hal_option_info option_table[] = {
#define PS_ONLY_ROW(name, unit, default_value, minimum, maximum, documentation) \
  {#name, unit, default_value, minimum, maximum, documentation},
    PS_ONLY_OPTIONS(PS_ONLY_ROW)
#undef PS_ONLY_ROW
};

const std::uint32_t option_count = static_cast<std::uint32_t>(Option::count);

Options read_options() {
  Options options{};
  static_cast<apps::SearchOptions&>(options) = apps::read_search_options();
  options.pixel_clock = value(Option::pixel_clock);
  options.cpu_clock = value(Option::cpu_clock);
  options.corner_threshold = whole(Option::corner_threshold);
  options.label_count = whole(Option::label_count);
  options.minimum_side = whole(Option::minimum_side);
  return options;
}

}  // namespace ps_only
