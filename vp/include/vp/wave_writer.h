#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <vp/file.h>

namespace vp {

/// Writes the values of variables over time into a file: VCD or FST.
///
/// Order of calls: add() all variables, begin(), then set_time(), change() and change_text(),
/// close(). Times are in ps, unless count_femtoseconds() was called. The file is an OutputFile: it
/// has its name when close() returns.
class WaveWriter {
 public:
  using Id = std::uint32_t;
  enum class Kind : std::uint8_t { wire, reg, real, text, event };
  using WrittenValues = std::vector<std::optional<std::string>>;
  static constexpr unsigned widest = 65536;  ///< bits; more than 64 for change_digits() only

  virtual ~WaveWriter() = default;

  /// Declares a variable; ids count from 0. `path`: levels separated by '.', the last one is the
  /// variable, the others are scopes. `width` 1 to `widest` (ignored for real and text).
  /// Throws std::invalid_argument for a path that a file cannot hold.
  virtual Id add(std::string_view path, Kind kind, unsigned width) = 0;

  /// From begin() on, times are in fs: for traces that have several instants in one ps.
  void count_femtoseconds() { timescale_ps_ = false; }

  /// All variables are there: writes the header and all values standing at `ps`, one per variable:
  /// right-aligned bits, or the pattern of a double; texts are empty.
  virtual void begin(std::uint64_t ps, const std::vector<std::uint64_t>& values) = 0;
  /// Like begin(), with values as change_digits() and change_text() take them. A variable without
  /// one has no value before its first change.
  virtual void begin_written(std::uint64_t ps, const WrittenValues& values) = 0;
  /// A value was written already.
  virtual bool begun() const = 0;

  /// Time of the following changes; not before the time of those before.
  virtual void set_time(std::uint64_t ps) = 0;
  /// Writes nothing if the value is the last one.
  virtual void change(Id id, std::uint64_t bits) = 0;
  /// A value as digits 0 1 x z u w l h -, the most significant first. Capital letters become small
  /// ones: GTKWave's vcd2fst drops values with capitals.
  virtual void change_digits(Id id, std::string_view digits) = 0;
  /// The new value of a text, written even if it is the last one: an access may repeat.
  virtual void change_text(Id id, std::string_view text) = 0;

  /// From now on nothing is known: every variable becomes x (a real NaN, a text empty).
  virtual void pause() = 0;
  /// The end of a pause, at the time set: all values, as for begin().
  virtual void resume(const std::vector<std::uint64_t>& values) = 0;

  /// True after a failed write, for example on a full disk: later changes are lost, close() throws.
  virtual bool failed() const = 0;

  /// Ends the file at `end_ps` (the last values stand until then) and gives it its name. Throws
  /// OutputError if anything could not be written. Then, and without begin(), no file is left.
  virtual void close(std::uint64_t end_ps) = 0;

 protected:
  bool timescale_ps_ = true;  ///< else fs
};

/// A writer for the format that the name's extension tells: .vcd, .vcd.gz or .fst; a pipe or device
/// takes a VCD. Opens the file. Throws OutputError if it cannot be written, InputError for another
/// extension.
std::unique_ptr<WaveWriter> open_wave_writer(const std::filesystem::path& file);
/// The name has one of these extensions.
bool is_wave_file_name(const std::filesystem::path& file);

class GzipPacker;
struct WaveDeclaration;
struct WaveScope;

/// Writes a value change dump (IEEE 1364, 18.2), fast, and with nothing in it that depends on the
/// host or the date: the same changes give the same bytes.
///
/// Texts are written as GTKWave reads them ("$var string", "sTEXT id"), with blanks and backslashes
/// as octal escapes. A file called .vcd.gz is packed with gzip.
class VcdWriter final : public WaveWriter {
 public:
  /// Opens the file. Throws OutputError if it cannot be written.
  explicit VcdWriter(const std::filesystem::path& file);
  /// Without close(): keeps what was written as a valid file that ends with the comment
  /// "incomplete", or removes it if there is no value in it yet.
  ~VcdWriter() override;
  VcdWriter(const VcdWriter&) = delete;
  VcdWriter& operator=(const VcdWriter&) = delete;

  Id add(std::string_view path, Kind kind, unsigned width) override;
  void begin(std::uint64_t ps, const std::vector<std::uint64_t>& values) override;
  void begin_written(std::uint64_t ps, const WrittenValues& values) override;
  bool begun() const override { return begun_; }
  void set_time(std::uint64_t ps) override {
    stamp_due_ = stamp_due_ || ps != time_ps_;
    time_ps_ = ps;
  }
  void change(Id id, std::uint64_t bits) override {
    Variable& variable = variables_[id];
    bits &= variable.mask;
    if (bits == variable.last && !variable.in_digits) return;
    variable.last = bits;
    variable.in_digits = false;
    if (stamp_due_) write_stamp();
    write_value(variable);
  }
  void change_digits(Id id, std::string_view digits) override;
  void change_text(Id id, std::string_view text) override;
  void pause() override;
  void resume(const std::vector<std::uint64_t>& values) override;
  bool failed() const override { return file_ && file_->failed(); }
  void close(std::uint64_t end_ps) override;

 private:
  struct Variable {
    std::uint64_t last;
    std::uint64_t mask;
    char suffix[8];  ///< identifier code and line end, after a blank unless it is a scalar
    std::uint8_t suffix_length;
    bool scalar;
    bool real;
    bool text;
    bool in_digits;  ///< the value is not of bits, or not known yet: `last` is not it
  };

  void begin_dump(std::uint64_t ps, std::size_t values);
  void write_header();
  void write_scope(const WaveScope& scope);
  void write_declaration(Id id, std::string_view leaf);
  void write_all(const std::vector<std::uint64_t>& values);
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

  std::unique_ptr<OutputFile> file_;    ///< null: closed
  std::unique_ptr<GzipPacker> packer_;  ///< null: the file is not packed
  bool begun_ = false;
  bool stamp_due_ = false;
  std::uint64_t time_ps_ = 0;
  std::vector<WaveDeclaration> declarations_;
  std::vector<Variable> variables_;
  std::vector<char> buffer_;
  char* cursor_;
  char* limit_;
};

}  // namespace vp
