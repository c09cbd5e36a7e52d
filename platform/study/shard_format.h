#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <study/outcome.h>
#include <study/point.h>

/// A shard of a sweep's results as bytes: a line
///
///   markervp_shard VERSION ENGINE HOST PROGRAM
///
/// and records, each {size, check, kind, …}. A record of a point refers to others before it in its
/// shard: its origin, to which it has the changes, and the first figures of these names, of which
/// it has the values that differ.
namespace platform::study::shard {

constexpr const char* mark = "markervp_shard";
constexpr int version = 1;
constexpr const char* ending = ".shard";

struct Head {
  std::uint32_t size;
  std::uint32_t check;
};

enum class Kind : std::uint8_t { figures = 1, origin = 2, point = 3 };

/// No record is larger: names of all metrics, or a program's last words.
constexpr std::uint32_t most_bytes = 64 << 20;

/// FNV-1a: a record that a crash cut, or a disk lost, does not fit it.
inline std::uint32_t check_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : bytes)
    hash = (hash ^ static_cast<unsigned char>(byte)) * std::uint64_t{0x100000001b3};
  return static_cast<std::uint32_t>(hash ^ (hash >> 32));
}

template <class Number>
void put(std::string& bytes, Number value) {
  static_assert(std::is_arithmetic_v<Number> || std::is_enum_v<Number>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline void put_text(std::string& bytes, std::string_view text) {
  put(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

/// Pairs of texts: settings, changes, complaints.
template <class Pairs>
void put_pairs(std::string& bytes, const Pairs& pairs) {
  put(bytes, static_cast<std::uint32_t>(pairs.size()));
  for (const auto& [name, value] : pairs) {
    put_text(bytes, static_cast<const std::string&>(name));
    put_text(bytes, static_cast<const std::string&>(value));
  }
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
  std::string_view take_bytes(std::size_t count) {
    if (count > rest_.size()) throw std::out_of_range("a record of a shard is not whole");
    const std::string_view bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return bytes;
  }
  std::string_view take_text() { return take_bytes(take<std::uint32_t>()); }
  /// Of things that take at least a byte each.
  std::uint32_t take_count() {
    const auto count = take<std::uint32_t>();
    if (count > rest_.size()) throw std::out_of_range("a record of a shard is not whole");
    return count;
  }
  std::vector<std::pair<std::string, std::string>> take_pairs() {
    std::vector<std::pair<std::string, std::string>> pairs;
    for (std::uint32_t left = take_count(); left != 0; --left) {
      std::string name(take_text());
      pairs.emplace_back(std::move(name), take_text());
    }
    return pairs;
  }

 private:
  std::string_view rest_;
};

/// An outcome, but for its figures, failed and date.
inline void put_outcome(std::string& bytes, const Outcome& outcome) {
  put(bytes, outcome.attempt);
  put(bytes, outcome.wall_s);
  put(bytes, outcome.cpu_s);
  put(bytes, outcome.failure.exit_code);
  put(bytes, outcome.failure.signal);
  put_text(bytes, outcome.failure.message);
  put_pairs(bytes, outcome.complaints);
}

inline void take_outcome(Taker& taker, Outcome& outcome) {
  outcome.attempt = taker.take<std::int32_t>();
  outcome.wall_s = taker.take<double>();
  outcome.cpu_s = taker.take<double>();
  outcome.failure.exit_code = taker.take<int>();
  outcome.failure.signal = taker.take<int>();
  outcome.failure.message = taker.take_text();
  outcome.complaints = taker.take_pairs();
}

inline void put_setup(std::string& bytes, const Setup& setup) {
  put_text(bytes, setup.program);
  put(bytes, static_cast<std::uint32_t>(setup.inputs.size()));
  for (const std::string& input : setup.inputs) put_text(bytes, input);
  put_pairs(bytes, setup.input.settings);
  put(bytes, setup.input.frames.has_value());
  put(bytes, setup.input.frames.value_or(0));
  put(bytes, setup.input.repeat);
  put_pairs(bytes, setup.settings);
}

inline Setup take_setup(Taker& taker) {
  Setup setup;
  setup.program = taker.take_text();
  for (std::uint32_t left = taker.take_count(); left != 0; --left)
    setup.inputs.emplace_back(taker.take_text());
  for (auto& setting : taker.take_pairs()) setup.input.settings.insert(std::move(setting));
  const bool limited = taker.take<bool>();
  const auto frames = taker.take<std::uint64_t>();
  if (limited) setup.input.frames = frames;
  setup.input.repeat = taker.take<std::uint64_t>();
  for (auto& setting : taker.take_pairs()) setup.settings.insert(std::move(setting));
  return setup;
}

}  // namespace platform::study::shard
