#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace vp {

class FstReader;
class VcdTokens;

/// A name in a trace. Several names may show one net.
struct WaveVariable {
  enum class Kind : std::uint8_t { bits, real, text };
  std::string path;  ///< levels separated by '.', without "[7:0]"
  Kind kind = Kind::bits;
  unsigned width = 1;     ///< of bits
  std::uint32_t net = 0;  ///< counts from 0
};

/// A value as a trace gives it. Valid during the call that hands it over.
struct WaveValue {
  WaveVariable::Kind kind = WaveVariable::Kind::bits;
  bool known = false;      ///< no x or z in it; a real is a number
  std::uint64_t bits = 0;  ///< right-aligned, the lowest 64; 0 if not known
  double real = 0;         ///< of a real
  std::string_view text;   ///< as written: "0", "1x", "2.5"; of a text what it says
};

/// Takes what a trace tells.
class WaveHandler {
 public:
  virtual ~WaveHandler() = default;
  /// The changes that follow happen at `ps`; rises from call to call. False: enough.
  virtual bool at(std::uint64_t ps) = 0;
  virtual void change(std::uint32_t net, const WaveValue& value) = 0;
};

/// Reads a trace from front to back in bounded memory: a VCD (IEEE 1364, 18), or GTKWave's FST, of
/// which only the selected nets are unpacked. The file's content tells which it is.
///
/// Nothing in a file makes it crash. What is wrong with it is an InputError with the line, or for
/// an FST the byte: truncated, corrupt, no such format, a timescale that is none, an identifier
/// that was not declared or was declared twice, a time that falls.
class WaveReader {
 public:
  /// Opens the file and reads its header. Throws InputError.
  explicit WaveReader(const std::filesystem::path& file);
  ~WaveReader();
  WaveReader(const WaveReader&) = delete;
  WaveReader& operator=(const WaveReader&) = delete;

  const std::filesystem::path& file() const { return file_; }
  /// In the order of the file.
  const std::vector<WaveVariable>& variables() const { return variables_; }
  std::uint32_t nets() const { return static_cast<std::uint32_t>(nets_.size()); }
  /// Null if there is none.
  const WaveVariable* find(const std::string& path) const;
  /// Femtoseconds of a step of the file's time.
  std::uint64_t timescale_fs() const { return timescale_fs_; }

  /// Changes of this net are handed over; of others nothing but their form is looked at.
  void select(std::uint32_t net) { nets_[net].selected = true; }
  void select_all();

  /// Hands over everything selected, once. Throws InputError.
  void read(WaveHandler& handler);

  /// The last time that was read, in ps.
  std::uint64_t now_ps() const { return now_ps_; }
  /// Bytes that were read; of an FST its size.
  std::uint64_t bytes() const;
  /// What a user should know of the file, as in "'t.fst' was not finished …"; empty if nothing.
  std::string remark() const;

 private:
  struct Net {
    WaveVariable::Kind kind;
    unsigned width;
    bool selected;
  };

  [[noreturn]] void fail(const std::string& problem) const;
  std::string_view next(const char* inside);
  void read_header();
  void read_fst_header();
  void declare(WaveVariable variable);
  void skip_to_end(const char* inside);
  void read_timescale();
  void read_scope();
  void read_variable();
  std::uint32_t declare_net(std::string_view code, WaveVariable::Kind kind, unsigned width);
  std::uint32_t net_of(std::string_view code);
  bool read_time(std::string_view digits, WaveHandler& handler);
  bool reach(std::uint64_t steps, WaveHandler& handler);
  void read_scalar(std::string_view token, WaveHandler& handler);
  void read_vector(std::string_view token, WaveHandler& handler);
  void read_real(std::string_view token, WaveHandler& handler);
  void read_text(std::string_view token, WaveHandler& handler);
  /// The value's text, after the letter, and the net.
  std::uint32_t value_and_net(std::string_view token, std::string_view& value);
  std::uint64_t decode(std::string_view digits, bool& known) const;

  std::filesystem::path file_;
  std::unique_ptr<VcdTokens> tokens_;  ///< of a VCD
  std::unique_ptr<FstReader> fst_;     ///< of an FST
  std::vector<WaveVariable> variables_;
  std::vector<Net> nets_;
  std::unordered_map<std::string, std::size_t> by_path_;
  std::vector<std::uint32_t> by_short_code_;  ///< net + 1; 0: none
  std::unordered_map<std::string, std::uint32_t> by_long_code_;
  std::vector<std::string> scopes_;
  std::string text_;
  std::uint64_t timescale_fs_ = 0;
  std::uint64_t now_ps_ = 0;
  bool started_ = false;  ///< a time was read
};

}  // namespace vp
