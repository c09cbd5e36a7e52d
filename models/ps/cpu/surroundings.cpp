#include <ps/cpu/surroundings.h>

#include <vp/text.h>

namespace ps {

std::string Surroundings::name_at(std::uint32_t address) const {
  const Answerer answerer = device(address);
  if (answerer.name.empty()) return {};
  return " (" + answerer.name + (answerer.is_modelled ? ")" : ": not modelled)");
}

std::string Surroundings::plain_text(std::uint32_t address, std::uint32_t value) {
  return vp::hex(address) + ": " + vp::hex(value);
}

}  // namespace ps
