// xil_printf.h.
#include <hal/hal.h>
#include <xil_printf.h>

#include <cstdarg>
#include <cstdint>
#include <cstring>

namespace {

/// Collects what is printed, so that the console sees lines instead of characters.
class Output {
 public:
  ~Output() { flush(); }
  void put(char character) {
    if (used_ == sizeof buffer_) flush();
    buffer_[used_++] = character;
  }

 private:
  void flush() {
    if (used_ > 0) hal_console_write(buffer_, used_);
    used_ = 0;
  }

  char buffer_[128];
  std::size_t used_ = 0;
};

struct Field {
  bool left = false;
  bool zeros = false;
  bool is_long = false;
  std::size_t width = 0;
};

void put_padded(Output& out, const Field& field, const char* sign, const char* text,
                std::size_t length) {
  const std::size_t total = std::strlen(sign) + length;
  const std::size_t padding = field.width > total ? field.width - total : 0;
  const bool zeros = field.zeros && !field.left;
  if (!field.left && !zeros) {
    for (std::size_t i = 0; i < padding; ++i) out.put(' ');
  }
  while (*sign != 0) out.put(*sign++);
  if (zeros) {
    for (std::size_t i = 0; i < padding; ++i) out.put('0');
  }
  for (std::size_t i = 0; i < length; ++i) out.put(text[i]);
  if (field.left) {
    for (std::size_t i = 0; i < padding; ++i) out.put(' ');
  }
}

void put_number(Output& out, const Field& field, unsigned long value, unsigned base,
                const char* digits, const char* sign) {
  char text[24];
  std::size_t first = sizeof text;
  do {
    text[--first] = digits[value % base];
    value /= base;
  } while (value != 0);
  put_padded(out, field, sign, text + first, sizeof text - first);
}

const char* parse_field(const char* format, Field& field) {
  for (;; ++format) {
    if (*format == '-') {
      field.left = true;
    } else if (*format == '0') {
      field.zeros = true;
    } else {
      break;
    }
  }
  for (; *format >= '0' && *format <= '9'; ++format) {
    field.width = field.width * 10 + static_cast<std::size_t>(*format - '0');
  }
  if (*format == 'l') {
    field.is_long = true;
    ++format;
  }
  return format;
}

}  // namespace

extern "C" {

void xil_vprintf(const char8* ctrl1, va_list arguments) {
  constexpr const char* lower = "0123456789abcdef";
  constexpr const char* upper = "0123456789ABCDEF";
  Output out;
  for (const char* format = ctrl1; *format != 0; ++format) {
    if (*format != '%') {
      out.put(*format);
      continue;
    }
    Field field;
    format = parse_field(format + 1, field);
    const auto word = [&]() -> unsigned long {
      return field.is_long ? va_arg(arguments, unsigned long) : va_arg(arguments, unsigned);
    };
    switch (*format) {
      case 'd':
      case 'i': {
        const long value = field.is_long ? va_arg(arguments, long) : va_arg(arguments, int);
        const unsigned long magnitude =
            value < 0 ? 0UL - static_cast<unsigned long>(value) : static_cast<unsigned long>(value);
        put_number(out, field, magnitude, 10, lower, value < 0 ? "-" : "");
        break;
      }
      case 'u':
        put_number(out, field, word(), 10, lower, "");
        break;
      case 'x':
        put_number(out, field, word(), 16, lower, "");
        break;
      case 'X':
        put_number(out, field, word(), 16, upper, "");
        break;
      case 'p':
        put_number(out, field, reinterpret_cast<std::uintptr_t>(va_arg(arguments, void*)), 16,
                   lower, "");
        break;
      case 'c':
        out.put(static_cast<char>(va_arg(arguments, int)));
        break;
      case 's': {
        const char* text = va_arg(arguments, const char*);
        put_padded(out, field, "", text, std::strlen(text));
        break;
      }
      case 0:
        --format;  // a lonely % at the end
        break;
      default:
        out.put(*format);
    }
  }
}

void xil_printf(const char8* ctrl1, ...) {
  va_list arguments;
  va_start(arguments, ctrl1);
  xil_vprintf(ctrl1, arguments);
  va_end(arguments);
}

void print(const char8* ptr) {
  hal_console_write(ptr, std::strlen(ptr));
}

void outbyte(char c) {
  hal_console_write(&c, 1);
}

}  // extern "C"
