#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace vp {

/// Packs bytes with gzip as they come. The result depends on the bytes alone: it has no name and no
/// date in it.
class GzipPacker {
 public:
  GzipPacker();
  ~GzipPacker();
  GzipPacker(const GzipPacker&) = delete;
  GzipPacker& operator=(const GzipPacker&) = delete;

  /// What is packed so far of these and earlier bytes, and was not handed over; valid until the
  /// next call.
  std::string_view pack(std::string_view bytes) { return run(bytes, false); }
  /// The rest.
  std::string_view finish() { return run({}, true); }

 private:
  std::string_view run(std::string_view bytes, bool last);

  struct Stream;
  std::unique_ptr<Stream> stream_;
  std::string packed_;
};

}  // namespace vp
