#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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
  /// False: the bytes come once, from front to back. Ask when some were read.
  virtual bool can_seek() const { return false; }
  /// Reads on from there.
  virtual void seek(std::uint64_t /*offset*/) {}
};

/// The bytes of a file as they are. Throws InputError.
std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& file);

/// White space, as a VCD has it between words.
constexpr bool is_blank(char c) {
  return static_cast<unsigned char>(c) <= ' ';
}

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

/// A window that slides over the bytes of a VCD.
class VcdWindow {
 public:
  static constexpr std::size_t size = 1 << 18;

  explicit VcdWindow(std::unique_ptr<ByteSource> source)
      : source_(std::move(source)), buffer_(size + padding) {
    cursor = safe_ = end_ = buffer_.data();
    counted_ = cursor;
  }

  /// What was not used up yet begins here. Behind the end are blanks.
  const char* cursor;

  /// Words that begin before it are whole: white space follows them.
  const char* safe() const { return safe_; }
  /// Of the bytes that were read so far.
  const char* end() const { return end_; }

  /// Reads on; the bytes from `from` on stay, and `cursor` is where they begin then. False: there
  /// is no more to be had.
  bool refill(const char* from);
  /// The file is over: the word that ends with it counts as whole.
  void close_last_word() { safe_ = end_; }

  bool can_seek() const { return source_->can_seek(); }
  /// Reads on at that byte of the file, in its line `line`.
  void seek(std::uint64_t offset, std::uint64_t line);

  /// A word, or white space, that is longer than the window.
  bool too_long() const { return too_long_; }
  /// Of the byte `at` in the window: its line, and its place in the file. Lines are asked for from
  /// front to back.
  std::uint64_t line(const char* at) const;
  std::uint64_t offset(const char* at) const {
    return read_ - static_cast<std::uint64_t>(end_ - at);
  }
  std::uint64_t bytes() const { return read_; }

 private:
  static constexpr std::size_t padding = 16;
  /// Read first behind a seek: a change or two are often all that is wanted.
  static constexpr std::size_t smallest_chunk = 1 << 12;

  std::unique_ptr<ByteSource> source_;
  std::vector<char> buffer_;
  const char* safe_;
  char* end_;
  std::size_t chunk_ = size;  ///< read at once
  bool too_long_ = false;
  // The line of a place that was asked for, to count on from there.
  mutable const char* counted_;
  mutable std::uint64_t lines_ = 1;
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
      // A name of another tool may begin or end with a dot.
      const auto next = [&rest] { return rest.find('.', 1); };
      for (auto dot = next(); dot < rest.size() - 1; dot = next()) {
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
  bool valid = !path.empty();
  // Blanks are in names of other tools, and bytes of UTF-8.
  for (const char c : path) valid = valid && static_cast<unsigned char>(c) >= ' ' && c != '\x7f';
  const std::string words = "." + std::string(path) + ".";
  for (const char* bad : {". ", " .", "  ", " $end ", ".$end ", " $end.", ".$end."})
    valid = valid && words.find(bad) == std::string::npos;
  if (!valid) throw std::invalid_argument("not a name for a trace: '" + std::string(path) + "'");
  if (kind == WaveWriter::Kind::real) width = 64;
  if (kind == WaveWriter::Kind::text || kind == WaveWriter::Kind::event) width = 1;
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
