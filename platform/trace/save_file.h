#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <trace/replay.h>
#include <trace/trace_file.h>
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
  std::vector<unsigned> field_widths_;
  std::map<std::string, InterruptLine> interrupts_;  ///< those of the design that the trace has
};

/// A save file for GTKWave.
struct SaveFile {
  struct Line {
    std::string path;  ///< of a signal; a title if `title`
    unsigned width = 1;
    vp::WaveVariable::Kind kind = vp::WaveVariable::Kind::bits;
    bool title = false;
    bool decimal = false;   ///< else hexadecimal
    std::string translate;  ///< name of a translate file beside it; empty: none
  };
  std::string comment;
  std::vector<Line> lines;
  std::uint64_t start_ps = 0, end_ps = 0;  ///< what it opens on
  std::optional<std::uint64_t> marker_ps;
  std::uint64_t timescale_fs = 1000;  ///< of the trace
};

std::string save_file_text(const SaveFile& save);

/// Save files for what is in the trace: `system.gtkw`, one `<ip>.gtkw` for each IP with its
/// signals, and the translate files they use (`*.flt`: functions, interrupts, directions,
/// features). `folder` exists; the pages name the translate files by it. Reads the trace. Returns
/// the names of the files written. Throws vp::InputError.
std::vector<std::string> write_save_files(TraceFile& file, const Vocabulary& words,
                                          const std::string& folder);

/// The lines for these signals, as save files show them.
std::vector<SaveFile::Line> save_lines(const TraceFile& file,
                                       const std::vector<std::string>& paths);

}  // namespace platform::trace
