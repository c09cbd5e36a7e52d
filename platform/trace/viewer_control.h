#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace platform::trace {

/// What a waveform viewer is to show.
struct Viewing {
  std::string file;                    ///< whole path: the viewer runs elsewhere
  std::vector<std::string> signals;    ///< as the file calls them
  std::optional<std::uint64_t> steps;  ///< the moment, in steps of the file's time
};

/// Where a viewer listens if its user changes nothing.
struct ViewerPort {
  std::uint16_t port;
  const char* viewer;
};
inline constexpr ViewerPort usual_viewers[] = {{54321, "Surfer"}, {54322, "VaporView"}};

/// Asks a viewer on this machine by the Waveform Control Protocol, version 0: JSON messages over
/// TCP, each ended by a zero byte (https://gitlab.com/waveform-control-protocol/wcp). Without a
/// port the first of the usual ones that answers. Returns what the viewer could not do of what it
/// may leave out. Throws vp::InputError if no viewer listens, or if it cannot open the file.
std::vector<std::string> show_in_viewer(const Viewing& viewing, std::optional<std::uint16_t> port);

}  // namespace platform::trace
