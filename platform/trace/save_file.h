#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trace/trace_file.h>
#include <trace/vocabulary.h>

namespace platform::trace {

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
/// features). Reads the trace. Returns the names of the files written. Throws vp::InputError.
std::vector<std::string> write_save_files(TraceFile& file, const Vocabulary& words,
                                          const std::string& folder);

/// The lines for these signals, as save files show them.
std::vector<SaveFile::Line> save_lines(const TraceFile& file,
                                       const std::vector<std::string>& paths);

}  // namespace platform::trace
