#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vp {

/// Writes a value change dump (IEEE 1364, 18.2), fast, and with nothing in it that depends on the
/// host or the date: the same changes give the same bytes.
///
/// Everything goes into "FILE.tmp" first; close() renames it. A FILE that exists and is no regular
/// file (a pipe, /dev/null) is written directly. Timescale: 1 ps.
///
/// Order of calls: add() all variables, begin(), then set_time() and change(), close().
class VcdWriter {
 public:
  using Id = std::uint32_t;
  enum class Kind : std::uint8_t { wire, reg, real };

  /// Opens the file. Throws InputError if it cannot be written.
  explicit VcdWriter(const std::filesystem::path& file);
  /// Without close(): keeps what was written as a valid file that ends with the comment
  /// "incomplete", or removes it if there is no value in it yet.
  ~VcdWriter();
  VcdWriter(const VcdWriter&) = delete;
  VcdWriter& operator=(const VcdWriter&) = delete;

  /// Declares a variable; ids count from 0. `path`: levels separated by '.', the last one is the
  /// variable, the others are scopes. `width` 1 to 64 (ignored for real).
  /// Throws std::invalid_argument for a path that a VCD cannot hold.
  Id add(std::string_view path, Kind kind, unsigned width);

  /// Writes the header and all values standing at `ps`, one per variable: right-aligned bits, or
  /// the pattern of a double.
  void begin(std::uint64_t ps, const std::vector<std::uint64_t>& values);
  bool begun() const { return begun_; }

  /// Time of the following changes; not before the time of those before.
  void set_time(std::uint64_t ps) {
    stamp_due_ = stamp_due_ || ps != time_ps_;
    time_ps_ = ps;
  }
  /// Writes nothing if the value is the last one.
  void change(Id id, std::uint64_t bits) {
    Variable& variable = variables_[id];
    bits &= variable.mask;
    if (bits == variable.last) return;
    variable.last = bits;
    if (stamp_due_) write_stamp();
    write_value(variable);
  }

  /// True after a failed write, for example on a full disk: later changes are lost, close() throws.
  bool failed() const { return error_ != 0; }

  /// Ends the file at `end_ps` (the last values stand until then) and gives it its name. Throws
  /// InputError if anything could not be written. Then, and without begin(), no file is left.
  void close(std::uint64_t end_ps);

 private:
  struct Variable {
    std::uint64_t last;
    std::uint64_t mask;
    char suffix[8];  ///< identifier code and line end, after a blank if it is a vector or real
    std::uint8_t suffix_length;
    bool scalar;
    bool real;
  };
  struct Declaration {
    std::string path;
    Kind kind;
    unsigned width;
  };
  struct Scope;

  void write_header();
  void write_scope(const Scope& scope);
  void write_declaration(const Declaration& declaration, std::string_view leaf, Id id);
  void write_stamp();
  void write_value(const Variable& variable) {
    if (cursor_ >= limit_) flush();
    if (variable.scalar) {
      *cursor_ = static_cast<char>('0' + variable.last);
      write_suffix(variable, cursor_ + 1);
    } else {
      write_number(variable);
    }
  }
  void write_suffix(const Variable& variable, char* at) {
    std::memcpy(at, variable.suffix, sizeof variable.suffix);
    cursor_ = at + variable.suffix_length;
  }
  void write_number(const Variable& variable);
  void write_text(std::string_view text);
  void flush();
  void finish();
  void remove() noexcept;

  std::filesystem::path file_;
  std::filesystem::path written_;  ///< FILE.tmp, or FILE if written directly
  int descriptor_ = -1;
  int error_ = 0;  ///< errno of the first failed write
  bool begun_ = false;
  bool stamp_due_ = false;
  std::uint64_t time_ps_ = 0;
  std::vector<Declaration> declarations_;
  std::vector<Variable> variables_;
  std::vector<char> buffer_;
  char* cursor_;
  char* limit_;
};

}  // namespace vp
