#include <CLI/CLI.hpp>
#include <cstdint>

#include <cli/app.h>

namespace platform::cli {

namespace {

constexpr const char* rtl_check_help =
    R"(  markervp rtl check corner_detection --rtl build demo z2.0 noise.png
Both get the same inputs in the running system: those named, and stimuli that are hard on the logic.
The first output that differs ends it: port, clock and both values are printed, and lockstep.vcd and
lockstep.gtkw show the clocks around it. Else a table says what was exercised; outputs that never
changed are NOT EXERCISED, and the check has not passed (1).)";

constexpr const char* rtl_prove_help =
    R"(  markervp rtl prove axi_threshold_bridge --rtl my_bridge/rtl
Both get the same inputs, all that a system may give them, with the least parameters that are legal
unless you give others. PROVED EQUAL holds on every clock (0). DIFFERENT (1) says on which clock,
prove.vcd shows it, and 'rtl check --stimulus' plays it. EQUAL for N clocks is no proof: it passes
(0) with --depth N, and else it does not (1). UNKNOWN (1) says why.
Without --rtl: that the streams of our RTL keep the rules of AXI4-Stream.
  markervp rtl prove --rtl my_slave.v --top my_slave
Without an IP: that the AXI4, AXI4-Lite and AXI4-Stream links of any RTL keep their rules.)";

constexpr const char* rtl_vectors_help =
    R"(  markervp rtl vectors corner_detection demo noise.png -o vectors
runs the platform and writes what its model sees and does on every clock: stimulus.hex and
response.hex, for $fscanf, $readmemh and textio. bench.sv and bench.vhd play them to RTL.)";

constexpr const char* rtl_compare_help =
    R"(  markervp run demo --trace ours.vcd --trace-clocks
  markervp rtl compare questa.vcd ours.vcd --map ports.yaml
The inputs tell how many clocks one lies behind the other. The first clock in which a port differs
is reported in both, with both values; compare.vcd and compare.gtkw show the clocks around it.
docs/rtl.md has a map.)";

/// How Yosys reads RTL.
template <class Options>
void add_reading_options(CLI::App& command, Options& target) {
  command.add_option("--parameter", target.parameters, "of the module: LABELS=64")
      ->type_name("NAME=NUMBER")
      ->expected(1)
      ->take_all();
  command
      .add_option("--include", target.includes,
                  "where `include finds files, besides the sources' folders")
      ->type_name("DIR")
      ->expected(1)
      ->take_all();
  command.add_option("--define", target.defines, "a macro: FAST, DEPTH=16")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->take_all();
  command
      .add_option("--ghdl-option", target.ghdl_options,
                  "one more for VHDL: --ghdl-option=-fexplicit")
      ->type_name("OPTION")
      ->expected(1)
      ->take_all();
}

void add_rtl_prove(CLI::App& rtl, RtlOptions& target) {
  CLI::App* prove = rtl.add_subcommand("prove", "prove RTL equal to that of an IP, on every clock");
  prove->callback([&target] { target.command = "prove"; });
  RtlProveOptions& options = target.prove;
  prove->add_option("IP", target.ip, "the IP that it replaces: axi_threshold_bridge")
      ->type_name("");
  prove->add_option("--rtl", options.rtl, "your own Verilog or VHDL")->type_name("DIR");
  prove->add_option("--top", options.top, "the module in them (default: that of the IP's name)")
      ->type_name("MODULE");
  prove
      ->add_option("--interface", options.interfaces,
                   "what a port is, without an IP: 'rst: reset high', 'status: wire'")
      ->type_name("PORT: KIND")
      ->expected(1)
      ->take_all();
  prove->add_option("--tie", options.ties, "an input that never changes, without an IP: 'mode=3'")
      ->type_name("PORT=NUMBER")
      ->expected(1)
      ->take_all();
  add_reading_options(*prove, options);
  prove->add_option("--time", options.seconds, "of the processor, for all of it (default: 60)")
      ->type_name("SECONDS")
      ->check(CLI::Range(1u, 1'000'000u));
  prove->add_option("--depth", options.depth, "clocks without a difference that are enough")
      ->type_name("CLOCKS")
      ->check(CLI::Range(std::uint64_t{2}, std::uint64_t{1'000'000}));
  prove->add_option("-o,--output", options.output, "folder for the results (default: out)")
      ->type_name("DIR");
  prove->footer(rtl_prove_help);
}

}  // namespace

void add_rtl(CLI::App& app, RtlOptions& target) {
  CLI::App* rtl = app.add_subcommand("rtl", "RTL and the models of its IP");
  rtl->require_subcommand(1);
  CLI::App* check = rtl->add_subcommand("check", "run RTL in lock-step with its model");
  check->callback([&target] { target.command = "check"; });
  check->add_option("IP", target.ip, "the IP that it replaces: corner_detection")
      ->type_name("")
      ->required();
  check->add_option("--rtl", target.rtl, "what markervp_add_rtl() built, or the folder it lies in")
      ->type_name("FILE")
      ->required();
  check->add_flag("--no-stimuli", target.no_stimuli, "play only these inputs, no hard stimuli");
  check->add_option("--stimulus", target.stimulus, "play this file of rtl prove, and nothing else")
      ->type_name("FILE");
  add_input_options(*check, target.run);
  add_design_option(*check, target.run.configuration);
  add_configuration_options(*check, target.run.configuration);
  check->add_option("-o,--output", target.run.output, "folder for the results (default: out)")
      ->type_name("DIR");
  check->footer(rtl_check_help);
  add_rtl_prove(*rtl, target);
  CLI::App* vectors =
      rtl->add_subcommand("vectors", "write stimulus and response of an IP, and benches for them");
  vectors->callback([&target] { target.command = "vectors"; });
  vectors->add_option("IP", target.ip, "whose ports: corner_detection")->type_name("")->required();
  add_input_options(*vectors, target.run);
  add_design_option(*vectors, target.run.configuration);
  add_configuration_options(*vectors, target.run.configuration);
  vectors->add_option("-o,--output", target.run.output, "folder for the files (default: out)")
      ->type_name("DIR");
  vectors->footer(rtl_vectors_help);
  CLI::App* compare =
      rtl->add_subcommand("compare", "compare a simulation made elsewhere with a trace of ours");
  compare->callback([&target] { target.command = "compare"; });
  compare->add_option("THEIRS", target.compare.theirs, "of Questa, Vivado, Icarus …: VCD or FST")
      ->type_name("FILE")
      ->required();
  compare->add_option("OURS", target.compare.ours, "of run --trace --trace-clocks")
      ->type_name("FILE")
      ->required();
  compare->add_option("--map", target.compare.map, "clock and ports of both, YAML")
      ->type_name("FILE")
      ->required();
  compare
      ->add_option("-o,--output", target.compare.output, "folder for a difference (default: out)")
      ->type_name("DIR");
  compare->footer(rtl_compare_help);
  CLI::App* synth = rtl->add_subcommand("synth", "synthesise with Yosys: LUT, FF, BRAM, DSP, Fmax");
  synth->callback([&target] { target.command = "synth"; });
  RtlSynthOptions& options = target.synth;
  synth->add_option("IP", options.ips, "these IP of the pixel pipeline (default: all)")
      ->type_name("");
  synth->add_option("--rtl", options.rtl, "your own Verilog or VHDL, as often as needed")
      ->type_name("DIR|FILE")
      ->allow_extra_args(false);
  synth->add_option("--top", options.top, "the module in them")->type_name("MODULE");
  add_reading_options(*synth, options);
  synth->add_flag("--no-dsp", options.no_dsp, "build multiplications from LUT");
  synth->add_option("-o,--output", options.output, "the figures as JSON")->type_name("FILE");
}

}  // namespace platform::cli
