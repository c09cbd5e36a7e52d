#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <vp/output_file.h>
#include <vp/wave_writer.h>

namespace vp {

struct WaveDeclaration;
struct WaveScope;

/// Writes a value change dump (IEEE 1364, 18.2), fast, and with nothing in it that depends on the
/// host or the date: the same changes give the same bytes.
///
/// Texts are written as GTKWave reads them ("$var string", "sTEXT id"), with blanks and backslashes
/// as octal escapes.
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
  bool begun() const override { return begun_; }
  void set_time(std::uint64_t ps) override {
    stamp_due_ = stamp_due_ || ps != time_ps_;
    time_ps_ = ps;
  }
  void change(Id id, std::uint64_t bits) override {
    Variable& variable = variables_[id];
    bits &= variable.mask;
    if (bits == variable.last) return;
    variable.last = bits;
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
  };

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

  std::unique_ptr<OutputFile> file_;  ///< null: closed
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
