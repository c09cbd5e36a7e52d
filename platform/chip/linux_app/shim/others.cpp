// Ways to files past open() and its relatives: raw system calls are led like these. What looks into
// folders inside the C library does not see the platform's files: it is refused there.

#include <errno.h>
#include <fcntl.h>
#include <fts.h>
#include <ftw.h>
#include <linux/openat2.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <wordexp.h>

#include "client.h"
#include "paths.h"

namespace shim {

namespace {

void refuse_walk(const char* path, const char* function) {
  if (!path) return;
  const Path led(path, AT_FDCWD, Path::Use::list);
  if (!led.is_ours() && !led.is_device()) return;
  fail(
      "%s() walks through %s inside the C library, where it would see this computer's own files "
      "and "
      "not the platform's: use opendir(), scandir() or glob()",
      function, path);
}

void refuse_walk(const char* path, size_t length, const char* function) {
  char text[longest_path];
  if (length == 0 || length >= sizeof text) return;
  ::memcpy(text, path, length);
  text[length] = '\0';
  refuse_walk(text, function);
}

/// The folder before the first wildcard of each word.
void refuse_expansion(const char* words) {
  for (const char* at = words; *at != '\0';) {
    at += ::strspn(at, " \t\n\"'");
    const size_t length = ::strcspn(at, " \t\n");
    const size_t plain = ::strcspn(at, "*?[ \t\n");
    size_t folder = plain;
    while (folder > 0 && at[folder - 1] != '/') --folder;
    if (plain < length) refuse_walk(at, folder, "wordexp");
    at += length;
  }
}

/// The arguments of a system call, of which it has up to six.
struct Arguments {
  long a[6];
  const char* text(int i) const { return reinterpret_cast<const char*>(a[i]); }
  void* place(int i) const { return reinterpret_cast<void*>(a[i]); }
  int number(int i) const { return static_cast<int>(a[i]); }
  size_t size(int i) const { return static_cast<size_t>(a[i]); }
};

long open_as(const Arguments& is) {
  open_how how{};
  if (is.size(3) < sizeof how) return errno = EINVAL, -1;
  ::memcpy(&how, is.place(2), sizeof how);
  const Path led(is.text(1), is.number(0), Path::use_of(static_cast<int>(how.flags)));
  if (!led.is_ours() && !led.is_device())
    return REAL(syscall)(SYS_openat2, is.a[0], is.a[1], is.a[2], is.a[3]);
  return ::openat(is.number(0), is.text(1), static_cast<int>(how.flags),
                  static_cast<mode_t>(how.mode));
}

/// Those that name a file, or may have a descriptor of the platform's.
bool is_led(long number, const Arguments& is, long& result) {
  switch (number) {
    case SYS_open:
      result = ::open(is.text(0), is.number(1), static_cast<mode_t>(is.a[2]));
      return true;
    case SYS_openat:
      result = ::openat(is.number(0), is.text(1), is.number(2), static_cast<mode_t>(is.a[3]));
      return true;
    case SYS_openat2:
      result = open_as(is);
      return true;
    case SYS_creat:
      result = ::creat(is.text(0), static_cast<mode_t>(is.a[1]));
      return true;
    case SYS_access:
      result = ::access(is.text(0), is.number(1));
      return true;
    case SYS_chdir:
      result = ::chdir(is.text(0));
      return true;
    case SYS_readlink:
      result = ::readlink(is.text(0), static_cast<char*>(is.place(1)), is.size(2));
      return true;
    case SYS_stat:
      result = ::stat(is.text(0), static_cast<struct stat*>(is.place(1)));
      return true;
    case SYS_lstat:
      result = ::lstat(is.text(0), static_cast<struct stat*>(is.place(1)));
      return true;
    case SYS_fstat:
      result = ::fstat(is.number(0), static_cast<struct stat*>(is.place(1)));
      return true;
    case SYS_newfstatat:
      result =
          ::fstatat(is.number(0), is.text(1), static_cast<struct stat*>(is.place(2)), is.number(3));
      return true;
    case SYS_statx:
      result = ::statx(is.number(0), is.text(1), is.number(2), static_cast<unsigned>(is.a[3]),
                       static_cast<struct statx*>(is.place(4)));
      return true;
    case SYS_faccessat:
      result = ::faccessat(is.number(0), is.text(1), is.number(2), 0);
      return true;
    case SYS_readlinkat:
      result = ::readlinkat(is.number(0), is.text(1), static_cast<char*>(is.place(2)), is.size(3));
      return true;
    case SYS_read:
      result = ::read(is.number(0), is.place(1), is.size(2));
      return true;
    case SYS_write:
      result = ::write(is.number(0), is.place(1), is.size(2));
      return true;
    case SYS_close:
      result = ::close(is.number(0));
      return true;
    case SYS_dup:
      result = ::dup(is.number(0));
      return true;
    case SYS_dup2:
      result = ::dup2(is.number(0), is.number(1));
      return true;
    case SYS_dup3:
      result = ::dup3(is.number(0), is.number(1), is.number(2));
      return true;
    case SYS_close_range:
      result = ::close_range(static_cast<unsigned>(is.a[0]), static_cast<unsigned>(is.a[1]),
                             is.number(2));
      return true;
    case SYS_mmap:
      result = reinterpret_cast<long>(::mmap(is.place(0), is.size(1), is.number(2), is.number(3),
                                             is.number(4), static_cast<off_t>(is.a[5])));
      return true;
    case SYS_munmap:
      result = ::munmap(is.place(0), is.size(1));
      return true;
    default:
      return false;
  }
}

FILE* reopen(const char* path, const char* mode, FILE* stream,
             FILE* (*real)(const char*, const char*, FILE*)) {
  if (!path) return real(path, mode, stream);
  const Path led(path, AT_FDCWD, Path::Use::list);
  if (led.is_device() && !led.is_ours()) {
    errno = EACCES;
    return nullptr;
  }
  const bool writes = mode[0] != 'r' || ::strchr(mode, '+');
  if (led.is_device() || (led.is_ours() && is_of_buffers(led.name()) && writes))
    fail("the application opens %s with freopen(), which reads and writes as it likes: use open()",
         led.name());
  ::fflush(stream);
  return real(led, mode, stream);
}

}  // namespace

}  // namespace shim

#pragma GCC visibility push(default)
extern "C" {

long syscall(long number, ...) noexcept {
  shim::Arguments is{};
  va_list values;
  va_start(values, number);
  for (long& value : is.a) value = va_arg(values, long);
  va_end(values);
  long result = 0;
  if (shim::is_application() && shim::is_led(number, is, result)) return result;
  return REAL(syscall)(number, is.a[0], is.a[1], is.a[2], is.a[3], is.a[4], is.a[5]);
}

FILE* freopen(const char* path, const char* mode, FILE* stream) {
  return shim::reopen(path, mode, stream, REAL(freopen));
}
FILE* freopen64(const char* path, const char* mode, FILE* stream) {
  return shim::reopen(path, mode, stream, REAL(freopen64));
}

int wordexp(const char* words, wordexp_t* result, int flags) {
  if (shim::is_application() && words) shim::refuse_expansion(words);
  return REAL(wordexp)(words, result, flags);
}

int ftw(const char* path, __ftw_func_t visit, int descriptors) {
  if (shim::is_application()) shim::refuse_walk(path, "ftw");
  return REAL(ftw)(path, visit, descriptors);
}
int ftw64(const char* path, __ftw64_func_t visit, int descriptors) {
  if (shim::is_application()) shim::refuse_walk(path, "ftw");
  return REAL(ftw64)(path, visit, descriptors);
}
int nftw(const char* path, __nftw_func_t visit, int descriptors, int flags) {
  if (shim::is_application()) shim::refuse_walk(path, "nftw");
  return REAL(nftw)(path, visit, descriptors, flags);
}
int nftw64(const char* path, __nftw64_func_t visit, int descriptors, int flags) {
  if (shim::is_application()) shim::refuse_walk(path, "nftw");
  return REAL(nftw64)(path, visit, descriptors, flags);
}

FTS* fts_open(char* const* paths, int options, int (*compare)(const FTSENT**, const FTSENT**)) {
  for (char* const* path = paths; shim::is_application() && *path; ++path)
    shim::refuse_walk(*path, "fts_open");
  return REAL(fts_open)(paths, options, compare);
}
FTS64* fts64_open(char* const* paths, int options,
                  int (*compare)(const FTSENT64**, const FTSENT64**)) {
  for (char* const* path = paths; shim::is_application() && *path; ++path)
    shim::refuse_walk(*path, "fts_open");
  return REAL(fts64_open)(paths, options, compare);
}

}  // extern "C"
#pragma GCC visibility pop
