#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

namespace vp {

/// Where the bytes of a VCD come from.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Up to `size` bytes; 0 at the end. Throws InputError.
  virtual std::size_t read(char* to, std::size_t size) = 0;
  /// True if lines of the VCD are lines of the user's file.
  virtual bool has_lines() const { return true; }
};

/// Opens a trace. An FST is turned into a VCD on the way. Throws InputError.
std::unique_ptr<ByteSource> open_byte_source(const std::filesystem::path& file);

/// Checks the chain of blocks of an FST, and reads it in a process of its own: fstapi trusts its
/// input, and a corrupt file must not take the program down.
std::unique_ptr<ByteSource> open_fst_source(const std::filesystem::path& file);

}  // namespace vp
