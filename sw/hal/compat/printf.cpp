// xil_printf.h.
#include <hal/hal.h>
#include <xil_printf.h>

#include <cstdarg>
#include <cstddef>
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

/// As the vendor's function reads it: what C says of flags and precision is not all the same there.
struct Field {
  bool left = false;
  bool is_long = false;
  char pad = ' ';
  std::size_t width = 0;
  std::size_t most = SIZE_MAX;  ///< characters of a text
};

void put_padded(Output& out, const Field& field, const char* text, std::size_t length) {
  const std::size_t padding = field.width > length ? field.width - length : 0;
  const auto pad = [&] {
    for (std::size_t i = 0; i < padding; ++i) out.put(field.pad);
  };
  if (!field.left) pad();
  for (std::size_t i = 0; i < length && i < field.most; ++i) out.put(text[i]);
  if (field.left) pad();
}

/// Its digits are capital letters whatever the conversion, and zeros go before the sign.
void put_number(Output& out, const Field& field, unsigned long value, unsigned base,
                bool is_negative) {
  constexpr const char* digits = "0123456789ABCDEF";
  char text[24];
  std::size_t first = sizeof text;
  do {
    text[--first] = digits[value % base];
    value /= base;
  } while (value != 0);
  if (is_negative) text[--first] = '-';
  put_padded(out, field, text + first, sizeof text - first);
}

std::size_t number(const char*& format) {
  std::size_t value = 0;
  for (; *format >= '0' && *format <= '9'; ++format)
    value = value * 10 + static_cast<std::size_t>(*format - '0');
  return value;
}

const char* parse_field(const char* format, Field& field) {
  bool is_precision = false;
  for (;;) {
    if (*format == '-') {
      field.left = true;
    } else if (*format == 'l') {
      field.is_long = true;
    } else if (*format == '.' && *(format + 1) != '*') {
      is_precision = true;
    } else if (*format >= '0' && *format <= '9') {
      if (is_precision) {
        field.most = number(format);
      } else {
        if (*format == '0') field.pad = '0';
        field.width = number(format);
      }
      continue;
    } else {
      return format;
    }
    ++format;
  }
}

}  // namespace

extern "C" {

void xil_vprintf(const char8* ctrl1, va_list arguments) {
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
      case '%':
        out.put('%');
        break;
      case 'd':
      case 'D':
      case 'i':
      case 'I': {
        const long value = field.is_long ? va_arg(arguments, long) : va_arg(arguments, int);
        const auto bits = static_cast<unsigned long>(value);
        put_number(out, field, value < 0 ? 0UL - bits : bits, 10, value < 0);
        break;
      }
      case 'u':
      case 'U':
        put_number(out, field, word(), 10, false);
        break;
      case 'x':
      case 'X':
        put_number(out, field, word(), 16, false);
        break;
      case 'p':
      case 'P':
        put_number(out, field, reinterpret_cast<std::uintptr_t>(va_arg(arguments, void*)), 16,
                   false);
        break;
      case 'c':
      case 'C':
        out.put(static_cast<char>(va_arg(arguments, int)));
        break;
      case 's':
      case 'S': {
        const char* text = va_arg(arguments, const char*);
        put_padded(out, field, text ? text : "", text ? std::strlen(text) : 0);
        break;
      }
      case '.':  // ".*s": as many characters as an argument says
        if (*(format + 1) == '*' && *(format + 2) == 's') {
          field.most = va_arg(arguments, unsigned);
          const char* text = va_arg(arguments, const char*);
          const void* const end = std::memchr(text, 0, field.most);
          put_padded(
              out, field, text,
              end ? static_cast<std::size_t>(static_cast<const char*>(end) - text) : field.most);
          format += 2;
        }
        break;
      case 0:
        --format;  // a lonely % at the end
        break;
      default:  // as %f: it prints nothing, and takes no argument
        break;
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
