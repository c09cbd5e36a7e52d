#include <chip/block_design/memory_file.h>

#include <cctype>
#include <cstdlib>
#include <optional>

#include <vp/error.h>
#include <vp/text.h>

namespace platform::block_design {

namespace {

[[noreturn]] void refuse_line(const std::string& file, std::size_t line,
                              const std::string& problem) {
  throw vp::InputError(file + ":" + std::to_string(line) + ": " + problem);
}

std::optional<unsigned> digit_of(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  const int letter = std::tolower(static_cast<unsigned char>(c));
  constexpr unsigned ten = 10;
  if (letter >= 'a' && letter <= 'f') return static_cast<unsigned>(letter - 'a') + ten;
  return std::nullopt;
}

/// Reads word after word, and counts lines.
class MemoryReader {
 public:
  MemoryReader(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  std::vector<std::uint64_t> words() {
    unsigned radix = 0;
    while (true) {
      const std::string key = vp::lower(token());
      if (key.empty()) fail("it has no memory_initialization_vector");
      if (token() != "=") fail("'" + vp::excerpt(key) + "' must be followed by '='");
      if (key == "memory_initialization_vector") break;
      const std::string value = token();
      if (key == "memory_initialization_radix") radix = radix_of(value);
      if (token() != ";") fail("the value of " + vp::excerpt(key) + " must end with ';'");
    }
    if (radix == 0) fail("memory_initialization_radix must come before the vector");
    std::vector<std::uint64_t> list;
    for (std::string word = token(); !word.empty() && word != ";"; word = token()) {
      if (word != ",") list.push_back(number(word, radix));
    }
    return list;
  }

 private:
  unsigned radix_of(const std::string& text) {
    for (const unsigned radix : {2u, 10u, 16u})
      if (text == std::to_string(radix)) return radix;
    fail("memory_initialization_radix must be 2, 10 or 16, and is '" + vp::excerpt(text) + "'");
  }

  std::uint64_t number(const std::string& word, unsigned radix) {
    std::uint64_t value = 0;
    for (const char c : word) {
      const auto digit = digit_of(c);
      if (!digit || *digit >= radix)
        fail("'" + vp::excerpt(word) + "' is not a number to the base " + std::to_string(radix));
      if (value > (UINT64_MAX - *digit) / radix)
        fail("'" + vp::excerpt(word) + "' has more than 64 bits");
      value = value * radix + *digit;
    }
    return value;
  }

  bool is_space() const { return std::isspace(static_cast<unsigned char>(text_[at_])) != 0; }

  /// A line that begins with ';' is a comment.
  void skip() {
    while (at_ < text_.size()) {
      const bool begins = at_ == 0 || text_[at_ - 1] == '\n';
      if (begins && text_[at_] == ';') {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else if (is_space()) {
        line_ += text_[at_] == '\n' ? 1 : 0;
        ++at_;
      } else {
        return;
      }
    }
  }

  static bool is_mark(char c) { return c == ';' || c == ',' || c == '='; }

  std::string token() {
    skip();
    if (at_ >= text_.size()) return {};
    if (is_mark(text_[at_])) return std::string(1, text_[at_++]);
    const std::size_t start = at_;
    while (at_ < text_.size() && !is_space() && !is_mark(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }

  [[noreturn]] void fail(const std::string& problem) const { refuse_line(file_, line_, problem); }

  const std::string& text_;
  const std::string& file_;
  std::size_t at_ = 0, line_ = 1;
};

}  // namespace

std::vector<std::uint64_t> read_memory_file(const std::string& text, const std::string& file) {
  return MemoryReader(text, file).words();
}

std::uint64_t hex_number(const std::string& text) {
  constexpr int base = 16;
  return std::strtoull(text.c_str(), nullptr, base);
}

}  // namespace platform::block_design
