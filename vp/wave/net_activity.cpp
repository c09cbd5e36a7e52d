#include <vp/net_activity.h>
#include <vp/wave_reader.h>

#include <algorithm>
#include <numeric>

namespace vp {

namespace {

// VHDL's weak levels are levels.
bool is_low(char digit) {
  return digit == '0' || digit == 'l';
}
bool is_high(char digit) {
  return digit == '1' || digit == 'h';
}

}  // namespace

NetActivity::NetActivity(unsigned width) : digits_(width, 'x'), bits_(width), since_(width) {}

void NetActivity::change(std::string_view digits, std::uint64_t now) {
  const std::string full = full_digits(digits, static_cast<unsigned>(digits_.size()));
  for (std::size_t i = 0; i < digits_.size(); ++i) {
    const char digit = full.size() == digits_.size() ? full[i] : 'x';
    if (digit == digits_[i]) continue;
    settle(i, now);
    bits_[i].toggles += (is_low(digits_[i]) && is_high(digit)) ||  //
                        (is_high(digits_[i]) && is_low(digit));
    digits_[i] = digit;
  }
}

void NetActivity::restart(std::uint64_t now) {
  std::fill(bits_.begin(), bits_.end(), Bit{});
  std::fill(since_.begin(), since_.end(), now);
}

void NetActivity::settle(std::uint64_t now) {
  for (std::size_t i = 0; i < bits_.size(); ++i) settle(i, now);
}

void NetActivity::settle(std::size_t bit, std::uint64_t now) {
  const char digit = digits_[bit];
  std::uint64_t& time = is_low(digit)    ? bits_[bit].low
                        : is_high(digit) ? bits_[bit].high
                        : digit == 'z'   ? bits_[bit].floating
                                         : bits_[bit].unknown;
  time += now - since_[bit];
  since_[bit] = now;
}

std::uint64_t NetActivity::toggles() const {
  return std::accumulate(bits_.begin(), bits_.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Bit& bit) { return sum + bit.toggles; });
}

}  // namespace vp
