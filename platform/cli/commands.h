#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <cli/options.h>
#include <facts/result.h>
#include <host/process.h>
#include <result/result_json.h>
#include <vp/configuration.h>

namespace CLI {
class App;
}
namespace platform {
class Simulation;
struct SimulationOptions;
}  // namespace platform

/// The commands of the program. Each returns the exit code and throws vp::InputError for what the
/// user got wrong.
namespace platform::cli {

using host::done;
using host::ExitCode;
using host::interrupted;
using host::points_failed;
using host::protocol_broken;
using host::run_failed;
using host::wrong_input;

/// Runs the platform on the inputs. Everything is checked before the first frame and before
/// anything is written; results up to an error in the middle are kept, and the result file says
/// `incomplete`.
int run(const RunOptions& options, const std::vector<std::string>& arguments, std::ostream& out,
        std::ostream& err);

/// What a run found that writes nothing.
struct MemoryRun {
  result::ResultDocument result;
  std::map<std::string, std::string> configuration;  ///< effective
  std::vector<std::string> history;                  ///< if asked for
  std::string missed_stop;          ///< why it did not stop where it was to; "" if it did
  std::ostream* console = nullptr;  ///< gets what the program prints; null: it is dropped
};

/// run() without files and console: no pictures, page, trace. `result` is filled when run() would
/// have written result.json, also if this throws.
int run_in_memory(const RunOptions& options, MemoryRun& result, std::ostream& err);

/// Makes a run again, without its files, and prints who accessed a register last, from which line.
int tell_history(const HistoryOptions& options, std::ostream& out);

/// Makes a run again, without its files, up to a moment, and continues as gdb, at that place in
/// the PS program. Returns only if the moment does not come, or gdb cannot be started.
int debug_run(const DebugOptions& options, std::ostream& out, std::ostream& err);

/// Lets faults happen in many copies of a run, and counts what comes of them.
int run_faults(const FaultsOptions& options, std::ostream& out, std::ostream& err);

/// Lists what may stand in the programmable logic, or runs each to see what it reaches and takes.
int list_designs(const DesignsOptions& options, std::ostream& out);

int print_configuration(const ConfigOptions& options, std::ostream& out);

/// Prints memory map, registers and interrupts of the platform as it is configured.
int print_map(const MapOptions& options, std::ostream& out);

/// Makes a design of a hand-off of Vivado: a folder with design.yaml and what belongs to it. What
/// the user changed in it since the last import stays.
int import_handoff(const ImportOptions& options, std::ostream& out);

/// Makes the page of a folder again, or one that compares two runs.
int make_report(const ReportOptions& options, std::ostream& out, std::ostream& err);

/// Lists the chips that a design can be built for, or all figures of one.
int list_devices(const DevicesOptions& options, std::ostream& out);

/// Lists what PLLs and dividers make near some wishes.
int list_clocks(const ClocksOptions& options, std::ostream& out);

/// Prints the coefficients of the power model.
int print_power_table(const PowerTableOptions& options, std::ostream& out);

/// Prints what the design of options.design takes. Throws vp::InputError for figures that cannot
/// be.
int print_power_estimate(const PowerTableOptions& options, std::ostream& out);

/// `rtl check` runs RTL beside the model of its IP; `rtl vectors` writes what is at the ports
/// of one, for benches of RTL; `rtl compare` compares a trace of a simulation made elsewhere with
/// one of ours. run_failed: they differ, and trace and page lie in the folder for results; or there
/// was nothing to compare.
int ask_rtl(const RtlOptions& options, const std::vector<std::string>& arguments, std::ostream& out,
            std::ostream& err);
/// Synthesises RTL with Yosys: primitives, and Fmax as a range.
int synthesise_rtl(const RtlSynthOptions& options, std::ostream& out);

/// RTL proved equal to that of the IP in whose place it is, or the clock on which it differs.
int prove_rtl(const std::string& ip, const RtlProveOptions& options, std::ostream& out,
              std::ostream& err);

/// RTL in lock-step with its model, in processes of their own.
int check_rtl(const RtlOptions& options, std::ostream& out, std::ostream& err);

/// Asks a recorded trace: statistics, checks, differences, parts, pictures.
int ask_trace(const TraceCommandOptions& options, std::ostream& out, std::ostream& err);
/// `markervp trace check`.
int check_trace(const TraceCommandOptions& options, std::ostream& out, std::ostream& err);
/// `markervp trace transactions`.
int list_transactions(const TraceCommandOptions& options, std::ostream& out, std::ostream& err);

int print_completion(const CLI::App& app, std::ostream& out);

/// Computes the points of a sweep, and merges their results.
int sweep_points(const SweepOptions& options, std::ostream& out, std::ostream& err);

/// Searches a space for the best points, and for why there is none.
int explore_points(const ExploreOptions& options, std::ostream& out, std::ostream& err);

/// Computes the points of one task of a sweep on a cluster.
int sweep_worker(const SweepWorkerOptions& options, std::ostream& err);

/// Lists what sweeps can be judged by.
int list_metrics(const MetricsOptions& options, std::ostream& out);

int find_pareto(const ParetoOptions& options, std::ostream& out, std::ostream& err);

int find_sensitivity(const SensitivityOptions& options, std::ostream& out, std::ostream& err);

/// What one step of each parameter is worth at a point: options.at.
int find_step_effects(const SensitivityOptions& options, std::ostream& out, std::ostream& err);

int compare_runs(const CompareOptions& options, std::ostream& out, std::ostream& err);

/// Reads --config, --set and --design into `configuration`.
void load_configuration(const ConfigurationOptions& options, vp::Configuration& configuration);
/// --fidelity and --rate win over files and --set.
void choose_platform(const PlatformOptions& options, vp::Configuration& configuration);

/// Builds the platform and checks that every key the user set was one. Throws vp::InputError.
std::unique_ptr<Simulation> build(vp::Configuration& configuration,
                                  const SimulationOptions& options);

/// "31:24", "0", "15:12, 3"; as a mask if they are many ranges.
std::string bits_text(std::uint32_t mask);

/// The fields of the registers of one device, one after the other: a set of fields that several
/// registers have appears once.
class FieldsOnce {
 public:
  struct Found {
    const std::vector<facts::HardwareMap::Field>& fields;  ///< to be shown
    std::string as;  ///< name of the register that showed the same; "" if none did
  };
  Found find(const facts::HardwareMap::Register& r);

 private:
  std::map<const void*, std::string> shown_;
  std::vector<facts::HardwareMap::Field> none_;
};

/// The map as a page: memory map, interrupts, clocks, and the registers of each kind of device
/// once, as their descriptions declare them.
std::string map_as_markdown(const facts::HardwareMap& map);

}  // namespace platform::cli
