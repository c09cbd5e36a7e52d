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

DecodedDigits decode_digits(std::string_view digits) {
  DecodedDigits decoded;
  for (const char digit : digits) {
    decoded.bits <<= 1;
    if (digit == '0' || digit == '1') {
      decoded.bits |= digit & 1;
      continue;
    }
    decoded.letters = true;
    const bool capital = digit >= 'A' && digit <= 'Z';
    decoded.capitals = decoded.capitals || capital;
    const char c = static_cast<char>(capital ? digit - 'A' + 'a' : digit);
    if (c == 'h' || c == 'l') {
      decoded.bits |= c == 'h';
      continue;
    }
    decoded.known = false;
    if (std::string_view("xzuw-?").find(c) == std::string_view::npos) decoded.valid = false;
  }
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
