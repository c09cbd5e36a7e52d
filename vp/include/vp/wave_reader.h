#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vp/wave_paths.h>

namespace vp {

class FstReader;
class NameTable;
class VcdIndex;
class VcdReader;
class WaveJoiner;
class WaveNotes;
struct WaveDeclarations;

/// What a name in a trace shows. Several names may show one net.
struct WaveVariable {
  enum class Kind : std::uint8_t { bits, real, text };
  Kind kind = Kind::bits;
  bool is_event = false;          ///< each 1 is an occurrence, also if no 0 comes between them
  unsigned width = 1;             ///< of bits; 0 for a vector without bits, which has no values
  std::uint32_t net = 0;          ///< counts from 0
  std::uint32_t enumeration = 0;  ///< place in WaveReader::enumerations() + 1; 0: none
};

/// What the values of a type are called, as Verilator and GHDL declare it.
struct WaveEnumeration {
  std::string name;
  std::vector<std::pair<std::string, std::string>> words;  ///< digits, and the word for them
};

/// A value as a trace gives it. Valid during the call that hands it over.
struct WaveValue {
  WaveVariable::Kind kind = WaveVariable::Kind::bits;  ///< text for a word in a vector of bits
  bool known = false;      ///< all digits are 0, 1, l or h; a real is a number
  bool plain = false;      ///< all digits are 0 or 1
  std::uint64_t bits = 0;  ///< right-aligned, the lowest 64; l is 0, h is 1; 0 if not known
  double real = 0;         ///< of a real
  std::string_view text;   ///< as written, small: "0", "1x", "2.5"; of a text what it says
};

/// The digits that a value represents: what is left out on the left is 0 before 0 and 1, and the
/// leftmost digit before any other (IEEE 1364, 18.2.1).
std::string full_digits(std::string_view digits, unsigned width);

/// Takes what a trace tells.
class WaveHandler {
 public:
  virtual ~WaveHandler() = default;
  /// The changes that follow happen at `ps`, which never falls. It repeats only where the file has
  /// several instants in one picosecond: see WaveReader::below_ps(). False: enough.
  virtual bool at(std::uint64_t ps) = 0;
  virtual void change(std::uint32_t net, const WaveValue& value) = 0;
  /// From here on the file does not say what happens ($dumpoff), or says it again. The values are x
  /// meanwhile.
  virtual void recorded(bool /*is_recorded*/) {}
  /// False: values may come without their text if `bits` or `real` has all of them, so plain ones
  /// of up to 64 bits and known reals.
  virtual bool needs_texts() const { return true; }
};

/// How a trace is read.
struct WaveOptions {
  std::uint64_t timescale_fs = 0;  ///< of a VCD that says none; 0: 1 ns, with a warning
  bool lenient = false;            ///< leaves out times that fall and undeclared identifiers
  bool strict = false;             ///< what is odd is an error, not a warning
  /// A VCD of so many bytes gets an index when its reader is to skip something. Strict reading
  /// needs all of the file, and no index.
  std::uint64_t index_from = std::uint64_t{64} << 20;
};

/// Reads a trace from front to back in bounded memory: a VCD (IEEE 1364, 18.2 and 18.4) as any tool
/// writes it, or GTKWave's FST, of which only the selected nets are unpacked. The file's content
/// tells which it is.
///
/// Nothing in a file makes it crash. What is odd but clear is a warning. What cannot be understood
/// is an InputError with the line, or for an FST the byte. A file that was cut off gives all that
/// is before the cut, with a warning.
class WaveReader {
 public:
  /// Opens the file and reads its header. Throws InputError.
  explicit WaveReader(const std::filesystem::path& file, const WaveOptions& options = {});
  ~WaveReader();
  WaveReader(const WaveReader&) = delete;
  WaveReader& operator=(const WaveReader&) = delete;

  const std::filesystem::path& file() const { return file_; }
  /// In the order of the file. Bits declared one by one are one vector here; a name that is
  /// declared again with other values is called `name#2`.
  const std::vector<WaveVariable>& variables() const { return variables_; }
  const std::vector<WaveEnumeration>& enumerations() const { return enumerations_; }
  std::uint32_t nets() const { return static_cast<std::uint32_t>(selected_.size()); }
  /// By variable: levels separated by '.', without "[7:0]".
  const WavePaths& paths() const { return paths_; }
  /// Null if missing.
  const WaveVariable* find(std::string_view path) const;
  /// The variable's place; -1 if missing.
  std::int64_t place_of(std::string_view path) const;
  /// Femtoseconds of a step of the file's time.
  std::uint64_t timescale_fs() const { return timescale_fs_; }

  /// Changes of this net are handed over; of others nothing but their form is looked at.
  void select(std::uint32_t net);
  void select_all();

  /// A place not after `ps` at which the file can be entered: a block of an FST, or with the help
  /// of its index a place in a large VCD. None: it can only be read from the front.
  std::optional<std::uint64_t> entry(std::uint64_t ps);
  /// The next read() enters there, and hands over first which values are known in that instant.
  void enter(std::uint64_t entry);
  /// Hands over everything selected, from where the last call stopped. Throws InputError.
  void read(WaveHandler& handler);

  /// The last time that was read, in ps, and the femtoseconds beyond it.
  std::uint64_t now_ps() const { return now_ps_; }
  unsigned below_ps() const { return below_ps_; }
  /// Bytes that were read; of an FST its size.
  std::uint64_t bytes() const;
  /// What a user should know of the file so far, as in "has no $timescale: …, line 12". After
  /// read() all of it.
  std::vector<std::string> warnings() const;

 private:
  void declare(WaveDeclarations declared);
  bool reach(std::uint64_t steps, WaveHandler& handler);
  std::vector<std::uint32_t> standing() const;
  void seek_index(std::uint64_t steps);

  WaveOptions options_;
  std::filesystem::path file_;
  std::unique_ptr<WaveNotes> notes_;
  std::unique_ptr<VcdReader> vcd_;  ///< one of both
  std::unique_ptr<FstReader> fst_;
  std::unique_ptr<VcdIndex> index_;  ///< null without one
  enum class IndexAsk : std::uint8_t { unknown, missing, refused } index_ask_ = IndexAsk::unknown;
  std::optional<std::uint64_t> entry_;  ///< where the next read() enters a VCD
  std::unique_ptr<WaveJoiner> joiner_;  ///< null: no vector was declared bit by bit
  std::vector<WaveVariable> variables_;
  std::vector<WaveEnumeration> enumerations_;
  WavePaths paths_;
  std::unique_ptr<NameTable> by_name_;
  std::vector<bool> selected_;  ///< by net
  std::vector<bool> wanted_;    ///< by net of the file
  std::uint64_t timescale_fs_ = 0;
  std::uint64_t ps_per_step_ = 0;  ///< 0: steps are no whole ps
  std::uint64_t latest_steps_ = 0;
  std::uint64_t now_ps_ = 0;
  unsigned below_ps_ = 0;
  bool started_ = false;  ///< a time was read
};

}  // namespace vp
