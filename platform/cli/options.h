#pragma once

#include <atomic>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <cli/application.h>

namespace platform::cli {

/// --config and --set, in the order given.
struct ConfigurationOptions {
  std::vector<std::string> files;
  std::map<std::string, std::string> settings = {};  ///< of a sweep's point, by path
  std::vector<std::string> assignments;              ///< "path=value"; win over settings
  std::optional<std::string> design;                 ///< wins over all
};

/// What the platform is, in words of their own: --fidelity, --program, --rate.
struct PlatformOptions {
  std::optional<std::string> rate;  ///< of the inputs: "60" or "60 fps"
  std::optional<std::string> fidelity;
  std::optional<std::string> program;
};

/// `markervp history`.
struct HistoryOptions {
  std::string folder;  ///< of the run
  std::string at;      ///< register or address
  std::optional<std::string> before;
  std::size_t count = 5;
  bool writes_only = false;
};

/// `markervp debug`.
struct DebugOptions {
  std::string folder;  ///< of the run
  // One of them, or none: where the program failed.
  std::optional<std::string> at;           ///< time
  std::optional<std::string> at_register;  ///< or address
  std::optional<std::uint64_t> warning;    ///< its number
  std::uint64_t access = 1;                ///< its number
  bool writes_only = false;
  std::vector<std::string> commands;  ///< for gdb, which then ends; none: it asks
};

/// `markervp faults`.
struct FaultsOptions {
  std::string file;  ///< of the campaign
  std::string output = "out/faults";
  std::optional<std::uint64_t> count;  ///< of faults; none: as the file says
  std::optional<std::uint64_t> seed;
  std::optional<unsigned> jobs;  ///< none: one for each core
  bool quiet = false;
};

/// `markervp run`.
struct RunOptions : PlatformOptions {
  std::vector<std::string> inputs;
  ConfigurationOptions configuration;
  std::string output = "out";
  std::map<std::string, std::string> input_settings;  ///< by study::InputSetting::name
  std::optional<std::string> point;                   ///< of a sweep, to run it again
  std::optional<std::string> trace;
  std::optional<std::string> trace_window;
  std::vector<std::string> trace_filter;
  std::string trace_level = "ports";
  bool trace_clocks = false;
  std::optional<std::string> trace_trigger;
  bool trace_trigger_expected = true;  ///< it is reported if it never comes true
  std::optional<std::string> trace_frame;
  unsigned trace_before = 0;
  std::size_t trace_buffer = 256;  ///< MiB
  std::optional<std::string> timeline;
  std::uint32_t timeline_frames = 2;
  std::optional<std::string> log_bus;
  std::vector<std::string> log_bus_filter;
  std::optional<std::string> transactions;
  std::optional<std::string> register_coverage;
  std::optional<std::string> software_profile;
  std::optional<std::string> linux_app;  ///< a Linux application; `inputs` are its arguments
  std::optional<int> control;            ///< socket of a test that leads the run
  std::vector<std::string> terminals;    ///< "uart1", "uart1=LINK"
  std::optional<std::uint64_t> frames;
  std::uint64_t repeat = 1;
  bool require_job = false;
  std::vector<std::string> required;  ///< tallies that must hold for each unit
  bool strict = false;                ///< warnings of the run are failures
  bool no_pictures = false;
  bool no_report = false;
  bool quiet = false;
  std::optional<HistoryOptions> history;  ///< what a second run is to find out
  std::optional<DebugOptions> debug;      ///< where a second run is to stop
  /// Counts units that are done, in memory that another process may watch; may be null.
  std::atomic<std::uint64_t>* frames_done = nullptr;
};

/// `markervp rtl synth`.
struct RtlSynthOptions {
  std::vector<std::string> ips;  ///< none: all
  std::vector<std::string> parameters;
  std::vector<std::string> rtl;       ///< folders and files of the user's
  std::optional<std::string> top;     ///< the module in them
  std::vector<std::string> includes;  ///< folders
  std::vector<std::string> defines;   ///< NAME or NAME=VALUE
  std::vector<std::string> ghdl_options;
  bool no_dsp = false;  ///< multiplications from LUT
  std::optional<std::string> output;
};

/// `markervp rtl prove`.
struct RtlProveOptions {
  std::optional<std::string> rtl;  ///< a folder of the user's; none: the streams of ours
  std::optional<std::string> top;  ///< none: the module of the IP's name
  std::vector<std::string> parameters, includes, defines, ghdl_options;  ///< as RtlSynthOptions
  std::vector<std::string> interfaces;  ///< as INTERFACES of markervp_add_rtl()
  std::vector<std::string> ties;        ///< "mode=3"
  unsigned seconds = 60;
  std::uint64_t depth = 0;  ///< clocks that are enough; 0: only a proof is
  std::string output = "out";
};

/// `markervp rtl compare`.
struct RtlCompareOptions {
  std::string theirs, ours;  ///< traces
  std::string map;           ///< which signals are the same port, a YAML file
  std::string output = "out";
};

/// `markervp rtl`.
struct RtlOptions {
  std::string command;  ///< "check", "prove", "vectors", "compare", "synth"
  std::string ip;
  std::string rtl;  ///< check: shared object, or a folder with IP.so in it or in its `build`
  bool no_stimuli = false;              ///< check: only what the user names
  std::optional<std::string> stimulus;  ///< check: of a proof, played at the pins and nothing else
  RunOptions run;
  RtlCompareOptions compare;
  RtlSynthOptions synth;
  RtlProveOptions prove;
};

/// `markervp designs`.
struct DesignsOptions {
  bool json = false;
};

/// `markervp metrics`.
struct MetricsOptions {
  std::string part;                   ///< of their names; empty: all
  std::optional<std::string> run;     ///< whose values are shown: a folder, or a result.json
  std::optional<std::string> design;  ///< its own figures are listed as well
  bool json = false;
  bool markdown = false;
};

/// `markervp config`.
struct ConfigOptions : PlatformOptions {
  std::string path;  ///< a parameter, or a group of them; empty: all
  ConfigurationOptions configuration;
};

/// `markervp map`.
struct MapOptions {
  std::string device;                      ///< empty: the memory map
  bool registers = false;                  ///< of all devices
  bool markdown = false;                   ///< the page of the documentation
  bool xparameters = false;                ///< the header of a board support package
  std::optional<std::string> device_tree;  ///< file for it; empty: standard output
  std::string diagram;                     ///< file for a picture of a design in YAML; empty: none
  ConfigurationOptions configuration;
};

/// `markervp import`.
struct ImportOptions {
  std::string file;                   ///< .hwh, .xsa or .hdf
  std::string block_design;           ///< which one of several in an archive; empty: the only one
  std::string device;                 ///< in the place of the hand-off's; empty: that
  std::vector<std::string> programs;  ///< sources of the PS program
  std::vector<std::string> rtl;       ///< folders with RTL of its IP
  std::string output;                 ///< folder; empty: the name of the block design
  bool shelf = false;                 ///< print the IP that the platform knows instead
};

/// `markervp report`.
struct ReportOptions {
  std::vector<std::string> folders;   ///< one: its page again; two: a comparison
  std::optional<std::string> output;  ///< file of the comparison
};

/// `markervp devices`.
struct DevicesOptions {
  std::string device;  ///< empty: all of them
  bool json = false;
};

/// `markervp clocks`.
struct ClocksOptions {
  std::vector<std::string> wishes;
  std::string kind = "fclk";      ///< or "cpu", "cpu-421", "ddr"; of the fabric "mmcm", "pll"
  std::string input = "100 MHz";  ///< of a clock manager of the fabric
  std::string device = "xc7z020-1";
  std::optional<std::string> crystal;  ///< default: that of a ZedBoard
  std::size_t count = 8;
  bool no_ethernet = false;
  bool json = false;
};

/// `markervp power`.
struct PowerTableOptions {
  std::string table = "zynq7020";  ///< installed, or a file .json
  bool markdown = false;           ///< with the sources, as in the documentation
  std::string design;              ///< figures to estimate, a YAML file; empty: print the table
};

/// `markervp trace COMMAND`.
struct TraceCommandOptions {
  std::string command;  ///< "list", "find", "values", "stats", "check", "diff", "cut", "convert" …
  std::string file;
  std::string other;   ///< the second trace of diff; the file that cut and convert write
  std::string checks;  ///< the file of check
  std::optional<std::string> design, map, window, frame, output, marker, timescale;
  std::vector<std::string> filter, clocks;
  std::vector<std::string> signals;
  std::string align = "time";
  bool json = false, csv = false, skip_missing = false, require_exercised = false;
  bool lenient = false, strict = false;
  std::string condition;        ///< of find
  std::vector<std::string> at;  ///< times of values
  std::optional<std::string> when, every;
  std::optional<std::uint64_t> most;  ///< lines
  // Of transactions:
  std::vector<std::string> kinds, described;
  std::optional<std::string> where, perfetto, lanes;
  std::uint64_t data_beats = 1, hang_clocks = 10, max_wait = 0;
  std::optional<std::uint16_t> port;  ///< of the viewer
};

/// `markervp completion`.
struct CompletionOptions {
  std::string shell;
};

/// `markervp sweep`.
struct SweepOptions {
  std::string file;  ///< or the name of a study
  bool list = false;
  std::optional<std::string> output;
  std::optional<std::uint32_t> jobs;
  std::string engine = "local";
  std::optional<std::uint64_t> limit;
  bool yes = false;
  bool dry_run = false;
  bool retry_failed = false;
  bool require_all = false;
  bool isolate = false;       ///< a process of its own for each point
  bool keep_results = false;  ///< whole, in points/
  bool no_report = false;
  std::uint32_t chunk = 0;    ///< 0: some seconds' worth
  std::uint32_t at_once = 0;  ///< 0: all that fit
  std::vector<std::string> sbatch;
};

/// `markervp explore`.
struct ExploreOptions : SweepOptions {
  // In place of what the file says.
  std::optional<std::uint64_t> points;
  std::optional<std::uint64_t> seed;
  std::optional<std::string> time;
};

/// `markervp sweep-worker`: what a cluster calls.
struct SweepWorkerOptions {
  std::string folder;
  std::uint32_t submission = 0;
  std::uint32_t task = 0;
  std::uint32_t points_a_process = 1;
  bool keep_results = false;
};

/// `markervp pareto`.
struct ParetoOptions {
  std::string folder;
  std::vector<std::string> objectives;
  std::vector<std::string> constraints;
};

/// `markervp sensitivity`.
struct SensitivityOptions {
  std::string folder;             ///< empty: that of the point
  std::optional<std::string> at;  ///< a point: what one step of each parameter changes
  std::vector<std::string> figures;
  bool all = false;  ///< not only feasible points
};

/// `markervp compare`.
struct CompareOptions {
  std::string first;
  std::string second;
};

/// Everything the user typed.
struct CommandLine {
  RunOptions run;
  HistoryOptions history;
  DebugOptions debug;
  FaultsOptions faults;
  RtlOptions rtl;
  DesignsOptions designs;
  ConfigOptions config;
  MapOptions map;
  ImportOptions import;
  ReportOptions report;
  DevicesOptions devices;
  ClocksOptions clocks;
  PowerTableOptions power;
  TraceCommandOptions trace;
  CompletionOptions completion;
  SweepOptions sweep;
  ExploreOptions explore;
  SweepWorkerOptions sweep_worker;
  MetricsOptions metrics;
  ParetoOptions pareto;
  SensitivityOptions sensitivity;
  CompareOptions compare;
  std::map<std::string, RunCommand> application;  ///< its commands, by name
};

/// A span of simulated time, ps.
struct TimeWindow {
  std::uint64_t from_ps = 0;
  std::uint64_t to_ps = UINT64_MAX;
};

/// Reads "15.2ms", ps. Throws vp::InputError that names `option`.
std::uint64_t parse_moment(const std::string& text, const std::string& option);

/// Reads "6ms:7ms", "6 ms : 7.5 ms", ":100us" (from the start) or "2ms:" (to the end).
/// Throws vp::InputError, naming `option`, if it is malformed or ends before it begins.
TimeWindow parse_trace_window(const std::string& text,
                              const std::string& option = "--trace-window");

/// What `markervp run --point POINT` runs: the inputs, program and configuration of a
/// sweep's point; --set and --config change it. With --trace the fidelity is left to the trace.
/// Says on `err` if the point was computed by another version. Without --point `options` as they
/// are. Throws vp::InputError for a damaged file, or options that the point decides.
RunOptions with_point(const RunOptions& options, std::ostream& err);

}  // namespace platform::cli
