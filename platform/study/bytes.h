#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <study/point.h>

/// Numbers, texts and outcomes as bytes: for the pipes between a sweep's processes, and for its
/// logs.
namespace platform::study {

template <class Number>
void put(std::string& bytes, Number value) {
  static_assert(std::is_arithmetic_v<Number>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline void put_text(std::string& bytes, std::string_view text) {
  put(bytes, std::uint64_t{text.size()});
  bytes += text;
}

/// Takes values off the front of bytes. Throws std::out_of_range where they are too few.
class Taker {
 public:
  explicit Taker(std::string_view bytes) : rest_(bytes) {}

  template <class Number>
  Number take() {
    Number value{};
    std::memcpy(&value, take_bytes(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view take_bytes(std::uint64_t count) {
    if (count > rest_.size()) throw std::out_of_range("bytes of a sweep are not whole");
    const std::string_view bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return bytes;
  }
  std::string take_text() { return std::string(take_bytes(take<std::uint64_t>())); }

 private:
  std::string_view rest_;
};

/// All of an outcome but its metrics.
inline void put_facts(std::string& bytes, const Outcome& outcome) {
  put(bytes, outcome.failed);
  put(bytes, outcome.failure.exit_code);
  put(bytes, outcome.failure.signal);
  put_text(bytes, outcome.failure.message);
  put(bytes, std::uint64_t{outcome.complaints.size()});
  for (const auto& [part, why] : outcome.complaints) {
    put_text(bytes, part);
    put_text(bytes, why);
  }
}

inline void take_facts(Taker& taker, Outcome& outcome) {
  outcome.failed = taker.take<bool>();
  outcome.failure.exit_code = taker.take<int>();
  outcome.failure.signal = taker.take<int>();
  outcome.failure.message = taker.take_text();
  for (auto left = taker.take<std::uint64_t>(); left != 0; --left) {
    std::string part = taker.take_text();
    outcome.complaints.emplace_back(std::move(part), taker.take_text());
  }
}

}  // namespace platform::study
