#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

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

/// Checks the chain of blocks of an FST, and reads it in a process of its own: fstapi trusts its
/// input, and a corrupt file must not take the program down.
std::unique_ptr<ByteSource> open_fst_source(const std::filesystem::path& file);

/// Words between white space, out of a window that slides over the file.
class VcdTokens {
 public:
  static constexpr std::size_t window = 1 << 18;

  explicit VcdTokens(std::unique_ptr<ByteSource> source)
      : source_(std::move(source)), buffer_(window + 1) {
    cursor_ = end_ = buffer_.data();
    *end_ = ' ';
  }

  /// The next word, empty at the end. Valid until the next call, or the one after keep().
  std::string_view next() {
    for (const std::uint64_t begin = offset();;) {
      while (static_cast<unsigned char>(*cursor_) <= ' ' && cursor_ != end_) {
        line_ += *cursor_ == '\n';
        ++cursor_;
      }
      if (cursor_ != end_) break;
      // A file of zeros, which count as white space here, may have no end.
      too_long_ = offset() - begin > window;
      if (too_long_ || !refill(cursor_)) return {};
    }
    char* from = cursor_;
    char* to = cursor_ + 1;
    for (;;) {
      while (static_cast<unsigned char>(*to) > ' ') ++to;
      if (to != end_) break;
      const std::size_t length = static_cast<std::size_t>(to - from);
      cut_ = !refill(from);  // the end of the file, and no white space before it
      from = cursor_;
      to = from + length;
      if (cut_) break;
    }
    cursor_ = to;
    return {from, static_cast<std::size_t>(to - from)};
  }

  /// The word just read stays valid over the next call, which may move it.
  void keep(std::string_view word) { kept_ = const_cast<char*>(word.data()); }
  std::string_view kept(std::size_t length) {
    const char* from = std::exchange(kept_, nullptr);
    return {from, length};
  }

  /// The word just read ends where the file ends; it, or the white space before it, is longer than
  /// the window.
  bool cut() const { return cut_; }
  bool too_long() const { return too_long_; }
  std::uint64_t line() const { return line_; }
  /// Of the byte after the word just read.
  std::uint64_t offset() const { return read_ - static_cast<std::uint64_t>(end_ - cursor_); }
  std::uint64_t bytes() const { return read_; }
  bool has_lines() const { return source_->has_lines(); }

 private:
  /// Moves what is still needed, from `word` or the word kept before it, to the front, and reads
  /// on behind it. `cursor_` is where the word is then. False at the end of the file.
  bool refill(char* word) {
    char* first = kept_ ? kept_ : word;
    const auto held = static_cast<std::size_t>(end_ - first);
    if (held == window) {
      too_long_ = true;
      return false;
    }
    std::memmove(buffer_.data(), first, held);
    cursor_ = buffer_.data() + (word - first);
    if (kept_) kept_ = buffer_.data();
    end_ = buffer_.data() + held;
    const std::size_t count = source_->read(end_, window - held);
    read_ += count;
    end_ += count;
    *end_ = ' ';
    return count != 0;
  }

  std::unique_ptr<ByteSource> source_;
  std::vector<char> buffer_;
  char* cursor_;
  char* end_;
  char* kept_ = nullptr;
  bool cut_ = false;
  bool too_long_ = false;
  std::uint64_t line_ = 1;
  std::uint64_t read_ = 0;
};

}  // namespace vp
