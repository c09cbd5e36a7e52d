#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <trace/replay.h>
#include <trace/vocabulary.h>
#include <trace/window.h>
#include <vp/error.h>
#include <vp/expression.h>
#include <vp/frame_gate.h>

namespace platform::trace {

struct DifferenceOptions {
  bool by_frame = false;               ///< else by time
  std::string frame = "ps.cpu.frame";  ///< its changes begin frames
  vp::TraceFilter filter;              ///< which signals
  unsigned neighbourhood = 8;          ///< changes shown before and after, of each trace
};

struct Difference {
  /// A change near the divergence.
  struct Event {
    std::uint64_t ps;
    std::string path, value;
  };
  struct Value {
    std::string path, in_a, in_b;
  };
  bool differ = false;
  std::uint64_t a_ps = 0, b_ps = 0;  ///< where it begins
  std::uint64_t frame = 0, in_frame_ps = 0;
  std::vector<Value> values;  ///< what differs there
  std::vector<Event> a_before, a_after, b_before, b_after;
  std::vector<std::string> only_in_a, only_in_b;  ///< signals
  std::uint64_t compared = 0;                     ///< signals in both
};

/// The first instant at which a signal of both traces differs. Throws vp::InputError if they have
/// no signal in common, or lack the frame signal.
Difference difference(TraceFile& a, TraceFile& b, const DifferenceOptions& options = {});

struct CutOptions : Window {
  vp::TraceFilter filter;
  std::vector<std::uint32_t> as_texts;  ///< nets that are written as texts whatever their type is
};

/// Signals have values that are not of their type, such as words in a vector of bits: a file can
/// hold them as texts only.
struct MixedTypes final : vp::InputError {
  MixedTypes(const std::string& what, std::vector<std::uint32_t> mixed)
      : InputError(what), nets(std::move(mixed)) {}
  std::vector<std::uint32_t> nets;  ///< all of the trace, for CutOptions::as_texts
};

/// Writes a part of a trace, under our names, as the format that the name `to` tells. Throws
/// vp::InputError; also if the window lies behind the trace or the filter selects nothing. Throws
/// MixedTypes when it has read the trace; what it wrote is then not whole.
void cut(TraceFile& file, const std::string& to, const CutOptions& options = {});

/// Writes how long each bit of the selected signals has which value, and how often it turns, as
/// backward SAIF 2.0 (IEEE 1801), which Vivado's read_saif takes. Vectors count down
/// to bit 0: a trace's own indices are not known. Texts, reals and events are left out. Returns how
/// many bits there are. Throws vp::InputError as cut() does, for a window of one instant, and for
/// selected signals that are in no scope.
std::uint64_t write_saif(TraceFile& file, const std::string& to, const CutOptions& options = {});

struct PlotOptions {
  std::vector<std::string> signals;  ///< as users write them, in this order
  std::uint64_t from_ps = 0;
  std::uint64_t to_ps = 0;                 ///< after from_ps
  std::optional<std::uint64_t> marker_ps;  ///< a line there
  unsigned width = 1100;                   ///< of the picture in px
};

/// The picture of a window as SVG: bits as lines, vectors and texts as boxes with their values,
/// reals as curves. What changes more often than there are pixels is drawn as a block. Throws
/// vp::InputError for an unknown signal.
std::string plot_as_svg(TraceFile& file, const PlotOptions& options);

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
/// A time in steps of a file, as other viewers count it.
std::uint64_t steps_of(std::uint64_t ps, std::uint64_t timescale_fs);
/// The same as commands for Surfer (`surfer TRACE --command-file FILE.sucl`): its state files
/// change with every version.
std::string surfer_commands(const SaveFile& save);
/// The same as settings for VaporView, with a group for each title; its command "Load settings from
/// file" reads them.
std::string vaporview_settings(const SaveFile& save);

/// Save files for what is in the trace: `system.gtkw`, one `<ip>.gtkw` for each IP with its
/// signals, and the translate files they use (`*.flt`: functions, interrupts, directions,
/// features). `folder` exists; the pages name the translate files by it. Reads the trace. Returns
/// the names of the files written. Throws vp::InputError.
std::vector<std::string> write_save_files(TraceFile& file, const Vocabulary& words,
                                          const std::string& folder);

/// The lines for these signals, as save files show them.
std::vector<SaveFile::Line> save_lines(const TraceFile& file,
                                       const std::vector<std::string>& paths);

/// Which signals of two traces are the same port: a YAML file (docs/rtl.md).
struct PortMap {
  struct Port {
    std::string ours, theirs;  ///< as users write signals
    std::string valid;   ///< of ours: the port means something while it is high; empty: always
    bool input = false;  ///< both traces are aligned by these
    std::string place;   ///< file and line, for messages
    unsigned width = 0;  ///< known once a trace is there
  };
  Port clock;
  std::vector<Port> ports;
};

/// Throws vp::InputError with the line.
PortMap read_port_map(const std::string& file);

/// How a simulation made elsewhere compares with a trace of ours.
struct PortComparison {
  /// An edge of a clock, counted from 1, and its time.
  struct Place {
    std::uint64_t clock = 0, ps = 0;
  };
  struct Value {
    std::string port, theirs, ours;
    bool input;
  };
  /// What stood between two edges.
  struct Clock {
    Place theirs, ours;               ///< the first of both
    std::uint64_t until_ps;           ///< the second, of ours
    std::vector<std::string> values;  ///< theirs and ours of each port, as digits
    bool differs;
  };
  Place theirs_begin, ours_begin;  ///< the edges behind which the comparison begins
  std::uint64_t clocks = 0;        ///< that were compared
  std::vector<Value> values;       ///< what differs first; empty: nothing does
  Place theirs, ours;              ///< the edges behind which it does
  std::vector<Clock> around;       ///< from some clocks before that to some behind it
  std::vector<std::string> never_compared, never_changed;  ///< ports; outputs
  std::vector<std::string> warnings;                       ///< of both traces
};

/// Compares all ports on every clock, from the first change of the inputs that both traces have to
/// the end of the shorter one or some clocks behind the first difference. How many clocks one lies
/// behind the other, the inputs tell: a constant delay of an output is a difference. Fills in the
/// widths of `map`. Throws vp::InputError for signals that there are not or that have other widths,
/// and where no change of the inputs is in both.
PortComparison compare_ports(const std::string& theirs, const std::string& ours, PortMap& map);

/// Writes the clocks around the difference as `page`.vcd, in our time, and `page`.gtkw.
void write_comparison(const PortComparison& comparison, const PortMap& map,
                      const std::string& page);

/// One assertion of a checks file (docs/traces.md has the grammar).
struct Check {
  enum class Kind : std::uint8_t {
    always,     ///< `first` holds whenever it is known
    never,      ///< `first` does not hold
    at,         ///< when `first` comes true, `second` holds
    within,     ///< when `first` comes true, `second` holds `limit_ps` later at the latest
    stable,     ///< `first` does not change while `second` holds
    increases,  ///< `first` grows from one instant in which `second` holds to the next
    bursts      ///< `first` holds at every `limit`-th beat (`second`), and only there
  };
  Kind kind = Kind::always;
  std::string name;
  std::string text;  ///< as written
  std::uint64_t line = 0;
  vp::Expression first, second;
  std::optional<vp::Expression> restart;  ///< of `increases`: begins anew when it comes true
  std::uint64_t limit_ps = 0;
  std::uint64_t limit = 0;
  std::uint64_t clock_hz = 0;  ///< that is above it in the file
};

/// Throws vp::InputError with the line.
std::vector<Check> read_checks(const std::string& file);

struct CheckResult {
  const Check* check = nullptr;
  bool skipped = false;  ///< the trace lacks a signal
  std::string missing;   ///< that signal
  std::uint64_t failures = 0;
  std::uint64_t first_ps = 0;   ///< of the first failure
  std::string detail;           ///< of the first failure: "4 after 7"
  std::uint64_t occasions = 0;  ///< how often there was something to check

  /// It has looked at something.
  bool exercised() const { return occasions != 0 || failures != 0; }
};

/// Judges the trace. Throws vp::InputError for a signal that it lacks, unless `skip_missing`; if
/// then nothing is left, too.
std::vector<CheckResult> run_checks(TraceFile& trace, const std::vector<Check>& checks,
                                    bool skip_missing);

}  // namespace platform::trace
