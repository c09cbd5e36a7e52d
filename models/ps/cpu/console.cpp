#include <ps/cpu/console.h>
#include <utility>

namespace ps {

void Console::connect(Sink sink, std::string prefix) {
  sink_ = std::move(sink);
  prefix_ = std::move(prefix);
}

void Console::write(const char* text, std::size_t length) {
  for (std::size_t i = 0; i < length; ++i) {
    if (text[i] == '\n') {
      pass_line();
    } else if (text[i] != '\r') {
      line_ += text[i];
    }
  }
}

void Console::flush() {
  if (!line_.empty()) pass_line();
}

void Console::pass_line() {
  if (sink_) sink_(prefix_ + line_);
  line_.clear();
}

}  // namespace ps
