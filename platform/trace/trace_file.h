#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <vp/wave_reader.h>

namespace platform::trace {

/// Other names for signals: a line each, `ours = theirs`, both whole paths; `#` begins a comment.
/// For traces of real hardware, whose tools name everything anew.
struct NameMap {
  struct Entry {
    std::string ours, theirs;
    std::uint64_t line;
  };
  std::string file;  ///< empty: no map
  std::vector<Entry> entries;
};

/// Throws vp::InputError with the line.
NameMap read_name_map(const std::string& file);

/// A trace under our names.
class TraceFile {
 public:
  /// Throws vp::InputError for a trace that cannot be read, and for entries of the map that name no
  /// signal in it, with what is near.
  explicit TraceFile(const std::string& file, const NameMap& map = {});

  vp::WaveReader& reader() { return reader_; }
  /// By variable: our name where the map has one.
  const std::vector<std::string>& paths() const { return paths_; }
  const vp::WaveVariable& variable(std::uint32_t i) const { return reader_.variables()[i]; }
  /// The variable called `path`; -1 if there is none.
  int find(const std::string& path) const;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  vp::WaveReader reader_;
  std::vector<std::string> paths_;
};

}  // namespace platform::trace
