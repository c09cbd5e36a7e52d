#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace apps {

/// One line for the console, put together without the standard library's formatting. Cut at 128
/// characters.
class Message {
 public:
  Message& text(const char* text);
  Message& number(std::uint32_t value);
  Message& hexadecimal(std::uint32_t value);  ///< 0x and 8 digits

  /// Writes the line and its end.
  void write();

 private:
  void put(char character);

  static constexpr std::size_t capacity = 128;
  std::array<char, capacity + 1> line_{};
  std::size_t length_ = 0;
};

}  // namespace apps
