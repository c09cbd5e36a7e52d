#include <libdeflate.h>
#include <lz4.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include "fst_file.h"

namespace vp::fst {

namespace {

/// zlib's streams and gzip's. Two to three times as fast as zlib itself.
bool inflated(std::string_view packed, char* to, std::size_t size) {
  struct Free {
    void operator()(libdeflate_decompressor* tables) const { libdeflate_free_decompressor(tables); }
  };
  thread_local const std::unique_ptr<libdeflate_decompressor, Free> tables(
      libdeflate_alloc_decompressor());
  if (!tables) throw std::bad_alloc();
  const bool is_gzip = packed.substr(0, 2) == "\x1f\x8b";
  const auto decompress = is_gzip ? libdeflate_gzip_decompress : libdeflate_zlib_decompress;
  // Without a place for the number of bytes that came out it must be `size`.
  return decompress(tables.get(), packed.data(), packed.size(), to, size, nullptr) ==
         LIBDEFLATE_SUCCESS;
}

// FastLZ, levels 1 and 2. A stream is a sequence of literal runs (control byte below 32: so many
// bytes and one) and matches (three bits length, five bits the high part of the distance). The
// level is in the first control byte, which is always a run.
class FastLz {
 public:
  FastLz(std::string_view packed, char* to, std::size_t size)
      : next_(packed.data()), end_(next_ + packed.size()), begin_(to), to_(to), limit_(to + size) {}

  bool run() {
    if (next_ == end_) return to_ == limit_;
    const unsigned level = (static_cast<unsigned char>(*next_) >> 5) + 1;
    if (level > 2) return false;
    bool is_first = true;
    while (good_ && next_ != end_ && to_ != limit_) {
      unsigned control = byte();
      if (std::exchange(is_first, false)) control &= 31;
      if (control < 32) {
        literal(control + 1);
      } else {
        match(control, level);
      }
    }
    return good_ && to_ == limit_;
  }

 private:
  unsigned byte() {
    good_ = good_ && next_ != end_;
    return good_ ? static_cast<unsigned char>(*next_++) : 0;
  }
  void literal(std::size_t count) {
    good_ = good_ && count <= static_cast<std::size_t>(end_ - next_) &&
            count <= static_cast<std::size_t>(limit_ - to_);
    if (!good_) return;
    to_ = std::copy_n(next_, count, to_);
    next_ += count;
  }
  void match(unsigned control, unsigned level) {
    constexpr std::size_t longest_short = 7, shortest = 2, far = 31u << 8, far_base = 8191;
    std::size_t length = control >> 5;
    std::size_t distance = (control & 31) << 8;
    if (length == longest_short) {
      unsigned more = byte();
      length += more;
      while (level == 2 && more == 255 && good_) length += more = byte();
    }
    const unsigned low = byte();
    if (level == 2 && low == 255 && distance == far) {
      distance = byte() << 8;
      distance = (distance | byte()) + far_base;
    } else {
      distance += low;
    }
    length += shortest;
    ++distance;
    good_ = good_ && distance <= static_cast<std::size_t>(to_ - begin_) &&
            length <= static_cast<std::size_t>(limit_ - to_);
    // Byte by byte: a match may overlap what it makes.
    for (; good_ && length > 0; --length, ++to_) *to_ = to_[-static_cast<std::ptrdiff_t>(distance)];
  }

  const char* next_;
  const char* end_;
  char* begin_;
  char* to_;
  char* limit_;
  bool good_ = true;
};

}  // namespace

bool unpack(char method, std::string_view packed, char* to, std::size_t size) {
  constexpr std::size_t most = LZ4_MAX_INPUT_SIZE;
  if (method == 'F') return FastLz(packed, to, size).run();
  if (method != '4') return inflated(packed, to, size);
  if (packed.size() > most || size > most) return false;
  return LZ4_decompress_safe(packed.data(), to, static_cast<int>(packed.size()),
                             static_cast<int>(size)) == static_cast<int>(size);
}

std::uint64_t most_unpacked(char method, std::uint64_t packed) {
  constexpr std::uint64_t zlib_ratio = 1032, byte_ratio = 256, head = 64;
  constexpr std::uint64_t largest = std::uint64_t{1} << 30;
  return std::min(packed * (method == 'F' || method == '4' ? byte_ratio : zlib_ratio) + head,
                  largest);
}

}  // namespace vp::fst
