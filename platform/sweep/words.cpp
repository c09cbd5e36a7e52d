#include <sweep/words.h>

namespace platform::sweep {

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const std::size_t start = text.rfind('\n', end);
  std::string line = text.substr(start == std::string::npos ? 0 : start + 1,
                                 end - (start == std::string::npos ? 0 : start + 1) + 1);
  const std::string name = "markervp: ";
  return line.rfind(name, 0) == 0 ? line.substr(name.size()) : line;
}

}  // namespace platform::sweep
