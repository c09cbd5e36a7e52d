#include <CLI/CLI.hpp>
#include <cstdint>

#include <cli/app.h>

namespace platform::cli {

namespace {

constexpr std::uint64_t most_points = 10'000'000;
constexpr std::uint64_t most_seed = 1'000'000'000'000;
constexpr std::uint32_t most_jobs = 1024;
constexpr std::uint32_t most_tasks = 1'000'000;

constexpr const char* sweep_help =
    R"(FILE is a YAML file (docs/exploration.md), or a study that --list shows:
  markervp sweep pixel-clock                   results in out/pixel-clock
  markervp sweep mine.yaml --dry-run           check it and show its points
  markervp sweep mine.yaml --engine slurm      on a cluster
A sweep may be stopped at any time: the same command continues. No point is computed twice.)";

constexpr const char* explore_help =
    R"(FILE is that of a sweep, or a study; its objectives say what is better, its constraints what must hold:
  markervp explore least-energy                results in out/least-energy
It computes the points that are worth it, generation by generation, and ends when that gains nothing more.
Ctrl-C leaves the best points so far; the same command continues. docs/exploration.md says more.)";

constexpr const char* pareto_help =
    R"(  markervp pareto out/pixel-clock --objective 'max summary.fps.mean' \
      --objective 'min power.total_w.nominal' --constraint 'timing.met == 1'
Without objectives those of the sweep. Writes pareto.csv and pareto.svg into DIR.)";

template <class Number>
CLI::Validator number_range(Number least, Number most) {
  return CLI::Range(least, most).description("");
}

void add_run_options(CLI::App& command, SweepOptions& target) {
  command.add_option("-j,--jobs", target.jobs, "processes at a time (default: one a core)")
      ->type_name("N")
      ->check(number_range(std::uint32_t{1}, most_jobs));
  command.add_option("--engine", target.engine, "where to compute (default: local)")
      ->type_name("local|slurm")
      ->check(CLI::IsMember({"local", "slurm"}).description(""));
  command.add_flag("--retry-failed", target.retry_failed, "compute points that failed once more");
  command.add_flag(
      "--isolate", target.isolate,
      "each point in a process of its own (default: those of PS programs of your own)");
  command.add_flag("--keep-results", target.keep_results,
                   "keep each point's whole result.json (points/KEY.json); else it is made again");
  command
      .add_option("--chunk", target.chunk, "Slurm: points a task (default: some seconds' worth)")
      ->type_name("N")
      ->check(number_range(std::uint32_t{1}, most_tasks));
  command.add_option("--at-once", target.at_once, "Slurm: tasks at a time (default: all that fit)")
      ->type_name("N")
      ->check(number_range(std::uint32_t{1}, most_tasks));
  command
      .add_option("--sbatch", target.sbatch, "Slurm: one more option for sbatch: --partition=long")
      ->type_name("OPTION")
      ->expected(1)
      ->take_all();
}

void add_result_options(CLI::App& command, SweepOptions& target) {
  command.add_option("-o,--output", target.output, "folder for the results (default: out/NAME)")
      ->type_name("DIR");
  command.add_flag("--dry-run", target.dry_run, "check everything, say what there is, run nothing");
  command.add_flag("--no-report", target.no_report, "no page report.html");
  command.add_flag("--require-all", target.require_all, "exit code 1 if a point failed to run");
  add_run_options(command, target);
}

void add_sweep(CLI::App& app, SweepOptions& target) {
  CLI::App* command = app.add_subcommand("sweep", "compute many design points");
  command->add_option("FILE", target.file, "what to sweep")->type_name("");
  command->add_flag("--list", target.list, "the studies that come with the program");
  command->add_option("--limit", target.limit, "only the first points")
      ->type_name("N")
      ->check(number_range(std::uint64_t{1}, most_points));
  command->add_flag("--yes", target.yes, "run even a very large sweep");
  add_result_options(*command, target);
  command->footer(sweep_help);
}

void add_explore(CLI::App& app, ExploreOptions& target) {
  CLI::App* command = app.add_subcommand("explore", "search a design space for its best points");
  command->add_option("FILE", target.file, "the space and what is better: as for a sweep")
      ->type_name("")
      ->required();
  command->add_option("--points", target.points, "compute so many at most (default: 2000)")
      ->type_name("N")
      ->check(number_range(std::uint64_t{2}, most_points));
  command->add_option("--time", target.time, "end after so long: 90s")->type_name("TIME");
  command->add_option("--seed", target.seed, "of the choices by chance (default: 1)")
      ->type_name("N")
      ->check(number_range(std::uint64_t{0}, most_seed));
  add_result_options(*command, target);
  command->footer(explore_help);
}

/// What Slurm calls. Not for people: without a group it is in no help.
void add_sweep_worker(CLI::App& app, SweepWorkerOptions& target) {
  CLI::App* command = app.add_subcommand("sweep-worker", "compute a task of a sweep on a cluster");
  command->group("");
  command->add_option("DIR", target.folder, "the sweep")->required();
  command->add_option("SUBMISSION", target.submission, "its number")->required();
  command->add_option("TASK", target.task, "its number")->required();
  command->add_option("POINTS", target.points_a_process, "points a process")->required();
  command->add_flag("--keep-results", target.keep_results, "whole");
}

void add_metrics(CLI::App& app, MetricsOptions& target) {
  CLI::App* command = app.add_subcommand("metrics", "list the figures of runs, or those of one");
  CLI::Option* name =
      command->add_option("NAME", target.part, "only those that have this in their name")
          ->type_name("");
  CLI::Option* run =
      command->add_option("--of", target.run, "show the values that a run has")->type_name("DIR");
  command->add_option("--design", target.design, "list what this design finds, too")
      ->type_name("NAME")
      ->excludes(run);
  CLI::Option* json = command->add_flag("--json", target.json, "for programs");
  command->add_flag("--markdown", target.markdown, "as docs/figures.md")->excludes(json, run, name);
}

void add_pareto(CLI::App& app, ParetoOptions& target) {
  CLI::App* command = app.add_subcommand("pareto", "the best points of a sweep");
  command->add_option("DIR", target.folder, "folder of the sweep")->type_name("DIR")->required();
  command->add_option("--objective", target.objectives, "what is better: 'max summary.fps.mean'")
      ->type_name("FIGURE")
      ->expected(1)
      ->take_all();
  command
      ->add_option("--constraint", target.constraints, "what must hold: 'summary.fps.mean >= 60'")
      ->type_name("CONDITION")
      ->expected(1)
      ->take_all();
  command->footer(pareto_help);
}

void add_sensitivity(CLI::App& app, SensitivityOptions& target) {
  CLI::App* command = app.add_subcommand("sensitivity", "which parameters of a sweep matter");
  command->add_option("DIR", target.folder, "folder of the sweep")->type_name("DIR");
  command
      ->add_option("--at", target.at,
                   "what one step of each parameter changes at a point: out/NAME:KEY")
      ->type_name("POINT");
  command->add_option("--figure", target.figures, "of what (default: the sweep's objectives)")
      ->type_name("FIGURE")
      ->expected(1)
      ->take_all();
  command->add_flag("--all", target.all, "take all points that ran, feasible or not");
}

void add_compare(CLI::App& app, CompareOptions& target) {
  CLI::App* command = app.add_subcommand("compare", "in what two runs or points differ");
  command
      ->add_option("A", target.first, "result.json, its folder, or a sweep's point: out/NAME:KEY")
      ->type_name("FILE")
      ->required();
  command->add_option("B", target.second, "the other")->type_name("FILE")->required();
}

}  // namespace

void add_exploration(CLI::App& app, CommandLine& target) {
  add_sweep(app, target.sweep);
  add_explore(app, target.explore);
  add_sweep_worker(app, target.sweep_worker);
  add_metrics(app, target.metrics);
  add_pareto(app, target.pareto);
  add_sensitivity(app, target.sensitivity);
  add_compare(app, target.compare);
}

namespace {

constexpr const char* check_help = R"(A check a line, '#' begins a comment:
  clock 100 MHz
  name: always CONDITION | never CONDITION
  name: at CONDITION holds CONDITION
  name: within 20 cycles of CONDITION holds CONDITION
  name: stable VALUE while CONDITION
  name: increases VALUE when CONDITION [restart CONDITION]
  name: bursts of 32 beats CONDITION last CONDITION
docs/traces.md has examples; share/markervp/checks a set for our system.)";

constexpr const char* find_help = R"(Conditions are expressions (docs/expressions.md):
  markervp trace find t.vcd 'awvalid and not awready'
  markervp trace find t.vcd --every top.clk 'past(req, 20) and count(ack, 20) == 0'
docs/traces.md has twenty questions with their answers.)";

constexpr const char* values_help = R"(  markervp trace values t.vcd state count --at 12us --at 15us
  markervp trace values t.vcd tdata tlast --every clk --when 'tvalid and tready' --csv)";

constexpr const char* transactions_help = R"(Buses are found by the names of their signals:
  markervp trace transactions t.vcd
  markervp trace transactions t.vcd --kind axi4 --where "operation == 'read' and latency > 2 us"
  markervp trace transactions t.vcd --csv --data 16 > transfers.csv
docs/transactions.md has the rules, the fields and the names of errors.)";

/// A command of `trace`, with what all take.
CLI::App* add(CLI::App& trace, TraceCommandOptions& target, const std::string& name,
              const std::string& what) {
  CLI::App* command = trace.add_subcommand(name, what);
  command->callback([&target, name] { target.command = name; });
  return command;
}

void add_file(CLI::App& command, TraceCommandOptions& target) {
  command.add_option("TRACE", target.file, "a .vcd, .vcd.gz or .fst")
      ->type_name("FILE")
      ->required();
  command.add_option("--map", target.map, "other names: lines 'ours = theirs'")->type_name("FILE");
  command
      .add_option("--timescale", target.timescale,
                  "unit of the times of a VCD that has none (default: 1ns)")
      ->type_name("TIME");
  CLI::Option* lenient = command.add_flag(
      "--lenient", target.lenient, "leave out times that fall and values of undeclared signals");
  command.add_flag("--strict", target.strict, "refuse a file that is odd, or cut off")
      ->excludes(lenient);
}

void add_design(CLI::App& command, TraceCommandOptions& target) {
  command
      .add_option("--design", target.design, "whose signals they are (default: the usual design)")
      ->type_name("NAME");
}

void add_filter(CLI::App& command, TraceCommandOptions& target) {
  command.add_option("--filter", target.filter, "only these: 'pl.axi_dma_0.**'")
      ->type_name("GLOB")
      ->expected(1)
      ->take_all();
}

void add_window(CLI::App& command, TraceCommandOptions& target) {
  command.add_option("--window", target.window, "only then: 6ms:7ms")->type_name("FROM:TO");
}

void add_clock(CLI::App& command, TraceCommandOptions& target) {
  command
      .add_option("--clock", target.clocks,
                  "of the links: a signal, 'top.clk falling', of one LINK=SIGNAL, or 55MHz if "
                  "the trace has no clocks (default: found by name and edges, or 100 MHz)")
      ->type_name("CLOCK")
      ->expected(1)
      ->take_all();
}

void add_most(CLI::App& command, TraceCommandOptions& target, const char* what) {
  command.add_option("--most", target.most, what)
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 62).description(""));
}

void add_formats(CLI::App& command, TraceCommandOptions& target) {
  CLI::Option* json = command.add_flag("--json", target.json, "for programs");
  command.add_flag("--csv", target.csv, "for spreadsheets")->excludes(json);
}

/// What `find` and `values` have in common.
void add_moments(CLI::App& command, TraceCommandOptions& target) {
  command
      .add_option("--every", target.every,
                  "on these edges only, with the values before them: top.clk, 'top.clk falling'")
      ->type_name("CLOCK");
  add_window(command, target);
  add_most(command, target, "stop after so many lines");
  add_formats(command, target);
}

void add_transactions(CLI::App& trace, TraceCommandOptions& target) {
  CLI::App* command =
      add(trace, target, "transactions", "the transfers on the buses, and who waits for whom");
  add_file(*command, target);
  command
      ->add_option("--kind", target.kinds,
                   "only these: axi4,axi4-lite,axi-stream,apb,wishbone,uart,i2c,spi,irq")
      ->type_name("KIND")
      ->delimiter(',')
      ->expected(1)
      ->take_all();
  command->add_option("--filter", target.filter, "only buses of these names: 'top.dma.**'")
      ->type_name("GLOB")
      ->expected(1)
      ->take_all();
  command->add_option("--where", target.where, "only those: \"address == 0x40000000\"")
      ->type_name("CONDITION");
  add_window(*command, target);
  add_clock(*command, target);
  command
      ->add_option("--as", target.described,
                   "a bus that names do not tell: 'uart console: line=top.pin7 baud=115200'")
      ->type_name("BUS")
      ->expected(1)
      ->take_all();
  add_most(*command, target, "print so many (default: 50, with --csv and --json all)");
  command->add_option("--data", target.data_beats, "beats whose data are kept (default: 1)")
      ->type_name("N")
      ->check(CLI::Range(0, 256).description(""));
  command
      ->add_option("--hang", target.hang_clocks,
                   "what waits at the end for so many clocks hangs (default: 10)")
      ->type_name("N");
  command->add_option("--max-wait", target.max_wait, "report VALID without READY for more clocks")
      ->type_name("N");
  command->add_option("--perfetto", target.perfetto, "write lanes for ui.perfetto.dev")
      ->type_name("FILE");
  command->add_option("--lanes", target.lanes, "write lanes as signals, .vcd, .vcd.gz or .fst")
      ->type_name("FILE");
  add_formats(*command, target);
  command->footer(transactions_help);
}

}  // namespace

void add_trace_command(CLI::App& app, TraceCommandOptions& target) {
  CLI::App* trace = app.add_subcommand("trace", "ask a recorded trace");
  trace->require_subcommand(1);

  CLI::App* list = add(*trace, target, "list",
                       "time scale, first and last time, and the signals with widths and changes");
  add_file(*list, target);
  add_filter(*list, target);
  list->add_flag("--json", target.json, "for programs");

  CLI::App* find = add(*trace, target, "find", "when a condition holds, and for how long");
  add_file(*find, target);
  find->add_option("CONDITION", target.condition, "an expression over signals")
      ->type_name("")
      ->required();
  add_moments(*find, target);
  find->footer(find_help);

  CLI::App* values = add(*trace, target, "values", "the values of signals at some moments");
  add_file(*values, target);
  values->add_option("SIGNAL", target.signals, "names, or their ends")->type_name("")->required();
  CLI::Option* at = values->add_option("--at", target.at, "at this time: 6.1ms")
                        ->type_name("TIME")
                        ->expected(1)
                        ->take_all();
  values->add_option("--when", target.when, "each time that this comes true")
      ->type_name("CONDITION")
      ->excludes(at);
  add_moments(*values, target);
  values->footer(values_help);

  CLI::App* stats = add(*trace, target, "stats",
                        "handshakes, buffers, interrupts, frames and functions in numbers");
  add_file(*stats, target);
  add_design(*stats, target);
  add_clock(*stats, target);
  add_formats(*stats, target);

  add_transactions(*trace, target);

  CLI::App* check = add(*trace, target, "check", "assertions; exit code 1 if one fails");
  check->add_option("CHECKS", target.checks, "a .checks file")->type_name("FILE")->required();
  add_file(*check, target);
  check->add_flag("--skip-missing", target.skip_missing, "leave out checks without their signals");
  check->add_flag("--require-exercised", target.require_exercised,
                  "exit code 1, too, if a check looked at nothing or was left out");
  check
      ->add_option("-o,--output", target.output,
                   "save file for GTKWave at the failure (default: TRACE.failed.gtkw)")
      ->type_name("FILE");
  check->footer(check_help);

  CLI::App* diff = add(*trace, target, "diff", "where two traces part; exit code 1 if they do");
  add_file(*diff, target);
  diff->add_option("OTHER", target.other, "the other trace")->type_name("FILE")->required();
  diff->add_option("--align", target.align, "what is compared: equal times, or frame by frame")
      ->type_name("time|frame")
      ->check(CLI::IsMember({"time", "frame"}).description(""));
  diff->add_option("--frame", target.frame, "its changes begin frames (default: ps.cpu.frame)")
      ->type_name("SIGNAL");
  add_filter(*diff, target);

  CLI::App* cut = add(*trace, target, "cut", "write a part: a window, some signals");
  add_file(*cut, target);
  cut->add_option("OUTPUT", target.other, "a .vcd, .vcd.gz or .fst")->type_name("FILE")->required();
  add_window(*cut, target);
  add_filter(*cut, target);

  CLI::App* convert = add(*trace, target, "convert", "write as the other format, under our names");
  add_file(*convert, target);
  convert->add_option("OUTPUT", target.other, "a .vcd, .vcd.gz or .fst")
      ->type_name("FILE")
      ->required();

  CLI::App* saif = add(*trace, target, "saif",
                       "write how often each bit turns, for Vivado's read_saif and others");
  add_file(*saif, target);
  saif->add_option("OUTPUT", target.other, "a .saif")->type_name("FILE")->required();
  add_window(*saif, target);
  add_filter(*saif, target);

  CLI::App* plot = add(*trace, target, "plot",
                       "draw signals as SVG or timing diagram; a page to look around in");
  add_file(*plot, target);
  plot->add_option("SIGNAL", target.signals, "names, or their ends; a page takes all without")
      ->type_name("");
  add_window(*plot, target);
  plot->add_option("--marker", target.marker, "a line at a time: 6.1ms")->type_name("TIME");
  plot->add_option("--every", target.every,
                   "a timing diagram for WaveDrom instead, a column for each of these edges")
      ->type_name("CLOCK");
  plot->add_option("-o,--output", target.output,
                   "picture (default: plot.svg), diagram (diagram.json), or page (NAME.html)")
      ->type_name("FILE");

  CLI::App* view = add(*trace, target, "view", "open it in a running Surfer or VaporView");
  add_file(*view, target);
  view->add_option("SIGNAL", target.signals, "names, or their ends, to show there")->type_name("");
  view->add_option("--at", target.marker, "the moment: 6.1ms")->type_name("TIME");
  view->add_option("--port", target.port,
                   "of the viewer's WCP server (default: Surfer's 54321, then VaporView's 54322)")
      ->type_name("N")
      ->check(CLI::Range(1, 65535).description(""));

  CLI::App* gtkw = add(*trace, target, "gtkw", "write save and translate files for GTKWave");
  add_file(*gtkw, target);
  add_design(*gtkw, target);
  gtkw->add_option("-o,--output", target.output,
                   "folder, made if it is missing (default: TRACE.gtkwave)")
      ->type_name("DIR");
}

}  // namespace platform::cli
