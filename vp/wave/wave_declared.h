#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <vp/wave_reader.h>

namespace vp {

/// Limits of what a file may declare: levels, bytes of a path and of all paths, bits.
constexpr std::size_t deepest_scope = 1000;
constexpr std::size_t longest_path = 1 << 16;
constexpr std::uint64_t largest_paths = std::uint64_t{1} << 30;
constexpr unsigned widest_signal = 1 << 20;

/// A variable as a file declares it.
struct WaveDeclared {
  std::string path;
  WaveVariable variable;   ///< its net is one of the file
  bool may_join = false;   ///< its bits may be a part of a vector
  bool is_single = false;  ///< spelt with one index: "q [3]"
  std::int64_t left = 0, right = 0;
  std::uint64_t line = 0;  ///< of a VCD
};

/// The variables that a file declares, in its order: a few bytes each, as there may be millions.
struct WaveDeclarations {
  /// The bits that a name says it has, if they may be a part of a vector.
  struct Range {
    std::uint32_t place;  ///< of the variable
    bool is_single;
    std::int64_t left, right;
  };
  void add(const WaveDeclared& declared);
  std::size_t size() const { return variables.size(); }

  WavePaths paths;
  std::vector<WaveVariable> variables;
  std::vector<Range> ranges;  ///< by place
  std::string lines;          ///< of a VCD: for each the lines since the one before

 private:
  std::uint64_t last_line_ = 0;
};

/// Finds paths by their hash.
class NameTable {
 public:
  /// Of up to `most` paths.
  explicit NameTable(std::size_t most);
  /// The place of `path` among `paths`, as it was put in; -1 if missing.
  std::int64_t find(std::string_view path, const WavePaths& paths) const;
  /// The same; if it is missing it is put in with `place`.
  std::int64_t find_or_put(std::string_view path, const WavePaths& paths, std::size_t place);

 private:
  std::size_t slot_of(std::string_view path, std::size_t hash, const WavePaths& paths) const;
  std::uint32_t tag_of(std::size_t hash) const;

  std::uint32_t place_mask_ = 1;  ///< the other bits are of the hash, by which most paths differ
  std::vector<std::uint32_t> places_;  ///< + 1
};

/// Takes a time in the file's steps. False: enough for now.
class WaveClock {
 public:
  virtual ~WaveClock() = default;
  virtual bool reach(std::uint64_t steps) = 0;
};

/// Takes the range off the end of the path: " [7:0]", " [3]", "[7:0]". A single index right behind
/// the name stays in it: it is an element of an array.
void take_range(WaveDeclared& declared);

/// Words for values from attributes of the kind "misc 07": tables, and which of them the next
/// variable has.
class WaveEnumerations {
 public:
  /// `text`: "name 2 idle run 00 01", or empty for a table named before.
  void attribute(std::string_view text, std::uint64_t handle);
  /// For the next variable: place + 1, or 0. Forgets it.
  std::uint32_t take();
  std::vector<WaveEnumeration> all;

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> place_of_;
  std::uint32_t pending_ = 0;
};

/// Undoes the escapes of GTKWave and of pyvcd: \x41, \101, \n and so on.
void unescape(std::string_view from, std::string& to);

/// For messages: what a file says may be anything.
std::string shown(std::string_view word);

bool is_utf8(std::string_view text);
/// The text in UTF-8: bytes that are no UTF-8 are taken as Latin-1.
std::string in_utf8(std::string_view text);
/// The same of a name, whose control characters become '?'.
std::string clean_name(std::string_view name);

/// What is odd about a file, each kind once with its count and first line.
class WaveNotes {
 public:
  /// `line`: 0 if it is not known.
  void add(const std::string& text, std::uint64_t line);
  std::vector<std::string> texts() const;
  /// From here on nothing is added: all of the file is known.
  void close() { closed_ = true; }

 private:
  struct Note {
    std::string text;
    std::uint64_t count, line;
  };
  std::vector<Note> notes_;
  bool closed_ = false;
};

/// A part of a vector that a file declares bit by bit.
struct WavePart {
  std::uint32_t net;  ///< of the file
  unsigned width;
};

/// The variables of a file under names of their own, and the vectors that are made of several.
struct WaveNames {
  WavePaths paths;
  std::vector<WaveVariable> variables;
  std::vector<std::vector<WavePart>> joined;  ///< by net, less `nets`; the leftmost part first
  NameTable table;
};

/// `nets`: that the file has. Adds to `notes` what it had to rename.
WaveNames named(WaveDeclarations declared, std::uint32_t nets, WaveNotes& notes);

/// Hands over vectors made of parts, once an instant.
class WaveJoiner final : public WaveHandler {
 public:
  WaveJoiner(std::vector<std::vector<WavePart>> joined, std::uint32_t nets);

  const std::vector<WavePart>& parts(std::uint32_t net) const { return joined_[net - nets_].parts; }
  unsigned width(std::uint32_t net) const;
  /// Passes changes to `next`: those of the nets that are `selected`.
  void begin(WaveHandler& next, const std::vector<bool>& selected);
  /// The file is over.
  void flush();
  /// The file is entered at another place: no part has a value yet.
  void forget();

  bool at(std::uint64_t ps) override;
  void change(std::uint32_t net, const WaveValue& value) override;
  void recorded(bool is_recorded) override;

 private:
  struct Joined {
    std::vector<WavePart> parts;
    std::string digits;
    bool is_due = false;
  };
  struct Use {
    std::uint32_t joined;
    unsigned at;  ///< its leftmost digit
    unsigned width;
  };
  std::uint32_t nets_;
  std::vector<Joined> joined_;
  std::unordered_map<std::uint32_t, std::vector<Use>> uses_;  ///< by net of the file
  std::vector<std::uint32_t> due_;
  WaveHandler* next_ = nullptr;
  const std::vector<bool>* selected_ = nullptr;
};

/// The bits of digits: known if all are 0, 1, l or h; plain if all are 0 or 1.
struct DecodedDigits {
  std::uint64_t bits = 0;
  bool known = true, plain = true, capitals = false, valid = true;
};
DecodedDigits decode_digits(std::string_view digits);

/// The value of a port in an extended VCD (IEEE 1364, 18.4.3) as a state; 0 for an unknown letter.
char state_of_port(char c);

}  // namespace vp
