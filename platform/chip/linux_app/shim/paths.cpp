// Where paths lead.
#include "paths.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include "client.h"

namespace shim {

namespace {

/// Of /dev/mem: Documentation/admin-guide/devices.txt of Linux; the others are from its range for
/// local use.
constexpr unsigned memory_major = 1, memory_minor = 1, uio_major = 241, buffer_major = 242;
constexpr unsigned most_links = 40;

/// `begin` and a number.
bool is_numbered(const char* path, const char* begin) {
  if (!begins(path, begin)) return false;
  const char* const number = path + ::strlen(begin);
  return number[0] != '\0' && number[::strspn(number, "0123456789")] == '\0';
}

bool is_in(const char* path, const char* folder) {
  const std::size_t length = ::strlen(folder);
  return begins(path, folder) && (path[length] == '\0' || path[length] == '/');
}

/// What the folder has.
bool is_led(const char* name) {
  return device_at(name) != 0 || is_in(name, "/sys/class/uio") ||
         is_in(name, "/sys/class/u-dma-buf") || is_in(name, "/sys/class/udmabuf") ||
         is_in(name, "/sys/firmware/devicetree") || is_in(name, "/proc/device-tree");
}

/// What the folder has for those that list it.
bool is_listed(const char* name) {
  return ::strcmp(name, "/dev") == 0 || ::strcmp(name, "/sys/class") == 0;
}

/// Its length; 0: no link, or too long. Not by readlink(), which is ours.
std::size_t read_link(const char* path, char* target) {
  const long length = REAL(syscall)(SYS_readlink, path, target, longest_path - 1);
  if (length <= 0 || length == longest_path - 1) return 0;
  target[length] = '\0';
  return static_cast<std::size_t>(length);
}

}  // namespace

bool begins(const char* text, const char* with) {
  return ::strncmp(text, with, ::strlen(with)) == 0;
}

bool is_of_buffers(const char* path) {
  return begins(path, "/sys/class/u-dma-buf/") || begins(path, "/sys/class/udmabuf/");
}

unsigned long number_in(const char* path) {
  const char* const digits = ::strpbrk(path, "0123456789");
  return digits ? ::strtoul(digits, nullptr, 10) : 0;
}

dev_t device_at(const char* name) {
  if (!begins(name, "/dev/") || ::strchr(name + ::strlen("/dev/"), '/')) return 0;
  if (::strcmp(name, "/dev/mem") == 0) return ::makedev(memory_major, memory_minor);
  if (!is_numbered(name, "/dev/uio") && !is_numbered(name, "/dev/udmabuf")) return 0;
  return ::makedev(begins(name, "/dev/uio") ? uio_major : buffer_major,
                   static_cast<unsigned>(number_in(name)));
}

char* as_seen(char* path) {
  const char* const tree = folder();
  if (!path || !tree || !is_application() || !is_in(path, tree)) return path;
  const std::size_t length = ::strlen(tree);
  if (path[length] == '\0') return static_cast<char*>(::memcpy(path, "/", 2));
  ::memmove(path, path + length, ::strlen(path + length) + 1);
  return path;
}

Path::Path(const char* path, int folder, Use use) : path_(path) {
  const char* const tree = shim::folder();
  if (!tree || !path || path[0] == '\0') return;
  const int error = errno;
  resolve(path, folder, use);
  errno = error;
  is_device_ = device_at(name_) != 0;
  if (!is_application()) {
    if (is_device_)
      ::dprintf(STDERR_FILENO,
                "markervp: '%s', which the application started, uses %s: only the application "
                "itself reaches the platform\n",
                program_invocation_short_name, name_);
    return;
  }
  if (!is_led(name_) && (use != Use::list || !is_listed(name_))) {
    if (is_moved_) path_ = name_[0] != '\0' ? name_ : "/";
    return;
  }
  if (::snprintf(led_, sizeof led_, "%s%s", tree, name_) < static_cast<int>(sizeof led_))
    path_ = led_;
}

/// Of a path that is too long or loops the name is "".
void Path::resolve(const char* path, int folder, Use use) {
  char rest[longest_path];
  name_[0] = '\0';
  const std::size_t given = ::strlen(path);
  if (given >= sizeof rest || (path[0] != '/' && !begin_at(folder))) return;
  ::memcpy(rest, path, given + 1);
  unsigned links = 0;
  while (true) {
    const char* const part = rest + ::strspn(rest, "/");
    const std::size_t length = ::strcspn(part, "/");
    if (length == 0) return;
    const char* const behind = part + length;
    const bool is_last = behind[::strspn(behind, "/")] == '\0';
    if (links > most_links || !append(part, length)) {
      name_[0] = '\0';
      return;
    }
    ::memmove(rest, behind, ::strlen(behind) + 1);
    if ((!is_last || use != Use::link) && follow_link(rest)) ++links;
  }
}

/// A relative path begins at a folder; false: at none that has a name.
bool Path::begin_at(int folder) {
  char link[64];
  ::snprintf(link, sizeof link, "/proc/self/fd/%d", folder);
  const bool known = folder == AT_FDCWD ? REAL(syscall)(SYS_getcwd, name_, sizeof name_) > 0
                                        : read_link(link, name_) != 0;
  if (!known || name_[0] != '/') {
    name_[0] = '\0';
    return false;
  }
  if (name_[1] == '\0') name_[0] = '\0';
  if (!is_application() || !is_in(name_, shim::folder())) return true;
  is_moved_ = true;
  as_seen(name_);
  if (name_[1] == '\0') name_[0] = '\0';
  return true;
}

/// Goes one step down, or up with "..".
bool Path::append(const char* part, std::size_t length) {
  if (length == 1 && part[0] == '.') return true;
  if (length == 2 && part[0] == '.' && part[1] == '.') {
    if (char* const last = ::strrchr(name_, '/')) *last = '\0';
    return true;
  }
  const std::size_t before = ::strlen(name_);
  if (before + 1 + length >= sizeof name_) return false;
  name_[before] = '/';
  ::memcpy(name_ + before + 1, part, length);
  name_[before + 1 + length] = '\0';
  // The folder itself, by its own name, is the root that the application sees.
  if (::strcmp(name_, shim::folder()) == 0) {
    name_[0] = '\0';
    is_moved_ = true;
  }
  return true;
}

/// Puts what a link says in front of the rest.
bool Path::follow_link(char* rest) {
  char target[longest_path], real[longest_path];
  const bool led = is_application() && is_led(name_);
  if (::snprintf(real, sizeof real, "%s%s", led ? shim::folder() : "", name_) >=
      static_cast<int>(sizeof real))
    return false;
  const std::size_t length = read_link(real, target);
  const std::size_t more = ::strlen(rest);
  if (length == 0 || length + more + 1 >= longest_path) return false;
  ::memmove(rest + length, rest, more + 1);
  ::memcpy(rest, target, length);
  if (target[0] == '/') {
    name_[0] = '\0';
  } else if (char* const last = ::strrchr(name_, '/')) {
    *last = '\0';
  }
  return true;
}

}  // namespace shim
