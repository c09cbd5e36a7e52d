#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <trace/replay.h>
#include <trace/vocabulary.h>

namespace platform::trace {

/// Translate files for GTKWave: what the values of enumerated signals mean. Functions and feature
/// words are those that occur in the trace.
class Translation final : public Replay::Listener {
 public:
  /// Follows the signals it needs. `words` must outlive it.
  Translation(TraceFile& file, Replay& replay, const Vocabulary& words);

  bool instant(std::uint64_t ps) override;

  /// Name of the file for signal `path`; empty: its values are what they are.
  std::string file_for(const std::string& path) const;
  /// Names and texts of the files for the signals that are in the trace, after the replay.
  std::vector<std::pair<std::string, std::string>> files() const;

 private:
  std::string function_file() const;
  std::string interrupt_file() const;
  std::string word_file() const;

  TraceFile& file_;
  Replay& replay_;
  const Vocabulary& vocabulary_;
  std::map<std::string, std::string> translated_;  ///< signal: translate file
  bool has_functions_ = false;
  unsigned function_width_ = 32;
  Replay::Slot function_ = 0, function_name_ = 0;
  std::map<std::uint64_t, std::string> functions_;
  std::vector<Replay::Slot> packets_;
  std::set<std::uint64_t> words_;
};

}  // namespace platform::trace
