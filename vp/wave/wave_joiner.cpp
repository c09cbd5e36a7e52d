#include <array>
#include <cstdint>
#include <utility>

#include "wave_declared.h"

namespace vp {

std::string full_digits(std::string_view digits, unsigned width) {
  std::string full(digits);
  if (full.size() >= width || full.empty()) return full;
  const char first = full.front();
  return std::string(width - full.size(), first == '1' ? '0' : first) + full;
}

char state_of_port(char c) {
  if (c == 'D' || c == 'd' || c == 'L' || c == 'l' || c == '0') return '0';
  if (c == 'U' || c == 'u' || c == 'H' || c == 'h' || c == '1') return '1';
  if (c == 'Z' || c == 'T' || c == 'F' || c == 'f') return 'z';
  return std::string_view("NX?AaBbCc").find(c) != std::string_view::npos ? 'x' : '\0';
}

namespace {

/// What a digit means, as flags that add up over a value.
enum DigitFlag : std::uint8_t {
  is_one = 1,
  is_letter = 2,
  is_capital = 4,
  is_unknown = 8,
  is_invalid = 16
};

constexpr std::array<std::uint8_t, 256> make_digit_flags() {
  std::array<std::uint8_t, 256> flags{};
  for (std::uint8_t& flag : flags) flag = is_letter | is_unknown | is_invalid;
  const auto set = [&flags](char c, unsigned flag) {
    flags[static_cast<unsigned char>(c)] = static_cast<std::uint8_t>(flag);
    const bool has_capital = c >= 'a' && c <= 'z';
    if (has_capital)
      flags[static_cast<unsigned char>(c - 'a' + 'A')] =
          static_cast<std::uint8_t>(flag | is_capital);
  };
  set('0', 0);
  set('1', is_one);
  set('l', is_letter);
  set('h', is_letter | is_one);
  for (const char c : std::string_view("xzuw-?")) set(c, is_letter | is_unknown);
  return flags;
}
constexpr auto digit_flags = make_digit_flags();

}  // namespace

DecodedDigits decode_digits(std::string_view digits) {
  DecodedDigits decoded;
  unsigned all = 0;
  for (const char digit : digits) {
    const unsigned flags = digit_flags[static_cast<unsigned char>(digit)];
    decoded.bits = decoded.bits << 1 | (flags & is_one);
    all |= flags;
  }
  decoded.plain = (all & is_letter) == 0;
  decoded.capitals = (all & is_capital) != 0;
  decoded.known = (all & is_unknown) == 0;
  decoded.valid = (all & is_invalid) == 0;
  if (!decoded.known) decoded.bits = 0;
  return decoded;
}

WaveJoiner::WaveJoiner(std::vector<std::vector<WavePart>> joined, std::uint32_t nets)
    : nets_(nets) {
  for (auto& parts : joined) {
    unsigned at = 0;
    for (const WavePart& part : parts) {
      uses_[part.net].push_back({static_cast<std::uint32_t>(joined_.size()), at, part.width});
      at += part.width;
    }
    joined_.push_back({std::move(parts), std::string(at, 'x'), false});
  }
}

unsigned WaveJoiner::width(std::uint32_t net) const {
  return static_cast<unsigned>(joined_[net - nets_].digits.size());
}

void WaveJoiner::begin(WaveHandler& next, const std::vector<bool>& selected) {
  next_ = &next;
  selected_ = &selected;
}

bool WaveJoiner::at(std::uint64_t ps) {
  flush();
  return next_->at(ps);
}

void WaveJoiner::change(std::uint32_t net, const WaveValue& value) {
  if ((*selected_)[net]) next_->change(net, value);
  const auto uses = uses_.find(net);
  if (uses == uses_.end() || value.kind != WaveVariable::Kind::bits) return;
  for (const Use& use : uses->second) {
    Joined& joined = joined_[use.joined];
    const std::string digits = full_digits(value.text, use.width);
    joined.digits.replace(use.at, use.width, digits, digits.size() - use.width);
    if (!(*selected_)[nets_ + use.joined] || joined.is_due) continue;
    joined.is_due = true;
    due_.push_back(use.joined);
  }
}

void WaveJoiner::recorded(bool is_recorded) {
  next_->recorded(is_recorded);
}

void WaveJoiner::flush() {
  for (const std::uint32_t place : due_) {
    Joined& joined = joined_[place];
    joined.is_due = false;
    const DecodedDigits decoded = decode_digits(joined.digits);
    WaveValue value;
    value.known = decoded.known;
    value.plain = decoded.plain;
    value.bits = decoded.bits;
    value.text = joined.digits;
    next_->change(nets_ + place, value);
  }
  due_.clear();
}

void WaveJoiner::forget() {
  due_.clear();
  for (Joined& joined : joined_) {
    joined.is_due = false;
    joined.digits.assign(joined.digits.size(), 'x');
  }
}

}  // namespace vp
