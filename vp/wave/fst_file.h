#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <vp/file.h>

#include "fst_format.h"

namespace vp::fst {

/// Undoes zlib's, gzip's ('Z'), FastLZ's ('F') or LZ4's ('4') packing. False unless exactly `size`
/// bytes come out. Never reads or writes beyond either side.
bool unpack(char method, std::string_view packed, char* to, std::size_t size);

/// The most that `packed` bytes can become, whatever a file says. Bounds the memory of a reader.
std::uint64_t most_unpacked(char method, std::uint64_t packed);

/// The bytes of an FST, and what its blocks are. Throws InputError with the byte for whatever is
/// not as the format wants it.
class File {
 public:
  struct Section {
    Block type;
    std::uint64_t at;    ///< of its content
    std::uint64_t size;  ///< of its content
    std::uint64_t end() const { return at + size; }
  };

  explicit File(const std::filesystem::path& file);

  [[noreturn]] void fail(const std::string& problem, std::uint64_t at) const;
  /// Bytes that must be there.
  std::string read(std::uint64_t at, std::uint64_t size) const;
  void read(std::uint64_t at, char* to, std::size_t size) const;
  /// Bytes `at` that are `unpacked` ones in zlib, or those themselves if both numbers are equal.
  std::string read_packed(std::uint64_t at, std::uint64_t packed, std::uint64_t unpacked) const;

  const std::vector<Section>& changes() const { return changes_; }
  /// The raw hierarchy: a sequence of entries. From the file, or of one that its writer did not
  /// finish from the file beside it.
  std::string hierarchy() const;
  /// Sizes of the handles; empty in a file that was not finished.
  std::vector<std::uint32_t> geometry() const;

  /// Power of ten of a second.
  int timescale() const { return timescale_; }
  std::uint64_t end_time() const { return end_time_; }
  bool is_finished() const { return finished_; }
  /// Reals are in the other byte order than this machine's.
  bool is_swapped() const { return swapped_; }
  std::uint64_t size() const { return size_; }

 private:
  void unpack_whole();
  void read_blocks();
  void read_header();
  std::string lz4(const Section& section) const;

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::filesystem::path path_;
  InputFile input_;
  std::unique_ptr<std::FILE, Close> unpacked_;  ///< of a file that is packed as a whole
  int descriptor_;
  std::uint64_t size_;
  std::vector<Section> changes_;
  Section hierarchy_{}, geometry_{};
  int timescale_ = 0;
  std::uint64_t end_time_ = 0;
  bool finished_ = true, swapped_ = false;
};

/// Reads the numbers of a part of a file, and nothing beyond it.
class Cursor {
 public:
  /// `at`: where the bytes are in the file, for messages.
  Cursor(const File& file, std::string_view bytes, std::uint64_t at, const char* what)
      : file_(file), bytes_(bytes), begin_(at), what_(what) {}

  bool at_end() const { return next_ == bytes_.size(); }
  std::uint64_t offset() const { return begin_ + next_; }
  std::size_t consumed() const { return next_; }
  std::uint8_t byte() {
    if (at_end()) fail("ends too early");
    return static_cast<std::uint8_t>(bytes_[next_++]);
  }
  std::uint8_t peek() const { return static_cast<std::uint8_t>(bytes_[next_]); }
  std::uint64_t u64() {
    std::uint64_t value = 0;
    for (int i = 0; i < 8; ++i) value = value << 8 | byte();
    return value;
  }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
      const std::uint64_t next = byte();
      if (shift > 63) fail("holds a number of more than 64 bits");
      value |= (next & 0x7f) << shift;
      if (next < 0x80) return value;
    }
  }
  std::int64_t signed_varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0;;) {
      const std::uint64_t next = byte();
      if (shift > 63) fail("holds a number of more than 64 bits");
      value |= (next & 0x7f) << shift;
      shift += 7;
      if (next >= 0x80) continue;
      if (shift < 64 && (next & 0x40) != 0) value |= ~std::uint64_t{0} << shift;
      return static_cast<std::int64_t>(value);
    }
  }
  /// Up to a zero byte, which is passed.
  std::string_view text() {
    const auto end = bytes_.find('\0', next_);
    if (end == std::string_view::npos) fail("ends in the middle of a name");
    const auto found = bytes_.substr(next_, end - next_);
    next_ = end + 1;
    return found;
  }
  [[noreturn]] void fail(const char* problem) const {
    file_.fail(std::string("the ") + what_ + " " + problem + ": the file is corrupt", offset());
  }

 private:
  const File& file_;
  std::string_view bytes_;
  std::uint64_t begin_;
  const char* what_;
  std::size_t next_ = 0;
};

}  // namespace vp::fst
