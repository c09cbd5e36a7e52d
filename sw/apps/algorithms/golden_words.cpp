#include <apps/algorithms/golden_words.h>
#include <marker/packet.h>

namespace algorithms {
namespace {

/// Takes the text apart, word by word and line by line.
class Reader {
 public:
  Reader(const char* begin, const char* end) : at_(begin), end_(end) {}

  bool is_done() const { return at_ == end_; }
  char letter() { return is_done() ? 0 : *at_++; }

  /// A number of the given base after spaces; 0 digits are a mistake.
  std::uint32_t number(unsigned base) {
    while (peek() == ' ') ++at_;
    std::uint32_t value = 0;
    unsigned digits = 0;
    for (unsigned digit; (digit = digit_of(peek())) < base; ++digits, ++at_) {
      value = value * base + digit;
    }
    if (digits == 0) well_formed_ = false;
    return value;
  }

  /// The count of "xN" at the line's end, else 1.
  std::uint32_t repetitions() {
    while (peek() == ' ') ++at_;
    if (peek() != 'x') return 1;
    ++at_;
    return number(10);
  }

  void skip_line() {
    while (!is_done() && *at_ != '\n') ++at_;
    if (!is_done()) ++at_;
  }

  bool is_well_formed() const { return well_formed_; }

 private:
  char peek() const { return is_done() ? '\n' : *at_; }
  static unsigned digit_of(char character) {
    if (character >= '0' && character <= '9') return static_cast<unsigned>(character - '0');
    if (character >= 'a' && character <= 'f') return static_cast<unsigned>(character - 'a' + 10);
    return 16;
  }

  const char* at_;
  const char* end_;
  bool well_formed_ = true;
};

}  // namespace

bool read_golden(const GoldenText& text, marker::WordStore& words, std::uint32_t* binary) {
  Reader reader(text.begin, text.end);
  std::uint32_t count = 0;
  words.clear();
  while (!reader.is_done()) {
    const char kind = reader.letter();
    if (kind == 'C' || kind == 'B' || kind == 'T') reader.number(10);  // the clock
    if (kind == 'C') words.push(reader.number(16));
    if (kind == 'B') {
      words.push(reader.number(16));
      words.push(reader.number(16));
    }
    if (kind == 'T') {
      const std::uint32_t word = reader.number(16);
      for (std::uint32_t left = reader.repetitions(); left > 0; --left) {
        if (count == binary_words) return false;
        binary[count++] = word;
      }
    }
    reader.skip_line();
  }
  words.push(marker_logic::WordFormat::end_of_frame);
  return reader.is_well_formed() && count == binary_words && words.lost() == 0;
}

}  // namespace algorithms
