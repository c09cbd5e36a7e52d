// Device files and their sysfs: what opens, maps, reads, writes and closes them.

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <glob.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "client.h"

namespace shim {

namespace {

using linux_app::Device;

constexpr std::size_t page = 4096;
constexpr int most_descriptors = 4096;
constexpr int most_open = 64;

/// An open file description.
struct Open {
  enum class Kind : std::uint8_t { none, memory, uio, buffer, attribute };
  Kind kind;
  bool sync;  ///< O_SYNC or O_DSYNC
  std::uint32_t number;
  std::uint64_t base, size;
  unsigned descriptors;  ///< that stand for it
  // Of an uio: an event that is set as long as there are interrupts that were not read.
  int event;
  bool is_set;
  std::uint32_t seen;  ///< interrupts
  // Of an attribute: a file without a name, which takes what is written.
  char name[NAME_MAX + 1];
};
Open opens[most_open];
std::uint8_t by_descriptor[most_descriptors];  ///< number in `opens` plus 1; 0: another file
std::uint64_t memory_first = 0, memory_end = 0;
std::uint32_t interrupts[linux_app::most_uio];

Open* open_at(int descriptor) {
  if (descriptor < 0 || descriptor >= most_descriptors || by_descriptor[descriptor] == 0)
    return nullptr;
  return &opens[by_descriptor[descriptor] - 1];
}

Open& new_open(Open::Kind kind) {
  for (Open& open : opens) {
    if (open.kind != Open::Kind::none) continue;
    open = {};
    open.kind = kind;
    open.event = -1;
    return open;
  }
  fail("the application has more than %d device files and attributes open: close them", most_open);
}

void give(int descriptor, Open& open) {
  if (descriptor >= most_descriptors)
    fail("a device file would have the descriptor %d: close others, %d is the last that is taken",
         descriptor, most_descriptors - 1);
  by_descriptor[descriptor] = static_cast<std::uint8_t>(&open - opens + 1);
  ++open.descriptors;
}

void also_give(int descriptor, int other) {
  Open* const open = open_at(descriptor);
  if (open && other >= 0) give(other, *open);
}

void forget(int descriptor) {
  Open* const open = open_at(descriptor);
  if (!open) return;
  by_descriptor[descriptor] = 0;
  if (--open->descriptors != 0) return;
  if (open->event >= 0) REAL(close)(open->event);
  open->kind = Open::Kind::none;
}

int refuse(int error) {
  errno = error;
  return -1;
}

bool begins(const char* text, const char* with) {
  return ::strncmp(text, with, ::strlen(with)) == 0;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool names_device(const char* path) {
  return ::strcmp(path, "/dev/mem") == 0 ||
         (begins(path, "/dev/uio") && is_digit(path[::strlen("/dev/uio")])) ||
         (begins(path, "/dev/udmabuf") && is_digit(path[::strlen("/dev/udmabuf")]));
}

bool is_of_buffers(const char* path) {
  return begins(path, "/sys/class/u-dma-buf/") || begins(path, "/sys/class/udmabuf/");
}

/// Where a path leads: the platform has a folder with the devices and their sysfs.
class Path {
 public:
  explicit Path(const char* path) : path_(path) {
    if (!path || path[0] != '/') return;
    const char* const tree = folder();
    if (!tree) return;
    is_device_ = names_device(path);
    const bool is_class = begins(path, "/sys/class/uio") || begins(path, "/sys/class/u-dma-buf") ||
                          begins(path, "/sys/class/udmabuf");
    if (!is_device_ && !is_class) return;
    if (!is_application()) {
      if (is_device_)
        ::dprintf(STDERR_FILENO,
                  "markervp: '%s', which the application started, uses %s: only the application "
                  "itself reaches the platform\n",
                  program_invocation_short_name, path);
      return;
    }
    if (::snprintf(led_, sizeof led_, "%s%s", tree, path) < static_cast<int>(sizeof led_))
      path_ = led_;
  }
  operator const char*() const { return path_; }
  bool is_ours() const { return path_ == led_; }
  bool is_device() const { return is_device_; }

 private:
  const char* path_;
  char led_[PATH_MAX];
  bool is_device_ = false;
};

int open_device(const char* path, const Path& led, int flags) {
  if (REAL(access)(led, F_OK) != 0) {
    if (is_in_lock_step()) ask(What::missing, 0, 0, 0, path);
    return refuse(ENOENT);
  }
  take_devices();
  const char* const digits = ::strpbrk(path, "0123456789");
  const unsigned long number = digits ? ::strtoul(digits, nullptr, 10) : 0;
  const bool is_memory = !digits, is_uio = begins(path, "/dev/uio");
  const Device device = is_memory ? Device::memory : is_uio ? Device::uio : Device::buffer;
  const Reply reply = ask(What::open, static_cast<std::uint64_t>(device), number);
  // No regular file: some look at that before they map it.
  const int descriptor = ::eventfd(0, ((flags & O_NONBLOCK) != 0 ? EFD_NONBLOCK : 0) |
                                          ((flags & O_CLOEXEC) != 0 ? EFD_CLOEXEC : 0));
  if (descriptor < 0) return descriptor;
  using Kind = Open::Kind;
  Open& open = new_open(is_memory ? Kind::memory : is_uio ? Kind::uio : Kind::buffer);
  open.sync = (flags & O_DSYNC) != 0;  // O_SYNC has its bit
  open.number = static_cast<std::uint32_t>(number);
  open.base = reply.a;
  open.size = reply.b;
  if (is_uio) {
    open.event = REAL(fcntl)(descriptor, F_DUPFD_CLOEXEC, linux_app::memory_descriptor + 1);
    open.seen = interrupts[open.number];
  }
  give(descriptor, open);
  return descriptor;
}

/// Files of sysfs that take something, in a folder of a buffer.
int open_attribute(const char* path, const Path& led) {
  if (REAL(access)(led, F_OK) != 0) return -1;
  const char* const name = ::strrchr(path, '/') + 1;
  const char* const digits = ::strpbrk(path, "0123456789");
  const bool takes = begins(name, "sync_") && ::strcmp(name, "sync_owner") != 0;
  if (!takes || !digits) return refuse(EACCES);
  const int descriptor = ::memfd_create("attribute", MFD_CLOEXEC);
  if (descriptor < 0) return descriptor;
  Open& open = new_open(Open::Kind::attribute);
  open.number = static_cast<std::uint32_t>(::strtoul(digits, nullptr, 10));
  ::snprintf(open.name, sizeof open.name, "%s", name);
  give(descriptor, open);
  return descriptor;
}

/// Hands over what was written to an attribute.
int store(int descriptor) {
  Open* const open = open_at(descriptor);
  if (!open || open->kind != Open::Kind::attribute) return 0;
  char text[linux_app::longest_text];
  const int length = ::snprintf(text, sizeof text, "%s ", open->name);
  const ssize_t count = ::pread(descriptor, text + length, sizeof text - length - 1, 0);
  if (count <= 0) return 0;
  text[length + count] = '\0';
  if (::ftruncate(descriptor, 0) == 0) ::lseek(descriptor, 0, SEEK_SET);
  const int error = ask(What::store, open->number, 0, 0, text).error;
  return error == 0 ? 0 : refuse(error);
}

/// Opens one of the files that are the platform's; `plain` any other.
template <class Plain>
int open_by(const char* path, int flags, Plain plain) {
  const Path led(path);
  if (!led.is_ours()) {
    if (led.is_device()) return refuse(EACCES);
    return plain(static_cast<const char*>(led));
  }
  if (led.is_device()) return open_device(path, led, flags);
  if (is_of_buffers(path) && (flags & O_ACCMODE) != O_RDONLY) return open_attribute(path, led);
  return plain(static_cast<const char*>(led));
}

mode_t mode_of(int flags, va_list values) {
  const bool has_mode = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
  return has_mode ? va_arg(values, mode_t) : 0;
}

template <class Plain>
FILE* open_stream(const char* path, const char* mode, Plain plain) {
  const Path led(path);
  if (!led.is_ours() && !led.is_device()) return plain(static_cast<const char*>(led));
  if (led.is_device())
    fail("the application opens %s with fopen(), which reads and writes as it likes: use open()",
         path);
  if (!is_of_buffers(path) || (mode[0] == 'r' && !::strchr(mode, '+')))
    return plain(static_cast<const char*>(led));
  const int descriptor = open_attribute(path, led);
  return descriptor < 0 ? nullptr : ::fdopen(descriptor, mode);
}

void set_event(Open& open) {
  const bool set = open.seen != interrupts[open.number];
  if (set == open.is_set) return;
  std::uint64_t count = 1;
  const ssize_t done = set ? REAL(write)(open.event, &count, sizeof count)
                           : REAL(read)(open.event, &count, sizeof count);
  open.is_set = done > 0 ? set : open.is_set;
}

ssize_t read_uio(int descriptor, Open& open, void* buffer, std::size_t size) {
  if (size != sizeof open.seen) return refuse(EINVAL);
  const bool waits = (REAL(fcntl)(descriptor, F_GETFL) & O_NONBLOCK) == 0;
  const auto count =
      static_cast<std::uint32_t>(ask(What::interrupt, open.number, open.seen, waits).a);
  if (count == open.seen) return refuse(EAGAIN);
  open.seen = count;
  set_event(open);
  ::memcpy(buffer, &count, sizeof count);
  return sizeof count;
}

ssize_t write_uio(const Open& open, const void* buffer, std::size_t size) {
  std::uint32_t on = 0;
  if (size != sizeof on) return refuse(EINVAL);
  ::memcpy(&on, buffer, sizeof on);
  const int error = ask(What::control, open.number, on).error;
  return error == 0 ? static_cast<ssize_t>(size) : refuse(error);
}

void* map_memory(void* address, std::size_t length, int protection, int flags, std::uint64_t bus,
                 std::uint64_t how) {
  void* const got = REAL(mmap)(address, length, protection, flags, linux_app::memory_descriptor,
                               static_cast<off_t>(bus - memory_first));
  if (got != MAP_FAILED) ask(What::map, bus, length, how);
  return got;
}

void* map(const Open& open, void* address, std::size_t length, int protection, int flags,
          std::uint64_t offset) {
  using Kind = Open::Kind;
  const std::uint64_t pages = (length + page - 1) / page * page;
  const std::uint64_t size =
      open.kind == Kind::memory ? std::uint64_t{1} << 32 : (open.size + page - 1) / page * page;
  const bool is_there = offset % page == 0 && length != 0 && pages <= size &&
                        offset <= (open.kind == Kind::uio ? 0 : size - pages);
  if (!is_there) {
    warn_of_invalid(
        "mmap() of %zu bytes at offset 0x%llX: of this file 0x%llX can be mapped, by pages", length,
        static_cast<unsigned long long>(offset), static_cast<unsigned long long>(size));
    return MAP_FAILED;
  }
  const std::uint64_t how = open.sync ? std::uint64_t{linux_app::o_sync} : 0;
  if (open.kind == Kind::buffer)
    return map_memory(address, length, protection, flags, open.base + offset,
                      how | linux_app::of_buffer | static_cast<std::uint64_t>(open.number) << 8);
  if (open.kind == Kind::memory && offset >= memory_first && offset + pages <= memory_end)
    return map_memory(address, length, protection, flags, offset, how);
  return map_registers(address, length, protection, flags,
                       static_cast<std::uint32_t>(open.base + offset));
}

bool is_of_platform(int descriptor) {
  return is_application() &&
         (descriptor == linux_app::socket_descriptor || descriptor == linux_app::memory_descriptor);
}

}  // namespace

void set_memory(std::uint64_t first, std::uint64_t end) {
  memory_first = first;
  memory_end = end;
}

bool may_be_interrupted() {
  for (const Open& open : opens) {
    if (open.kind == Open::Kind::uio) return true;
  }
  return false;
}

void note_interrupts(const Reply& reply) {
  ::memcpy(interrupts, reply.interrupts, sizeof interrupts);
  for (Open& open : opens) {
    if (open.kind == Open::Kind::uio) set_event(open);
  }
}

}  // namespace shim

using shim::Path;

// Functions of the C library.
#pragma GCC visibility push(default)
extern "C" {

#define OPEN(name)                                                                     \
  int name(const char* path, int flags, ...) {                                         \
    va_list values;                                                                    \
    va_start(values, flags);                                                           \
    const mode_t mode = shim::mode_of(flags, values);                                  \
    va_end(values);                                                                    \
    return shim::open_by(path, flags,                                                  \
                         [&](const char* to) { return REAL(name)(to, flags, mode); }); \
  }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                                                           \
  int name(int folder, const char* path, int flags, ...) {                                     \
    va_list values;                                                                            \
    va_start(values, flags);                                                                   \
    const mode_t mode = shim::mode_of(flags, values);                                          \
    va_end(values);                                                                            \
    return shim::open_by(path, flags,                                                          \
                         [&](const char* to) { return REAL(name)(folder, to, flags, mode); }); \
  }
OPENAT(openat)
OPENAT(openat64)

// Of -D_FORTIFY_SOURCE.
int __open_2(const char*, int);
int __open64_2(const char*, int);
ssize_t __read_chk(int, void*, size_t, size_t);
int __open_2(const char* path, int flags) {
  return shim::open_by(path, flags, [&](const char* to) { return REAL(__open_2)(to, flags); });
}
int __open64_2(const char* path, int flags) {
  return shim::open_by(path, flags, [&](const char* to) { return REAL(__open64_2)(to, flags); });
}

FILE* fopen(const char* path, const char* mode) {
  return shim::open_stream(path, mode, [&](const char* to) { return REAL(fopen)(to, mode); });
}
FILE* fopen64(const char* path, const char* mode) {
  return shim::open_stream(path, mode, [&](const char* to) { return REAL(fopen64)(to, mode); });
}

int fflush(FILE* stream) {
  const int result = REAL(fflush)(stream);
  return stream && shim::store(::fileno(stream)) != 0 ? EOF : result;
}

int fclose(FILE* stream) {
  const int descriptor = ::fileno(stream);
  const int flushed = ::fflush(stream);
  if (descriptor >= 0) shim::forget(descriptor);
  const int closed = REAL(fclose)(stream);
  return flushed != 0 ? flushed : closed;
}

int close(int descriptor) {
  if (shim::is_of_platform(descriptor)) return 0;
  const int stored = shim::store(descriptor);
  shim::forget(descriptor);
  const int closed = REAL(close)(descriptor);
  return stored != 0 ? stored : closed;
}

ssize_t read(int descriptor, void* buffer, size_t size) {
  shim::Open* const open = shim::open_at(descriptor);
  if (!open || open->kind == shim::Open::Kind::attribute)
    return REAL(read)(descriptor, buffer, size);
  if (open->kind == shim::Open::Kind::uio) return shim::read_uio(descriptor, *open, buffer, size);
  return shim::refuse(EINVAL);
}

ssize_t __read_chk(int descriptor, void* buffer, size_t size, size_t room) {
  if (shim::open_at(descriptor) && size <= room) return read(descriptor, buffer, size);
  return REAL(__read_chk)(descriptor, buffer, size, room);
}

ssize_t write(int descriptor, const void* buffer, size_t size) {
  shim::Open* const open = shim::open_at(descriptor);
  if (!open) return REAL(write)(descriptor, buffer, size);
  if (open->kind == shim::Open::Kind::uio) return shim::write_uio(*open, buffer, size);
  if (open->kind != shim::Open::Kind::attribute) return shim::refuse(EINVAL);
  const ssize_t written = REAL(write)(descriptor, buffer, size);
  return shim::store(descriptor) != 0 ? -1 : written;
}

void* mmap(void* address, size_t length, int protection, int flags, int descriptor,
           off_t offset) noexcept {
  const shim::Open* const open = shim::open_at(descriptor);
  return open ? shim::map(*open, address, length, protection, flags,
                          static_cast<std::uint64_t>(offset))
              : REAL(mmap)(address, length, protection, flags, descriptor, offset);
}

void* mmap64(void* address, size_t length, int protection, int flags, int descriptor,
             off64_t offset) noexcept {
  return mmap(address, length, protection, flags, descriptor, offset);
}

int munmap(void* address, size_t length) noexcept {
  const int result = REAL(munmap)(address, length);
  if (result == 0) shim::unmap_registers(address, length);
  return result;
}

int dup(int descriptor) noexcept {
  const int other = REAL(dup)(descriptor);
  shim::also_give(descriptor, other);
  return other;
}

int dup2(int descriptor, int other) noexcept {
  const int result = REAL(dup2)(descriptor, other);
  if (result < 0 || descriptor == other) return result;
  shim::forget(other);
  shim::also_give(descriptor, other);
  return result;
}

int dup3(int descriptor, int other, int flags) noexcept {
  const int result = REAL(dup3)(descriptor, other, flags);
  if (result < 0) return result;
  shim::forget(other);
  shim::also_give(descriptor, other);
  return result;
}

#define FCNTL(name)                                                                            \
  int name(int descriptor, int command, ...) {                                                 \
    va_list values;                                                                            \
    va_start(values, command);                                                                 \
    void* const value = va_arg(values, void*);                                                 \
    va_end(values);                                                                            \
    const int result = REAL(name)(descriptor, command, value);                                 \
    if (command == F_DUPFD || command == F_DUPFD_CLOEXEC) shim::also_give(descriptor, result); \
    return result;                                                                             \
  }
FCNTL(fcntl)
FCNTL(fcntl64)

// Whoever looks around: the same functions, for paths that lead into the platform's folder.
DIR* opendir(const char* path) {
  return REAL(opendir)(Path(path));
}
int scandir(const char* path, struct dirent*** list, int (*filter)(const struct dirent*),
            int (*compare)(const struct dirent**, const struct dirent**)) {
  return REAL(scandir)(Path(path), list, filter, compare);
}
int scandir64(const char* path, struct dirent64*** list, int (*filter)(const struct dirent64*),
              int (*compare)(const struct dirent64**, const struct dirent64**)) {
  return REAL(scandir64)(Path(path), list, filter, compare);
}
int stat(const char* path, struct stat* result) noexcept {
  return REAL(stat)(Path(path), result);
}
int stat64(const char* path, struct stat64* result) noexcept {
  return REAL(stat64)(Path(path), result);
}
int lstat(const char* path, struct stat* result) noexcept {
  return REAL(lstat)(Path(path), result);
}
int lstat64(const char* path, struct stat64* result) noexcept {
  return REAL(lstat64)(Path(path), result);
}
int access(const char* path, int mode) noexcept {
  return REAL(access)(Path(path), mode);
}
ssize_t readlink(const char* path, char* buffer, size_t size) noexcept {
  return REAL(readlink)(Path(path), buffer, size);
}

}  // extern "C"
#pragma GCC visibility pop
