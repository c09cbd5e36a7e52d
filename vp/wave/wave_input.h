#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vp/wave_writer.h>

namespace vp {

/// Where the bytes of a VCD come from.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Up to `size` bytes; 0 at the end. Throws InputError.
  virtual std::size_t read(char* to, std::size_t size) = 0;
};

constexpr std::array<std::array<char, 8>, 256> make_digits_of_byte() {
  std::array<std::array<char, 8>, 256> digits{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    for (unsigned bit = 0; bit < 8; ++bit) digits[byte][bit] = (byte >> (7 - bit) & 1) ? '1' : '0';
  }
  return digits;
}
/// A byte in binary.
inline constexpr auto digits_of_byte = make_digits_of_byte();

/// The bits that change_digits() means, or the pattern of a double. None: some digit is no bit, or
/// there are more than 64.
std::optional<std::uint64_t> bits_of_digits(std::string_view digits, bool is_real);

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

struct WaveDeclaration {
  std::string path;
  WaveWriter::Kind kind;
  unsigned width;
};

/// A level of the hierarchy, in the order of declaration.
struct WaveScope {
  std::string name;
  std::vector<std::pair<std::string, WaveWriter::Id>> variables;
  std::vector<std::unique_ptr<WaveScope>> children;

  /// All declarations below one root without name.
  static WaveScope of(const std::vector<WaveDeclaration>& declarations) {
    WaveScope root;
    for (std::size_t id = 0; id < declarations.size(); ++id) {
      std::string_view rest = declarations[id].path;
      WaveScope* scope = &root;
      for (auto dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
        scope = &scope->child(rest.substr(0, dot));
        rest.remove_prefix(dot + 1);
      }
      scope->variables.emplace_back(rest, static_cast<WaveWriter::Id>(id));
    }
    return root;
  }

  WaveScope& child(std::string_view child_name) {
    for (auto it = children.rbegin(); it != children.rend(); ++it) {
      if ((*it)->name == child_name) return **it;
    }
    children.push_back(std::make_unique<WaveScope>());
    children.back()->name = child_name;
    return *children.back();
  }
};

/// The declaration, checked. Throws std::invalid_argument.
inline WaveDeclaration checked_declaration(std::string_view path, WaveWriter::Kind kind,
                                           unsigned width) {
  bool valid = !path.empty() && path.front() != '.' && path.back() != '.' &&
               path.find("..") == std::string_view::npos;
  for (const char c : path) valid = valid && c > ' ' && c <= '~';
  if (!valid) throw std::invalid_argument("not a name for a trace: '" + std::string(path) + "'");
  if (kind == WaveWriter::Kind::real) width = 64;
  if (kind == WaveWriter::Kind::text) width = 1;
  if (width < 1 || width > WaveWriter::widest) {
    throw std::invalid_argument("width of '" + std::string(path) + "' is not 1 to " +
                                std::to_string(WaveWriter::widest) + " bits");
  }
  return {std::string(path), kind, width};
}

/// Writes GTKWave's FST: some 30 times smaller than a VCD. Throws OutputError if the file cannot be
/// written.
std::unique_ptr<WaveWriter> open_fst_writer(const std::filesystem::path& file);

}  // namespace vp
