#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ps {

/// The writable static memory of a loaded shared object (.data, .bss, without what the loader made
/// read-only), as it stands when the object is constructed: right after loading, constructors of
/// static objects included.
///
/// Heap memory that static objects own is not part of it.
class StaticImage {
 public:
  /// `handle` from dlopen(). Throws std::runtime_error if the object cannot be found among the
  /// loaded ones.
  explicit StaticImage(void* handle);

  /// Puts everything back as it was.
  void restore() const;
  /// Bytes kept.
  std::size_t size() const;

 private:
  struct Range {
    unsigned char* address;
    std::vector<unsigned char> bytes;
  };
  std::vector<Range> ranges_;
};

}  // namespace ps
