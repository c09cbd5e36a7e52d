#include "text.h"

#include <hal/hal.h>

#include <cstring>

namespace chip {

void print(const char* text) {
  hal_console_write(text, std::strlen(text));
}

void print_number(std::uint32_t value) {
  char digits[10];
  unsigned first = sizeof digits;
  do {
    digits[--first] = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value != 0);
  hal_console_write(digits + first, sizeof digits - first);
}

void print_hexadecimal(std::uint32_t value) {
  char digits[10] = {'0', 'x'};
  for (unsigned i = 0; i < 8; ++i)
    digits[2 + i] = "0123456789abcdef"[(value >> (28 - 4 * i)) & 0xF];
  hal_console_write(digits, sizeof digits);
}

}  // namespace chip
