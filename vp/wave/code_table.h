#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vp {

/// Numbers of identifiers that are too long to count with: some 25 bytes each, as there may be
/// millions of them.
class CodeTable {
 public:
  /// The number of the identifier; 0 if it has none.
  std::uint32_t find(std::string_view code) const {
    return places_.empty() ? 0 : number(places_[slot_of(code)]);
  }
  /// The same, to set it. Valid until the next call.
  std::uint32_t& operator[](std::string_view code) {
    constexpr std::size_t smallest = 64;
    if (places_.size() < 2 * (numbers_.size() + 1)) grow(std::max(smallest, 2 * places_.size()));
    std::uint32_t& place = places_[slot_of(code)];
    if (place == 0) {
      codes_ += code;
      ends_.push_back(codes_.size());
      numbers_.push_back(0);
      place = static_cast<std::uint32_t>(numbers_.size());
    }
    return numbers_[place - 1];
  }
  /// An identifier begins with this one, and is longer.
  bool has_longer(std::string_view code) const {
    for (std::uint32_t place = 1; place <= numbers_.size(); ++place) {
      const std::string_view other = code_at(place);
      if (other.size() > code.size() && other.substr(0, code.size()) == code) return true;
    }
    return false;
  }

 private:
  std::uint32_t number(std::uint32_t place) const { return place == 0 ? 0 : numbers_[place - 1]; }
  std::string_view code_at(std::uint32_t place) const {
    const std::size_t begin = place == 1 ? 0 : ends_[place - 2];
    return std::string_view(codes_).substr(begin, ends_[place - 1] - begin);
  }
  std::size_t slot_of(std::string_view code) const {
    const std::size_t mask = places_.size() - 1;
    for (std::size_t i = std::hash<std::string_view>{}(code)&mask;; i = (i + 1) & mask) {
      if (places_[i] == 0 || code_at(places_[i]) == code) return i;
    }
  }
  void grow(std::size_t size) {
    places_.assign(size, 0);
    for (std::uint32_t place = 1; place <= numbers_.size(); ++place)
      places_[slot_of(code_at(place))] = place;
  }

  std::string codes_;                   ///< one behind the other
  std::vector<std::size_t> ends_;       ///< in `codes_`, by place
  std::vector<std::uint32_t> numbers_;  ///< by place
  std::vector<std::uint32_t> places_;   ///< + 1, by hash; twice as many as there are identifiers
};

}  // namespace vp
