// Device files and their sysfs: what opens, maps, reads, writes and closes them.

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <unistd.h>

#include "client.h"
#include "opens.h"
#include "paths.h"

namespace shim {

namespace {

using linux_app::Device;

constexpr std::size_t page = 4096;
std::uint64_t memory_first = 0, memory_end = 0;
std::uint32_t interrupts[linux_app::most_uio];

int refuse(int error) {
  errno = error;
  return -1;
}

int open_device(const Path& path, int flags) {
  if (REAL(access)(path, F_OK) != 0) {
    if (is_in_lock_step()) ask(What::missing, 0, 0, 0, path.name());
    return refuse(ENOENT);
  }
  take_devices();
  const unsigned long number = number_in(path.name());
  const bool is_memory = ::strcmp(path.name(), "/dev/mem") == 0;
  const bool is_uio = begins(path.name(), "/dev/uio");
  const Device device = is_memory ? Device::memory : is_uio ? Device::uio : Device::buffer;
  const Reply reply = ask(What::open, static_cast<std::uint64_t>(device), number);
  // No regular file: some look at that before they map it.
  const int descriptor =
      ::eventfd(reply.error != 0, ((flags & O_NONBLOCK) != 0 ? EFD_NONBLOCK : 0) |
                                      ((flags & O_CLOEXEC) != 0 ? EFD_CLOEXEC : 0));
  if (descriptor < 0) return descriptor;
  using Kind = Open::Kind;
  Open& open = new_open(is_memory ? Kind::memory : is_uio ? Kind::uio : Kind::buffer);
  open.sync = (flags & O_DSYNC) != 0;  // O_SYNC has its bit
  open.number = static_cast<std::uint32_t>(number);
  open.base = reply.a;
  open.size = reply.b;
  if (is_uio) {
    open.event = copy_out_of_the_way(descriptor);
    open.seen = interrupts[open.number];
    open.silent = reply.error != 0;
  }
  give(descriptor, open);
  return descriptor;
}

/// Files of sysfs that take something, in a folder of a buffer.
int open_attribute(const Path& path) {
  if (REAL(access)(path, F_OK) != 0) return -1;
  const char* const name = ::strrchr(path.name(), '/') + 1;
  const bool takes = begins(name, "sync_") && ::strcmp(name, "sync_owner") != 0;
  if (!takes) return refuse(EACCES);
  const int descriptor = ::memfd_create("attribute", MFD_CLOEXEC);
  if (descriptor < 0) return descriptor;
  Open& open = new_open(Open::Kind::attribute);
  open.number = static_cast<std::uint32_t>(number_in(path.name()));
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
int open_by(int folder, const char* path, int flags, Plain plain) {
  const Path led(path, folder, Path::use_of(flags));
  if (led.is_device() && !led.is_ours()) return refuse(EACCES);
  if (led.is_device()) return open_device(led, flags);
  if (led.is_ours() && is_of_buffers(led.name()) && (flags & O_ACCMODE) != O_RDONLY)
    return open_attribute(led);
  return plain(static_cast<const char*>(led));
}

mode_t mode_of(int flags, va_list values) {
  const bool has_mode = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
  return has_mode ? va_arg(values, mode_t) : 0;
}

template <class Plain>
FILE* open_stream(const char* path, const char* mode, Plain plain) {
  const Path led(path, AT_FDCWD, Path::Use::list);
  if (led.is_device() && !led.is_ours()) {
    errno = EACCES;
    return nullptr;
  }
  if (led.is_device())
    fail("the application opens %s with fopen(), which reads and writes as it likes: use open()",
         led.name());
  if (!led.is_ours() || !is_of_buffers(led.name()) || (mode[0] == 'r' && !::strchr(mode, '+')))
    return plain(static_cast<const char*>(led));
  const int descriptor = open_attribute(led);
  return descriptor < 0 ? nullptr : ::fdopen(descriptor, mode);
}

void set_event(Open& open) {
  if (open.silent) return;
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
  const Reply reply = ask(What::interrupt, open.number, open.seen, waits);
  if (reply.error != 0) return refuse(reply.error);
  const auto count = static_cast<std::uint32_t>(reply.a);
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
  void* const got = map_low(address, length, protection, flags, memory_file(),
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
        "mmap() of %zu bytes at offset 0x%llX: of this file 0x%llX can be mapped, by pages%s",
        length, static_cast<unsigned long long>(offset), static_cast<unsigned long long>(size),
        open.kind == Kind::buffer ? "; linux.udmabuf_size makes it larger" : "");
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

}  // namespace

void set_memory(std::uint64_t first, std::uint64_t end) {
  memory_first = first;
  memory_end = end;
}

bool may_be_interrupted() {
  for (const Open& open : opens()) {
    if (open.kind == Open::Kind::uio) return true;
  }
  return false;
}

dev_t device_open_at(int descriptor) {
  const Open* const open = open_at(descriptor);
  if (!open || open->kind == Open::Kind::attribute) return 0;
  using Kind = Open::Kind;
  char name[64] = "/dev/mem";
  if (open->kind != Kind::memory)
    ::snprintf(name, sizeof name, "/dev/%s%u", open->kind == Kind::uio ? "uio" : "udmabuf",
               open->number);
  return device_at(name);
}

// An event that is not set was read, with all that came before.
void resume_interrupts(const std::uint32_t* before) {
  for (Open& open : opens()) {
    if (open.kind != Open::Kind::uio) continue;
    pollfd event{open.event, POLLIN, 0};
    open.is_set = REAL(poll)(&event, 1, 0) > 0;
    if (!open.is_set) open.seen = before[open.number];
  }
}

void note_interrupts(const Reply& reply) {
  ::memcpy(interrupts, reply.interrupts, sizeof interrupts);
  for (Open& open : opens()) {
    if (open.kind == Open::Kind::uio) set_event(open);
  }
}

}  // namespace shim

// Functions of the C library.
#pragma GCC visibility push(default)
extern "C" {

#define OPEN(name)                                                                     \
  int name(const char* path, int flags, ...) {                                         \
    va_list values;                                                                    \
    va_start(values, flags);                                                           \
    const mode_t mode = shim::mode_of(flags, values);                                  \
    va_end(values);                                                                    \
    return shim::open_by(AT_FDCWD, path, flags,                                        \
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
    return shim::open_by(folder, path, flags,                                                  \
                         [&](const char* to) { return REAL(name)(folder, to, flags, mode); }); \
  }
OPENAT(openat)
OPENAT(openat64)

// Of -D_FORTIFY_SOURCE.
int __open_2(const char*, int);
int __open64_2(const char*, int);
int __openat_2(int, const char*, int);
int __openat64_2(int, const char*, int);
ssize_t __read_chk(int, void*, size_t, size_t);
int __open_2(const char* path, int flags) {
  return shim::open_by(AT_FDCWD, path, flags,
                       [&](const char* to) { return REAL(__open_2)(to, flags); });
}
int __open64_2(const char* path, int flags) {
  return shim::open_by(AT_FDCWD, path, flags,
                       [&](const char* to) { return REAL(__open64_2)(to, flags); });
}
int __openat_2(int folder, const char* path, int flags) {
  return shim::open_by(folder, path, flags,
                       [&](const char* to) { return REAL(__openat_2)(folder, to, flags); });
}
int __openat64_2(int folder, const char* path, int flags) {
  return shim::open_by(folder, path, flags,
                       [&](const char* to) { return REAL(__openat64_2)(folder, to, flags); });
}

int creat(const char* path, mode_t mode) {
  return ::open(path, O_CREAT | O_WRONLY | O_TRUNC, mode);
}
int creat64(const char* path, mode_t mode) {
  return ::open64(path, O_CREAT | O_WRONLY | O_TRUNC, mode);
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
  if (shim::hidden(descriptor)) return shim::refuse(EBADF);
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

}  // extern "C"
#pragma GCC visibility pop
