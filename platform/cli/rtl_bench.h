#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include <cli/rtl_stimuli.h>
#include <pl/common/geometry.h>
#include <vp/parameter.h>

namespace platform::cli {

/// RTL in lock-step with the model of its IP, which a bench has alone: it drives the pins as no
/// platform does within a minute. Resets of a clock at any moment, frames that are cut behind a few
/// pixels and follow each other at once, streams that wait until FIFOs are full, or nearly.
struct PinPlay {
  std::string instance;    ///< "corner_detection"
  std::string object;      ///< the RTL
  std::uint64_t seed = 0;  ///< of its registers without reset
  pl::Geometry geometry;
  std::vector<vp::ParameterDescription> parameters;  ///< of the platform
  std::vector<std::vector<std::uint8_t>> pictures;   ///< of that geometry
  std::string trace_file;                            ///< what comes around a difference
  std::optional<RecordedPins> recorded = {};         ///< this, and nothing of all that
};

/// Whether there is a bench for the IP.
bool has_bench(const std::string& instance);

/// Plays on the pins of the IP. Its reports go to `err`. Throws vp::ProtocolError for a difference,
/// and for RTL that ends itself; vp::InputError for a recorded pin that the IP does not have.
/// pl::lockstep_use() says what was exercised.
void play_pins(const PinPlay& play, std::ostream& err);

}  // namespace platform::cli
