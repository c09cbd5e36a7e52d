#pragma once

#include <marker/lens_models.h>

#include <array>
#include <cstdint>

namespace marker {

/// What is known of the light that a camera's grey levels stand for.
enum class ResponseOrigin : std::uint32_t {
  unknown,  ///< the levels are taken for light
  found,    ///< an exponent, from the edges inside markers
  given,    ///< by the user or the camera's file
};

constexpr const char* response_name(ResponseOrigin origin) {
  switch (origin) {
    case ResponseOrigin::unknown:
      return "unknown";
    case ResponseOrigin::found:
      return "found";
    case ResponseOrigin::given:
      return "given";
  }
  return "?";
}

/// The light of white, which every table has at level 255.
inline constexpr std::uint16_t white_light = 65535;

/// The light of each grey level, 0 to white_light, rising.
using LightTable = std::array<std::uint16_t, 256>;

/// What a picture needs beyond a pinhole or Brown–Conrady's lens and levels that are light.
struct Optics {
  GeneralLens lens;
  const std::uint16_t* light = nullptr;  ///< a LightTable; linear_light() where levels are light
  /// Edges between dark and bright may all be shifted towards one of them by this deviation, in
  /// deviations of their transition.
  double common_shift = 0;
  bool seeks_response = false;  ///< the edges inside each marker are measured
  bool tries_again = false;     ///< what is refused is looked at once more, nearer to the edge
  bool reads_outlines = false;  ///< and then its outline is followed
};

}  // namespace marker
