#pragma once

#include <fcntl.h>
#include <sys/types.h>

#include <cstddef>

namespace shim {

/// Longer paths lead to no device.
constexpr std::size_t longest_path = 1024;

/// Where a path leads, however it is written: relative, by a descriptor, through links. The
/// platform has a folder with the devices and their sysfs.
class Path {
 public:
  enum class Use {
    follow,  ///< the file at the end of its links
    link,    ///< its last part may be a link that is meant itself
    list,    ///< as follow; of /dev and /sys/class what the platform shows there
  };
  explicit Path(const char* path, int folder = AT_FDCWD, Use use = Use::follow);
  /// To be opened, of flags as those of open().
  static Use use_of(int flags) { return (flags & O_NOFOLLOW) != 0 ? Use::link : Use::list; }

  /// What the C library is to be called with.
  operator const char*() const { return path_; }
  /// It is in the folder.
  bool is_ours() const { return path_ == led_; }
  bool is_device() const { return is_device_; }
  /// Absolute, without links: "/dev/uio0". Of ours, and of devices.
  const char* name() const { return name_; }

 private:
  void resolve(const char* path, int folder, Use use);
  bool begin_at(int folder);
  bool append(const char* part, std::size_t length);
  bool follow_link(char* rest);

  const char* path_;
  char name_[longest_path];
  char led_[longest_path];
  bool is_device_ = false;
  bool is_moved_ = false;  ///< it begins in the folder, and may lead out of it
};

bool begins(const char* text, const char* with);
bool is_of_buffers(const char* path);
/// The number in the name of a device or its folder; 0: none.
unsigned long number_in(const char* path);

/// The device number that stat() reports; 0 if the name is not that of a device.
dev_t device_at(const char* name);

/// A path of the folder becomes what the application sees; null stays null.
char* as_seen(char* path);

}  // namespace shim
