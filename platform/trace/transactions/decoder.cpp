#include <trace/transactions/decoder.h>

#include <vp/text.h>

#include <algorithm>
#include <cstdio>

#include <trace/clock_choice.h>
#include <trace/tools.h>

namespace platform::trace {

namespace {

constexpr std::uint64_t hash_prime = 0x100000001b3;

void hash_digits(std::uint64_t& hash, std::string_view digits) {
  for (const char c : digits) hash = (hash ^ static_cast<unsigned char>(c)) * hash_prime;
  hash = (hash ^ ',') * hash_prime;
}

}  // namespace

void add_word(Transaction& to, std::uint32_t word) {
  std::string digits;
  for (unsigned bit = 32; bit-- > 0;) digits += (word >> bit & 1U) != 0 ? '1' : '0';
  hash_digits(to.data_hash, shortest_digits(digits));
  to.data.push_back(bits_as_hexadecimal(digits));
}

std::string hexadecimal(std::uint64_t value) {
  char text[20];
  std::snprintf(text, sizeof text, "0x%llx", static_cast<unsigned long long>(value));
  return text;
}

void Decoder::follow_reset() {
  if (!surveyed_.bus.reset) return;
  reset_ = replay_.watch(*surveyed_.bus.reset);
  slots_.push_back(*reset_);
}

std::string bits_as_hexadecimal(const std::string& digits) {
  // A single digit is a vector of one, not a wire.
  const unsigned width = std::max(2U, static_cast<unsigned>(digits.size()));
  return "0x" + vp::lower(readable(digits, vp::WaveVariable::Kind::bits, width));
}

Decoder::Decoder(const DecoderContext& context)
    : replay_(context.replay),
      sink_(context.sink),
      options_(context.options),
      place_(context.place),
      surveyed_(context.surveyed) {}

std::optional<Replay::Slot> Decoder::role(const std::string& name) {
  const auto variable = surveyed_.bus.role(name);
  if (!variable) return std::nullopt;
  slots_.push_back(replay_.watch(*variable));
  return slots_.back();
}

void Decoder::add_data(Transaction& to, Replay::Slot slot) const {
  hash_digits(to.data_hash, shortest_digits(digits(slot)));
  if (to.data.size() < options_.data_beats) to.data.push_back(shown(slot));
}

void Decoder::add_data(Transaction& to, std::uint64_t value) const {
  const std::string text = hexadecimal(value);
  hash_digits(to.data_hash, text);
  if (to.data.size() < options_.data_beats) to.data.push_back(text);
}

Transaction Decoder::begun(const char* operation, const SampleEdge& edge) const {
  Transaction one;
  one.interface = place_;
  one.operation = operation;
  one.begin_ps = edge.ps;
  one.begin_cycle = edge.cycle;
  return one;
}

}  // namespace platform::trace
