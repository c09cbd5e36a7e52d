#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace platform::trace {

/// The request of a burst, as its address channel gives it.
struct AxiBurst {
  enum class Type : std::uint8_t { fixed, incr, wrap, reserved };
  std::uint64_t address = 0;
  std::uint64_t beats = 1;
  std::uint64_t size = 4;       ///< bytes a beat
  std::uint64_t bus_bytes = 4;  ///< of the data channel
  Type type = Type::incr;
  bool exclusive = false;
  std::optional<std::uint64_t> cache;

  /// The byte lanes of a beat, first and behind the last.
  std::pair<std::uint64_t, std::uint64_t> lanes(std::uint64_t beat) const;
};

/// "INCR".
const char* axi_burst_name(AxiBurst::Type type);

/// A rule that a request breaks: the part of its name behind "AXI4_ERRM_AW", and what is wrong.
struct AxiRequestFault {
  std::string rule, detail;
};

/// All rules of requests: 4 KiB boundary, wrap, lengths, size, cache, exclusive accesses.
std::vector<AxiRequestFault> axi_request_faults(const AxiBurst& burst);

/// Bytes that a strobe enables, and whether all of them are among `lanes`. `digits`: the first is
/// the highest lane's.
struct AxiStrobe {
  std::uint64_t bytes = 0;
  bool inside = true;
};
AxiStrobe axi_strobe(std::string_view digits, std::pair<std::uint64_t, std::uint64_t> lanes);

}  // namespace platform::trace
