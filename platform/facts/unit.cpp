#include <facts/unit.h>

namespace platform::facts {

const std::vector<std::uint8_t>& UnitInput::bytes() const {
  static const std::vector<std::uint8_t> nothing;
  return nothing;
}

std::string Work::counted(std::uint64_t count) const {
  const bool delivers = !unit.empty();
  const std::string one = delivers ? unit : "run";
  return std::to_string(count) + " " + (count == 1 ? one : delivers ? many() : "runs");
}

}  // namespace platform::facts
