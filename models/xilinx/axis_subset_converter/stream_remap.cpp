#include <xilinx/axis_subset_converter/stream_remap.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include <vp/error.h>
#include <vp/text.h>

namespace xilinx {

namespace {

constexpr unsigned most_bits = 4096;

using From = RemapBit::From;

/// Reads an expression term by term.
class RemapParser {
 public:
  RemapParser(std::string text, std::string of) : text_(std::move(text)), of_(std::move(of)) {}

  std::vector<RemapBit> parse() {
    std::vector<RemapBit> upper_first;
    for (const std::string& term : vp::split(text_, ',')) {
      const std::vector<RemapBit> bits = term_of(term);
      upper_first.insert(upper_first.end(), bits.begin(), bits.end());
    }
    std::reverse(upper_first.begin(), upper_first.end());
    return upper_first;
  }

 private:
  [[noreturn]] void refuse(const std::string& term) const {
    throw vp::InputError(of_ + ": '" + vp::excerpt(term) +
                         "' is neither bits of a signal, as tdata[7:0], nor a constant, as 8'h00");
  }

  unsigned number(const std::string& digits, const std::string& term, unsigned base = 10) const {
    unsigned value = 0;
    if (digits.empty() || digits.size() > 8) refuse(term);
    for (const char c : digits) {
      const int digit = std::isdigit(static_cast<unsigned char>(c)) != 0 ? c - '0'
                        : c >= 'a' && c <= 'f'                           ? c - 'a' + 10
                                                                         : 99;
      if (digit >= static_cast<int>(base)) refuse(term);
      value = value * base + static_cast<unsigned>(digit);
    }
    return value;
  }

  std::vector<RemapBit> term_of(const std::string& term) const {
    if (term.find('\'') != std::string::npos) return constant(term);
    const std::size_t bracket = term.find('[');
    const From from = signal(term.substr(0, bracket), term);
    if (bracket == std::string::npos) return {{from, 0}};
    if (term.back() != ']') refuse(term);
    const std::string range = term.substr(bracket + 1, term.size() - bracket - 2);
    const std::size_t colon = range.find(':');
    const unsigned high = number(range.substr(0, colon), term);
    const unsigned low = colon == std::string::npos ? high : number(range.substr(colon + 1), term);
    if (high < low || high >= most_bits) refuse(term);
    std::vector<RemapBit> bits;
    for (unsigned bit = high + 1; bit-- > low;) bits.push_back({from, bit});
    return bits;
  }

  From signal(const std::string& name, const std::string& term) const {
    static const std::pair<const char*, From> names[] = {
        {"tdata", From::data},   {"tuser", From::user}, {"tkeep", From::keep},
        {"tstrb", From::strobe}, {"tlast", From::last}, {"tid", From::id},
        {"tdest", From::dest}};
    for (const auto& [known, from] : names)
      if (name == known) return from;
    refuse(term);
  }

  /// Digits of at most 32 bits, however wide the constant.
  std::vector<RemapBit> constant(const std::string& term) const {
    const std::size_t tick = term.find('\'');
    const unsigned width = number(term.substr(0, tick), term);
    if (width == 0 || width > most_bits || tick + 1 >= term.size()) refuse(term);
    const char base = term[tick + 1];
    const std::string digits = term.substr(tick + 2);
    std::vector<RemapBit> bits;
    if (base == 'b') {
      for (const char c : digits) {
        if (c != '0' && c != '1') refuse(term);
        bits.push_back({c == '1' ? From::one : From::zero, 0});
      }
      if (bits.empty() || bits.size() > width) refuse(term);
      bits.insert(bits.begin(), width - bits.size(), RemapBit{});
      return bits;
    }
    if (base != 'h' && base != 'd') refuse(term);
    const std::uint64_t value = number(digits, term, base == 'h' ? 16 : 10);
    for (unsigned bit = width; bit-- > 0;)
      bits.push_back({bit < 64 && (value >> bit & 1) != 0 ? From::one : From::zero, 0});
    return bits;
  }

  const std::string text_, of_;
};

}  // namespace

std::vector<RemapBit> parse_remap(const std::string& expression, const std::string& of) {
  std::string text;
  for (const char c : expression) {
    const bool is_noise = c == ' ' || c == '{' || c == '}' || c == '"' || c == '_';
    if (!is_noise) text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return RemapParser(text, of).parse();
}

}  // namespace xilinx
