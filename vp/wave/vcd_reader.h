#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <vp/wave_reader.h>

#include "code_table.h"
#include "wave_declared.h"
#include "wave_input.h"

namespace vp {

/// Reads a value change dump, plain or extended (IEEE 1364, 18.2 and 18.4), in the dialects of the
/// tools that write them.
class VcdReader {
 public:
  /// Four bytes, as there may be millions.
  struct Net {
    unsigned width : 24;
    WaveVariable::Kind kind : 2;
    bool is_event : 1;
    bool selected : 1;
  };
  using Clock = WaveClock;

  /// Reads the header. Throws InputError.
  VcdReader(const std::filesystem::path& file, const WaveOptions& options, WaveNotes& notes);

  const std::vector<Net>& nets() const { return nets_; }
  WaveDeclarations& declared() { return declared_; }
  std::vector<WaveEnumeration>& enumerations() { return enumerations_.all; }
  std::uint64_t timescale_fs() const { return timescale_fs_; }
  std::uint64_t bytes() const { return window_.bytes(); }

  /// Hands over the changes of the selected nets, from where the last call stopped to the end or
  /// until the clock has enough. Throws InputError.
  void read(const std::vector<bool>& selected, Clock& clock, WaveHandler& handler);

  /// A place at which reading can begin: the first word of an instant.
  struct Place {
    std::uint64_t steps, offset, line;
  };
  /// enter() works. Ask behind the header.
  bool can_enter() { return window_.can_seek(); }
  /// The byte at which the change or the instant begins that is being handed over.
  std::uint64_t offset() const { return window_.offset(begin_); }
  /// The instant that is being handed over.
  Place place() const { return {steps_, offset(), window_.line(begin_)}; }
  /// Goes to `place` and hands over, in its instant, the changes at the bytes `changes`, which
  /// rise: those that made the values before it. read() continues there.
  void enter(const Place& place, const std::vector<std::uint64_t>& changes,
             const std::vector<bool>& selected, Clock& clock, WaveHandler& handler);

  [[noreturn]] void fail(const std::string& problem) const;

 private:
  /// `more`: the rest of the window is no whole value.
  enum class Status : std::uint8_t { again, more, stopped, over };

  /// A word and the white space before it; empty at the end of the file.
  std::string_view next_word();
  std::string_view next(const char* inside);
  /// False: the file ends before `$end`.
  bool pass_to_end();
  void skip_to_end(const char* inside);
  /// For what is odd but clear; strict reading refuses it.
  void note(const std::string& text);

  void read_header();
  bool read_header_word(std::string_view word);
  bool begins_values(std::string_view word) const;
  void read_timescale();
  void read_scope();
  void leave_scope();
  void read_variable();
  void read_attribute();
  std::uint32_t declare_net(std::string_view code, WaveVariable::Kind kind, unsigned width,
                            bool is_event);
  void finish_declarations();

  std::uint32_t net_of(std::string_view code) const;
  /// Throws for one that was not declared; a lenient reader gets 0.
  std::uint32_t declared_net_of(std::string_view code);
  /// A longer identifier begins with this one.
  bool has_longer(std::string_view code) const;

  void select(const std::vector<bool>& selected);
  void read_change(std::uint64_t offset, Clock& clock, WaveHandler& handler);
  bool pass_blanks_of_bit(const char*& to);
  Status read_window(Clock& clock, WaveHandler& handler);
  bool begin_values(Clock& clock, WaveHandler& handler);
  Status read_keyword(std::string_view word, WaveHandler& handler);
  Status read_time(std::string_view digits, Clock& clock);
  bool fall();
  void read_bits(std::string_view digits, std::uint32_t net, WaveHandler& handler);
  void shorten(std::string_view& digits, unsigned width);
  void read_real(std::string_view digits, std::uint32_t net, WaveHandler& handler);
  void read_text(std::string_view text, std::uint32_t net, WaveHandler& handler);
  void read_port(std::string_view states, std::uint32_t net, WaveHandler& handler);
  void hand_over_unknowns(WaveHandler& handler);
  /// Says that the file was cut off, or takes its last word as whole.
  bool accept_last_word();

  std::filesystem::path file_;
  WaveOptions options_;
  WaveNotes& notes_;
  VcdWindow window_;
  const char* at_ = nullptr;     ///< for messages: the word that is looked at
  const char* begin_ = nullptr;  ///< of the change or instant that is being handed over
  bool single_ = false;          ///< a window is left behind its first word

  std::vector<Net> nets_;
  WaveDeclarations declared_;
  std::vector<std::uint32_t> by_short_code_;  ///< net + 1; 0: none
  CodeTable by_long_code_;                    ///< the same
  struct Scope {
    std::string path;
    bool is_array;
  };
  std::vector<Scope> scopes_;
  std::uint64_t path_bytes_ = 0;
  std::uint64_t timescale_fs_ = 0;
  bool retyped_ = false;  ///< a net has several types or sizes
  WaveEnumerations enumerations_;

  std::uint64_t steps_ = 0;  ///< of the last time
  bool started_ = false;     ///< a time was read
  bool over_ = false;
  std::string text_, digits_;
};

}  // namespace vp
