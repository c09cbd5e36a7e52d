#include <trace/transactions/axi_burst.h>

#include <trace/transactions/decoder.h>

namespace platform::trace {

namespace {

constexpr std::uint64_t boundary = 4096;        ///< bytes that no INCR burst crosses
constexpr std::uint64_t most_fixed_beats = 16;  ///< also of exclusive accesses
constexpr std::uint64_t most_exclusive_bytes = 128;

std::string beats_text(std::uint64_t beats) {
  return std::to_string(beats) + (beats == 1 ? " beat" : " beats");
}

bool is_power_of_two(std::uint64_t value) {
  return value != 0 && (value & (value - 1)) == 0;
}

}  // namespace

std::pair<std::uint64_t, std::uint64_t> AxiBurst::lanes(std::uint64_t beat) const {
  std::uint64_t first = address;
  const std::uint64_t aligned = address / size * size;
  if (beat != 0 && type != Type::fixed) first = aligned + beat * size;
  if (beat != 0 && type == Type::wrap) {
    const std::uint64_t container = size * beats;
    const std::uint64_t base = address / container * container;
    first = base + (aligned - base + beat * size) % container;
  }
  const std::uint64_t from = first % bus_bytes;
  const std::uint64_t behind = from / size * size + size;
  return {from, behind < bus_bytes ? behind : bus_bytes};
}

const char* axi_burst_name(AxiBurst::Type type) {
  switch (type) {
    case AxiBurst::Type::fixed:
      return "FIXED";
    case AxiBurst::Type::incr:
      return "INCR";
    case AxiBurst::Type::wrap:
      return "WRAP";
    case AxiBurst::Type::reserved:
      break;
  }
  return "reserved";
}

std::vector<AxiRequestFault> axi_request_faults(const AxiBurst& burst) {
  using Type = AxiBurst::Type;
  std::vector<AxiRequestFault> faults;
  const auto add = [&](const char* rule, const std::string& detail) {
    faults.push_back({rule, detail});
  };
  const std::uint64_t aligned = burst.address / burst.size * burst.size;
  if (burst.type == Type::incr &&
      aligned / boundary != (aligned + burst.beats * burst.size - 1) / boundary) {
    add("ADDR_BOUNDARY", beats_text(burst.beats) + " of " + std::to_string(burst.size) +
                             " bytes from " + hexadecimal(burst.address) + " cross 4 KiB");
  }
  if (burst.type == Type::wrap) {
    if (burst.address % burst.size != 0)
      add("ADDR_WRAP_ALIGN", "WRAP from " + hexadecimal(burst.address) + " with beats of " +
                                 std::to_string(burst.size) + " bytes");
    if (!is_power_of_two(burst.beats) || burst.beats < 2 || burst.beats > most_fixed_beats)
      add("LEN_WRAP", "WRAP of " + beats_text(burst.beats));
  }
  if (burst.type == Type::fixed && burst.beats > most_fixed_beats)
    add("LEN_FIXED", "FIXED of " + beats_text(burst.beats));
  if (burst.type == Type::reserved) add("BURST", "burst type 3");
  if (burst.size > burst.bus_bytes) {
    add("SIZE", "beats of " + std::to_string(burst.size) + " bytes on a bus of " +
                    std::to_string(burst.bus_bytes));
  }
  constexpr std::uint64_t modifiable = 2, allocate = 0xc;
  if (burst.cache && (*burst.cache & modifiable) == 0 && (*burst.cache & allocate) != 0)
    add("CACHE", "not modifiable, with allocate bits: " + hexadecimal(*burst.cache));
  const std::uint64_t bytes = burst.beats * burst.size;
  if (burst.exclusive && (burst.beats > most_fixed_beats || !is_power_of_two(bytes) ||
                          bytes > most_exclusive_bytes || burst.address % bytes != 0)) {
    add("LEN_LOCK", "exclusive access of " + beats_text(burst.beats) + ", " +
                        std::to_string(bytes) + " bytes from " + hexadecimal(burst.address));
  }
  return faults;
}

AxiStrobe axi_strobe(std::string_view digits, std::pair<std::uint64_t, std::uint64_t> lanes) {
  AxiStrobe strobe;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const char digit = digits[digits.size() - 1 - i];
    if (digit != '1' && digit != 'h') continue;
    ++strobe.bytes;
    strobe.inside = strobe.inside && i >= lanes.first && i < lanes.second;
  }
  return strobe;
}

}  // namespace platform::trace
