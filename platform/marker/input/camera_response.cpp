#include <marker/input/camera_response.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <marker/light_curves.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::input {

namespace {

/// What cameras have lies between.
constexpr double least_exponent = 0.5, most_exponent = 5;

/// Why a list of numbers is no curve; empty: it is one.
std::string problem_of(const std::vector<double>& light) {
  constexpr std::size_t levels = std::tuple_size_v<marker::LightTable>;
  if (light.size() != levels)
    return "of " + std::to_string(light.size()) + " numbers: give the light of 256 grey levels";
  if (!std::all_of(light.begin(), light.end(), [](double v) { return std::isfinite(v); }))
    return "with values that are no numbers";
  for (std::size_t i = 1; i < light.size(); ++i) {
    if (light[i] < light[i - 1])
      return "that falls at grey level " + std::to_string(i) +
             ": a brighter level must not be less light";
  }
  return light.back() > light.front() ? "" : "that is the same light at all levels";
}

void fill_from(const std::vector<double>& given, marker::LightTable& table) {
  const double range = given.back() - given.front();
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double share = (given[i] - given.front()) / range;
    table[i] = static_cast<std::uint16_t>(share * marker::white_light + 0.5);
  }
}

}  // namespace

Response response_of(const CalibrationEntry& entry, const std::string& what) {
  const auto refuse = [&](const std::string& problem) {
    throw vp::InputError(what + " has a response in '" + vp::excerpt(entry.name) + "' " + problem);
  };
  const std::vector<double>& numbers = entry.numbers;
  const std::string name = plain_name(entry.text);
  const auto table = std::make_shared<marker::LightTable>();
  if (numbers.size() > 1) {
    if (const std::string problem = problem_of(numbers); !problem.empty()) refuse(problem);
    fill_from(numbers, *table);
  } else if (numbers.size() == 1) {
    if (!(numbers[0] >= least_exponent && numbers[0] <= most_exponent))
      refuse("whose exponent is not 0.5 to 5");
    marker::fill_light(numbers[0], *table);
  } else if (name == "srgb") {
    marker::fill_srgb_light(*table);
  } else if (name == "rec709") {
    marker::fill_rec709_light(*table);
  } else if (name == "linear") {
    return {true, nullptr};
  } else {
    refuse(
        "that is not known: give linear, srgb, rec709, an exponent, or the light of 256 grey "
        "levels");
  }
  return {false, table};
}

}  // namespace platform::input
