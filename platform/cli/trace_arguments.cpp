#include <CLI/CLI.hpp>

#include <cli/app.h>

namespace platform::cli {

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

/// A command of `trace`, with what all take.
CLI::App* add(CLI::App& trace, TraceCommandOptions& target, const std::string& name,
              const std::string& what) {
  CLI::App* command = trace.add_subcommand(name, what);
  command->callback([&target, name] { target.command = name; });
  return command;
}

void add_file(CLI::App& command, TraceCommandOptions& target) {
  command.add_option("TRACE", target.file, "a .vcd or .fst")->type_name("FILE")->required();
  command.add_option("--map", target.map, "other names: lines 'ours = theirs'")->type_name("FILE");
}

void add_design(CLI::App& command, TraceCommandOptions& target) {
  command
      .add_option("--design", target.design, "whose signals they are (default: the usual design)")
      ->type_name("NAME");
}

void add_filter(CLI::App& command, TraceCommandOptions& target) {
  command.add_option("--filter", target.filter, "only these: 'pl.corner_detection.**'")
      ->type_name("GLOB")
      ->expected(1)
      ->take_all();
}

void add_window(CLI::App& command, TraceCommandOptions& target) {
  command.add_option("--window", target.window, "only then: 6ms:7ms")->type_name("FROM:TO");
}

}  // namespace

void add_trace_command(CLI::App& app, TraceCommandOptions& target) {
  CLI::App* trace = app.add_subcommand("trace", "ask a recorded trace");
  trace->require_subcommand(1);

  CLI::App* list = add(*trace, target, "list", "names and widths of the signals");
  add_file(*list, target);
  add_filter(*list, target);

  CLI::App* stats = add(*trace, target, "stats",
                        "handshakes, buffers, interrupts, frames and functions in numbers");
  add_file(*stats, target);
  add_design(*stats, target);
  stats
      ->add_option("--clock", target.clock,
                   "of the links, if the trace has no clocks (default: 100 MHz)")
      ->type_name("FREQUENCY");
  CLI::Option* json = stats->add_flag("--json", target.json, "for programs");
  stats->add_flag("--csv", target.csv, "for spreadsheets")->excludes(json);

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
  cut->add_option("OUTPUT", target.other, "a .vcd or .fst")->type_name("FILE")->required();
  add_window(*cut, target);
  add_filter(*cut, target);

  CLI::App* convert = add(*trace, target, "convert", "write as the other format, under our names");
  add_file(*convert, target);
  convert->add_option("OUTPUT", target.other, "a .vcd or .fst")->type_name("FILE")->required();

  CLI::App* plot = add(*trace, target, "plot", "draw signals as SVG");
  add_file(*plot, target);
  plot->add_option("SIGNAL", target.signals, "names, or their ends")->type_name("")->required();
  add_window(*plot, target);
  plot->add_option("--marker", target.marker, "a line at a time: 6.1ms")->type_name("TIME");
  plot->add_option("-o,--output", target.output, "picture (default: plot.svg)")->type_name("FILE");

  CLI::App* gtkw = add(*trace, target, "gtkw", "write save and translate files for GTKWave");
  add_file(*gtkw, target);
  add_design(*gtkw, target);
  gtkw->add_option("-o,--output", target.output, "folder (default: here)")->type_name("DIR");
}

}  // namespace platform::cli
