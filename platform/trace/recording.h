#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <trace/window.h>

namespace platform::trace {

struct RecordingOptions : Window {
  std::vector<std::string> signals;      ///< as users write them; empty: all
  std::size_t most_changes = 1'000'000;  ///< of all signals; those that change most are left out
  std::size_t most_signals = 20'000;
};

/// Words that are said often, each kept once.
class WordTable {
 public:
  /// The place of a word, which is added if it is new.
  std::uint64_t place(const std::string& word) {
    const auto [known, is_new] = place_of_.emplace(word, words_.size());
    if (is_new) words_.push_back(word);
    return known->second;
  }
  const std::vector<std::string>& words() const { return words_; }

 private:
  std::vector<std::string> words_;
  std::unordered_map<std::string, std::uint64_t> place_of_;
};

/// A window of a trace, small enough to put it into a page.
struct Recording {
  enum class Form : std::uint8_t { bit, words, real };
  static constexpr std::string_view states = "01xzuw-";
  struct Signal {
    std::string path;
    Form form = Form::words;
    unsigned width = 1;
    std::uint64_t count = 0;  ///< of changes
    /// For each change the ps since the one before (the first: since `from_ps`), and the value: of
    /// a bit its place in `states`, else the place in `words`. Numbers as vp::put_varint() writes
    /// them; of a bit one number, time · 8 + value. An event is a pulse of one ps.
    std::string changes;
    WordTable words;            ///< values as people write them
    std::int64_t same_as = -1;  ///< place of the signal whose other name this is; -1: none
  };
  std::uint64_t from_ps = 0, to_ps = 0;
  std::vector<Signal> signals;
  std::uint64_t dropped = 0;   ///< signals without room for their changes
  std::uint64_t left_out = 0;  ///< the last signals, without room for their names
};

/// Reads the trace. Throws vp::InputError if the window has nothing of it.
Recording recording(TraceFile& file, const RecordingOptions& options);

}  // namespace platform::trace
