#include <apps/common/message.h>
#include <hal/hal.h>

namespace apps {

void Message::put(char character) {
  if (length_ < capacity) line_[length_++] = character;
}

Message& Message::text(const char* text) {
  while (*text != 0) put(*text++);
  return *this;
}

Message& Message::number(std::uint32_t value) {
  std::array<char, 10> digits{};
  unsigned count = 0;
  do {
    digits[count++] = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value != 0);
  while (count > 0) put(digits[--count]);
  return *this;
}

Message& Message::hexadecimal(std::uint32_t value) {
  text("0x");
  for (int shift = 28; shift >= 0; shift -= 4) put("0123456789abcdef"[(value >> shift) & 0xF]);
  return *this;
}

void Message::write() {
  line_[length_] = '\n';
  hal_console_write(line_.data(), length_ + 1);
  length_ = 0;
}

}  // namespace apps
