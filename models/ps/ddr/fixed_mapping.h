#pragma once

#include <cstdint>
#include <string>

namespace ps {

/// Zeroed host memory at chosen host addresses, for as long as the object lives. Pages take memory
/// when first touched.
class FixedMapping {
 public:
  /// `first` and `size` are multiples of 4096. Throws vp::InputError that names `what` needs the
  /// memory, and who occupies the range.
  FixedMapping(const std::string& what, std::uint64_t first, std::uint64_t size);
  ~FixedMapping();
  FixedMapping(const FixedMapping&) = delete;
  FixedMapping& operator=(const FixedMapping&) = delete;

  unsigned char* data() const { return data_; }
  std::uint64_t size() const { return size_; }
  /// Gives all pages back: the memory reads 0 again.
  void clear();

 private:
  unsigned char* data_;
  std::uint64_t size_;
};

}  // namespace ps
