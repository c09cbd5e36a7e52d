#include <marker/angles.h>
#include <marker/light_curves.h>

namespace marker {
namespace {

constexpr LightTable make_linear() {
  LightTable linear{};
  for (std::uint32_t i = 0; i < linear.size(); ++i) {
    linear[i] = static_cast<std::uint16_t>(white_light / 255 * i);
  }
  return linear;
}
constexpr LightTable linear_table = make_linear();

/// Light of a level from 0 to 1: `slope` of it up to `knee`, behind it a power.
template <class Power>
void fill(double knee, double slope, Power power_of, LightTable& table) {
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    const double level = i / 255.0;
    const double light = level <= knee ? level * slope : power_of(level);
    table[i] = static_cast<std::uint16_t>(light * white_light + 0.5);
  }
  table[255] = white_light;
}

}  // namespace

const std::uint16_t* linear_light() {
  return linear_table.data();
}

void fill_light(double exponent, LightTable& table) {
  fill(
      0, 0, [&](double level) { return power(level, exponent); }, table);
}

void fill_srgb_light(LightTable& table) {
  fill(
      0.04045, 1 / 12.92, [](double level) { return power((level + 0.055) / 1.055, 2.4); }, table);
}

void fill_rec709_light(LightTable& table) {
  fill(
      0.081, 1 / 4.5, [](double level) { return power((level + 0.099) / 1.099, 1 / 0.45); }, table);
}

}  // namespace marker
