// What looks for files without opening them: the C library's functions, for paths that lead to the
// platform's devices.

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <glob.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include "client.h"
#include "paths.h"

namespace shim {

namespace {

using Use = Path::Use;

/// Of the flags of a call like fstatat().
Use use_at(int flags) {
  return (flags & AT_SYMLINK_NOFOLLOW) != 0 ? Use::link : Use::follow;
}

/// A device is a character device, whatever the folder has.
template <class Status>
int shown(int result, dev_t device, Status* status) {
  if (result != 0 || device == 0) return result;
  status->st_mode = S_IFCHR | S_IRUSR | S_IWUSR;
  status->st_rdev = device;
  status->st_size = 0;
  return result;
}
int shown(int result, dev_t device, struct statx* status) {
  if (result != 0 || device == 0) return result;
  status->stx_mode = S_IFCHR | S_IRUSR | S_IWUSR;
  status->stx_rdev_major = major(device);
  status->stx_rdev_minor = minor(device);
  status->stx_size = 0;
  return result;
}

/// The device at a path, or behind a descriptor.
dev_t device_of(const Path& path, int folder, const char* text) {
  if (text && text[0] == '\0') return device_open_at(folder);
  return path.is_ours() ? device_at(path.name()) : 0;
}

/// An entry of the folder becomes what a kernel's has.
template <class Entry>
Entry* seen(DIR* folder, Entry* entry) {
  if (!entry || !is_application() || (entry->d_type != DT_REG && entry->d_type != DT_LNK))
    return entry;
  char name[sizeof entry->d_name + 8], link[64], path[longest_path];
  ::snprintf(name, sizeof name, "/dev/%s", entry->d_name);
  if (entry->d_type == DT_REG && device_at(name) == 0) return entry;
  ::snprintf(link, sizeof link, "/proc/self/fd/%d", ::dirfd(folder));
  const ssize_t length = REAL(readlink)(link, path, sizeof path - 1);
  if (length <= 0) return entry;
  path[length] = '\0';
  if (!begins(path, shim::folder())) return entry;
  entry->d_type = entry->d_type == DT_REG ? DT_CHR : DT_UNKNOWN;
  return entry;
}

using Filter = int (*)(const struct dirent*);
using Compare = int (*)(const struct dirent**, const struct dirent**);

/// A list of entries that grows.
class Entries {
 public:
  bool add(const struct dirent& entry) {
    if (count_ == room_) {
      room_ = room_ == 0 ? 16 : 2 * room_;
      void* const more = ::realloc(list_, room_ * sizeof(struct dirent*));
      if (!more) return false;
      list_ = static_cast<struct dirent**>(more);
    }
    auto* const copy = static_cast<struct dirent*>(::malloc(entry.d_reclen));
    if (!copy) return false;
    list_[count_++] = static_cast<struct dirent*>(::memcpy(copy, &entry, entry.d_reclen));
    return true;
  }
  int give(struct dirent*** list, Compare compare) {
    if (compare && count_ != 0)
      ::qsort(list_, count_, sizeof(struct dirent*),
              reinterpret_cast<int (*)(const void*, const void*)>(compare));
    *list = list_;
    return static_cast<int>(count_);
  }
  int drop() {
    while (count_ != 0) ::free(list_[--count_]);
    ::free(list_);
    errno = ENOMEM;
    return -1;
  }

 private:
  struct dirent** list_ = nullptr;
  std::size_t count_ = 0, room_ = 0;
};

DIR* open_folder(const char* path) {
  return REAL(opendir)(Path(path, AT_FDCWD, Use::list));
}

// The C library's own takes another way to the entries.
int scan(const char* path, struct dirent*** list, Filter filter, Compare compare) {
  DIR* const folder = open_folder(path);
  if (!folder) return -1;
  Entries entries;
  bool fits = true;
  while (const struct dirent* const entry = fits ? ::readdir(folder) : nullptr) {
    if (!filter || filter(entry) != 0) fits = entries.add(*entry);
  }
  ::closedir(folder);
  return fits ? entries.give(list, compare) : entries.drop();
}

/// glob() with the functions of this file.
template <class Function, class Result>
int look_up(Function* real, const char* pattern, int flags, int (*on_error)(const char*, int),
            Result* result) {
  if (!is_application() || (flags & GLOB_ALTDIRFUNC) != 0)
    return real(pattern, flags, on_error, result);
  result->gl_opendir = [](const char* path) -> void* { return open_folder(path); };
  result->gl_readdir = [](void* folder) { return ::readdir(static_cast<DIR*>(folder)); };
  result->gl_closedir = [](void* folder) { ::closedir(static_cast<DIR*>(folder)); };
  result->gl_stat = [](const char* path, struct stat* status) { return ::stat(path, status); };
  result->gl_lstat = [](const char* path, struct stat* status) { return ::lstat(path, status); };
  const int code = real(pattern, flags | GLOB_ALTDIRFUNC, on_error, result);
  result->gl_flags &= ~GLOB_ALTDIRFUNC;
  return code;
}

}  // namespace

}  // namespace shim

using shim::device_of;
using shim::Path;
using shim::shown;
using Use = Path::Use;

// Each for files of any size, too: the same function on this machine.
static_assert(sizeof(struct stat) == sizeof(struct stat64) &&
              sizeof(struct dirent) == sizeof(struct dirent64) &&
              sizeof(glob_t) == sizeof(glob64_t));

#pragma GCC visibility push(default)
extern "C" {

#define STATUS(type, stat_name, lstat_name, fstat_name, fstatat_name)                          \
  int stat_name(const char* path, struct type* status) noexcept {                              \
    const Path led(path);                                                                      \
    return shown(REAL(stat_name)(led, status), device_of(led, -1, nullptr), status);           \
  }                                                                                            \
  int lstat_name(const char* path, struct type* status) noexcept {                             \
    const Path led(path, AT_FDCWD, Use::link);                                                 \
    return shown(REAL(lstat_name)(led, status), device_of(led, -1, nullptr), status);          \
  }                                                                                            \
  int fstat_name(int file, struct type* status) noexcept {                                     \
    return shown(REAL(fstat_name)(file, status), shim::device_open_at(file), status);          \
  }                                                                                            \
  int fstatat_name(int folder, const char* path, struct type* status, int flags) noexcept {    \
    const Path led(path, folder, shim::use_at(flags));                                         \
    return shown(REAL(fstatat_name)(folder, led, status, flags), device_of(led, folder, path), \
                 status);                                                                      \
  }
STATUS(stat, stat, lstat, fstat, fstatat)
STATUS(stat64, stat64, lstat64, fstat64, fstatat64)

int statx(int folder, const char* path, int flags, unsigned mask, struct statx* status) noexcept {
  const Path led(path, folder, shim::use_at(flags));
  return shown(REAL(statx)(folder, led, flags, mask, status), device_of(led, folder, path), status);
}

// What older versions of the C library's headers made of stat() and its relatives.
#define OLD_STATUS(type, suffix)                                                 \
  int __xstat##suffix(int, const char* path, struct type* status) noexcept {     \
    return ::stat##suffix(path, status);                                         \
  }                                                                              \
  int __lxstat##suffix(int, const char* path, struct type* status) noexcept {    \
    return ::lstat##suffix(path, status);                                        \
  }                                                                              \
  int __fxstat##suffix(int, int file, struct type* status) noexcept {            \
    return ::fstat##suffix(file, status);                                        \
  }                                                                              \
  int __fxstatat##suffix(int, int folder, const char* path, struct type* status, \
                         int flags) noexcept {                                   \
    return ::fstatat##suffix(folder, path, status, flags);                       \
  }
OLD_STATUS(stat, )
OLD_STATUS(stat64, 64)

int access(const char* path, int mode) noexcept {
  return REAL(access)(Path(path), mode);
}
int eaccess(const char* path, int mode) noexcept {
  return REAL(eaccess)(Path(path), mode);
}
int euidaccess(const char* path, int mode) noexcept {
  return REAL(euidaccess)(Path(path), mode);
}
int faccessat(int folder, const char* path, int mode, int flags) noexcept {
  return REAL(faccessat)(folder, Path(path, folder, shim::use_at(flags)), mode, flags);
}

ssize_t readlink(const char* path, char* buffer, size_t size) noexcept {
  return REAL(readlink)(Path(path, AT_FDCWD, Use::link), buffer, size);
}
ssize_t readlinkat(int folder, const char* path, char* buffer, size_t size) noexcept {
  return REAL(readlinkat)(folder, Path(path, folder, Use::link), buffer, size);
}
char* realpath(const char* path, char* resolved) noexcept {
  return shim::as_seen(REAL(realpath)(Path(path), resolved));
}
char* canonicalize_file_name(const char* path) noexcept {
  return ::realpath(path, nullptr);
}
char* __realpath_chk(const char*, char*, size_t) noexcept;
char* __realpath_chk(const char* path, char* resolved, size_t room) noexcept {
  return shim::as_seen(REAL(__realpath_chk)(Path(path), resolved, room));
}

int chdir(const char* path) noexcept {
  return REAL(chdir)(Path(path));
}
char* getcwd(char* buffer, size_t size) noexcept {
  return shim::as_seen(REAL(getcwd)(buffer, size));
}
char* get_current_dir_name(void) noexcept {
  return shim::as_seen(REAL(get_current_dir_name)());
}
char* __getcwd_chk(char*, size_t, size_t) noexcept;
char* __getcwd_chk(char* buffer, size_t size, size_t room) noexcept {
  return shim::as_seen(REAL(__getcwd_chk)(buffer, size, room));
}

DIR* opendir(const char* path) {
  return shim::open_folder(path);
}
struct dirent* readdir(DIR* folder) {
  return shim::seen(folder, REAL(readdir)(folder));
}
struct dirent64* readdir64(DIR* folder) {
  return shim::seen(folder, REAL(readdir64)(folder));
}
int scandir(const char* path, struct dirent*** list, int (*filter)(const struct dirent*),
            int (*compare)(const struct dirent**, const struct dirent**)) {
  return shim::scan(path, list, filter, compare);
}
int scandir64(const char* path, struct dirent64*** list, int (*filter)(const struct dirent64*),
              int (*compare)(const struct dirent64**, const struct dirent64**)) {
  return shim::scan(path, reinterpret_cast<struct dirent***>(list),
                    reinterpret_cast<shim::Filter>(filter),
                    reinterpret_cast<shim::Compare>(compare));
}

int glob(const char* pattern, int flags, int (*on_error)(const char*, int),
         glob_t* result) noexcept {
  return shim::look_up(REAL(glob), pattern, flags, on_error, result);
}
int glob64(const char* pattern, int flags, int (*on_error)(const char*, int),
           glob64_t* result) noexcept {
  return shim::look_up(REAL(glob), pattern, flags, on_error, reinterpret_cast<glob_t*>(result));
}

}  // extern "C"
#pragma GCC visibility pop
