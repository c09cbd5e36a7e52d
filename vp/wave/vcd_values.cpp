#include <charconv>
#include <cmath>
#include <limits>

#include "vcd_reader.h"

// The values of a VCD that are no plain bits.

namespace vp {

/// What is in $dumpoff: nothing is known.
void VcdReader::hand_over_unknowns(WaveHandler& handler) {
  for (std::uint32_t i = 0; i < nets_.size(); ++i) {
    const Net& net = nets_[i];
    if (!net.selected || net.is_event) continue;
    WaveValue value;
    value.kind = net.kind;
    value.real = std::numeric_limits<double>::quiet_NaN();
    value.known = net.kind == WaveVariable::Kind::text;
    value.text = net.kind == WaveVariable::Kind::bits   ? "x"
                 : net.kind == WaveVariable::Kind::real ? "nan"
                                                        : "";
    handler.change(i, value);
  }
}

/// Digits that are no plain number: letters, too many, a prefix; or of a signal of another type.
void VcdReader::read_bits(std::string_view digits, std::uint32_t net, WaveHandler& handler) {
  const Net& form = nets_[net];
  if (digits.substr(0, 2) == "0b") digits.remove_prefix(2);
  DecodedDigits decoded = decode_digits(digits);
  if (digits.empty()) fail("a value of 0 digits");
  if (!decoded.valid) fail(shown(digits) + " is no binary number");
  if (decoded.capitals) {
    digits_ = digits;
    for (char& c : digits_) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    digits = digits_;
  }
  WaveValue value;
  value.known = decoded.known;
  value.plain = decoded.plain;
  value.bits = decoded.bits;
  value.text = digits;
  if (form.kind == WaveVariable::Kind::text) {
    note("a text has a number as its value");
    value.kind = form.kind;
    value.known = true;
  } else if (form.kind == WaveVariable::Kind::real) {
    note("a real signal has bits as its value: they are taken as a whole number");
    value.kind = form.kind;
    value.real = value.known ? static_cast<double>(value.bits) : std::nan("");
    text_.resize(32);
    const auto end = std::to_chars(text_.data(), text_.data() + text_.size(), value.real).ptr;
    value.text = std::string_view(text_.data(), static_cast<std::size_t>(end - text_.data()));
  } else if (digits.size() > form.width) {
    shorten(digits, form.width);
    decoded = decode_digits(digits);
    value.known = decoded.known;
    value.plain = decoded.plain;
    value.bits = decoded.bits;
    value.text = digits;
  } else if (digits.size() < form.width &&
             std::string_view("01xz").find(digits.front()) == std::string_view::npos) {
    note(
        "values begin with a letter that the standard does not extend to the left: it is "
        "repeated");
  }
  handler.change(net, value);
}

/// Leaves out the digits on the left that say nothing.
void VcdReader::shorten(std::string_view& digits, unsigned width) {
  const std::string_view lost = digits.substr(0, digits.size() - width);
  const std::string_view left = digits.substr(lost.size());
  const char restored = left.front() == '1' ? '0' : left.front();
  if (lost.find_first_not_of(restored) != std::string_view::npos) {
    fail("a value of " + std::to_string(digits.size()) + " digits for a signal of " +
         std::to_string(width) + " bits");
  }
  note(
      "values have more digits than their signal: those on the left, which say nothing, are left "
      "out");
  digits = left;
}

void VcdReader::read_real(std::string_view digits, std::uint32_t net, WaveHandler& handler) {
  WaveValue value;
  value.kind = WaveVariable::Kind::real;
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  value.text = digits;
  const char* const end = digits.data() + digits.size();
  const auto parsed = std::from_chars(digits.data(), end, value.real);
  if (parsed.ec == std::errc::invalid_argument || parsed.ptr != end)
    fail(shown(digits) + " is no number");
  value.known = std::isfinite(value.real);
  if (nets_[net].kind != WaveVariable::Kind::real) {
    note("a signal of bits or text has a real number as its value");
    if (nets_[net].kind == WaveVariable::Kind::text) {
      value.kind = WaveVariable::Kind::text;
      value.known = true;
    }
  }
  handler.change(net, value);
}

void VcdReader::read_text(std::string_view text, std::uint32_t net, WaveHandler& handler) {
  if (nets_[net].kind != WaveVariable::Kind::text)
    note("a signal of bits or numbers has words as values: it is a text from there on");
  unescape(text, text_);
  if (!is_utf8(text_)) text_ = in_utf8(text_);
  WaveValue value;
  value.kind = WaveVariable::Kind::text;
  value.known = true;
  value.text = text_;
  handler.change(net, value);
}

void VcdReader::read_port(std::string_view states, std::uint32_t net, WaveHandler& handler) {
  std::string digits;
  for (const char c : states) {
    digits += state_of_port(c);
    if (digits.back() == '\0') fail(shown(states) + " are no states of a port");
  }
  read_bits(digits, net, handler);
}

}  // namespace vp
