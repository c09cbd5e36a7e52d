#include <ps/cpu/console.h>
#include <utility>

namespace ps {

namespace {

/// Text without line end is passed on when it is that long.
constexpr std::size_t longest_line = 65'536;

}  // namespace

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
  if (line_.size() >= longest_line) pass_line();
}

void Console::flush() {
  if (!line_.empty()) pass_line();
}

void Console::pass_line() {
  if (sink_) sink_(prefix_ + line_);
  line_.clear();
}

}  // namespace ps
