// Standard input of the C library, which is the UART as in the vendor's _read(): scanf(), getchar()
// and all that takes `stdin`. Defined here they are the program's own; those of the host would read
// what is typed at the simulator.
#include <stdio_ext.h>
#include <xil_printf.h>

#include <cstdarg>
#include <cstdio>

namespace {

/// A line, or what there is room for, without echo; CR stays.
ssize_t read_line(void*, char* buffer, std::size_t size) {
  std::size_t count = 0;
  while (count < size) {
    buffer[count] = inbyte();
    const char last = buffer[count++];
    if (last == '\n' || last == '\r') break;
  }
  return static_cast<ssize_t>(count);
}

// A run may end in the middle of a read, and then has left no lock behind.
FILE* open_input() {
  FILE* const input = fopencookie(nullptr, "r", {read_line, nullptr, nullptr, nullptr});
  if (input) __fsetlocking(input, FSETLOCKING_BYCALLER);
  return input;
}

}  // namespace

extern "C" {

#pragma GCC visibility push(hidden)
FILE* stdin = open_input();

/// Called before each run: nothing is left of what an earlier one had not read.
void markervp_open_input() {
  stdin = open_input();
}

// The C library's names for it, by the version of C.
#define MARKERVP_SCANF(version, prefix)                                              \
  int markervp_vscanf_##version(const char*, std::va_list) __asm__(prefix "vscanf"); \
  int markervp_vscanf_##version(const char* format, std::va_list arguments) {        \
    return std::vfscanf(stdin, format, arguments);                                   \
  }                                                                                  \
  int markervp_scanf_##version(const char*, ...) __asm__(prefix "scanf");            \
  int markervp_scanf_##version(const char* format, ...) {                            \
    std::va_list arguments;                                                          \
    va_start(arguments, format);                                                     \
    const int count = std::vfscanf(stdin, format, arguments);                        \
    va_end(arguments);                                                               \
    return count;                                                                    \
  }
MARKERVP_SCANF(gnu, "")
MARKERVP_SCANF(c99, "__isoc99_")
MARKERVP_SCANF(c23, "__isoc23_")
#undef MARKERVP_SCANF

// The host's headers have bodies of these.
int markervp_getchar() __asm__("getchar");
int markervp_getchar() {
  return std::getc(stdin);
}
int markervp_getchar_unlocked() __asm__("getchar_unlocked");
int markervp_getchar_unlocked() {
  return std::getc(stdin);
}

/// Of C before 2011. Newlib's does not know either how much room there is.
char* gets(char* line) {
  char* next = line;
  int got = std::getc(stdin);
  if (got == EOF) return nullptr;
  for (; got != EOF && got != '\n'; got = std::getc(stdin)) *next++ = static_cast<char>(got);
  *next = '\0';
  return line;
}
#pragma GCC visibility pop

}  // extern "C"
