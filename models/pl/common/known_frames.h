#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <unordered_map>
#include <vector>

namespace pl {

/// Up to so many bytes of frames a function of a frame remembers what it gave for them; 0, the
/// default, for none. Points of a sweep show the same pictures again and again, other runs do not.
inline std::size_t known_frame_bytes = 0;

/// What a function of a frame gave, found by the frame's content. One for each function.
template <class Result>
class KnownFrames {
 public:
  /// What find() gives for these bytes with this parameter, now or earlier.
  template <class Find>
  Result result(const std::uint8_t* bytes, std::size_t size, std::uint64_t parameter,
                const Find& find) {
    if (size > known_frame_bytes) return find();
    const std::uint64_t mark = mark_of(bytes, size) ^ parameter;
    const auto alike = frames_.equal_range(mark);
    for (auto frame = alike.first; frame != alike.second; ++frame) {
      const Frame& known = frame->second;
      if (known.parameter == parameter && known.bytes.size() == size &&
          std::memcmp(known.bytes.data(), bytes, size) == 0)
        return known.result;
    }
    if (bytes_ + size > known_frame_bytes) {
      frames_.clear();
      bytes_ = 0;
    }
    bytes_ += size;
    return frames_.insert({mark, {{bytes, bytes + size}, parameter, find()}})->second.result;
  }

 private:
  struct Frame {
    std::vector<std::uint8_t> bytes;
    std::uint64_t parameter;
    Result result;
  };

  /// Of some of the bytes: it tells most frames from each other.
  static std::uint64_t mark_of(const std::uint8_t* bytes, std::size_t size) {
    std::uint64_t mark = size, word = 0;
    const std::size_t step = std::max(sizeof word, size / 512);
    for (std::size_t at = 0; at + sizeof word <= size; at += step) {
      std::memcpy(&word, bytes + at, sizeof word);
      mark = (mark ^ word) * 0x9e3779b97f4a7c15u;
      mark ^= mark >> 32;
    }
    return mark;
  }

  std::unordered_multimap<std::uint64_t, Frame> frames_;
  std::size_t bytes_ = 0;
};

}  // namespace pl
