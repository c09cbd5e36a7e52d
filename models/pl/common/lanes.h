#pragma once

#include <cstdint>
#include <deque>
#include <string>

namespace pl {

/// That a clock may bring.
constexpr std::uint32_t most_pixels_per_clock = 4;

/// The port for the pixel that lies `lane` to the right of that at the port `pixel`.
inline std::string lane_name(const std::string& pixel, std::uint32_t lane) {
  return pixel + "_" + std::to_string(lane);
}

/// Ports for the other pixels of a clock where more than one comes: `<pixel>_1` beside its right
/// neighbour, and so on.
template <class Port>
class Lanes : public std::deque<Port> {
 public:
  /// `more`: what each port is made with besides its name.
  template <class... More>
  Lanes(const std::string& pixel, std::uint32_t pixels_per_clock, More... more) {
    for (std::uint32_t lane = 1; lane < pixels_per_clock; ++lane)
      this->emplace_back(lane_name(pixel, lane).c_str(), more...);
  }

  /// Binds each to what drives its lane.
  template <class Drivers>
  void operator()(Drivers& drivers) {
    for (std::size_t lane = 0; lane < this->size(); ++lane) (*this)[lane](drivers[lane]);
  }
};

}  // namespace pl
