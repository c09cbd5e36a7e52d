#include <vp/user_text.h>

namespace vp {

std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 200;
  if (text.size() <= longest) return std::string(text);
  const auto continues_character = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80;  // UTF-8
  };
  std::size_t end = longest;
  while (end > 0 && continues_character(end)) --end;
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace vp
