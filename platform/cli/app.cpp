#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include <cli/app.h>
#include <cli/program.h>
#include <study/inputs.h>
#include <vp/text.h>

namespace platform::cli {

void add_configuration_options(CLI::App& command, ConfigurationOptions& target) {
  command.add_option("--config", target.files, "YAML file of parameters; later files win")
      ->type_name("FILE")
      ->expected(1)
      ->take_all();
  command.add_option("--set", target.assignments, "one parameter; wins over files")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->take_all();
}

void add_design_option(CLI::App& command, ConfigurationOptions& target) {
  command.add_option("--design", target.design, "what is in the PL ('markervp designs')")
      ->type_name("NAME");
}

namespace {

constexpr const char* examples = R"(Examples:
{}  markervp run --linux ./my_app -- -v       an unmodified Linux application
  markervp run --trace run.vcd --trace-window 6ms:7ms
  markervp run --set ps.fclk_clk0.frequency="40 MHz" --output slower
  markervp sweep mine.yaml                  many design points
  markervp config > platform.yaml           every parameter with its default
  markervp report slower out                compare two runs in a page
  markervp trace stats run.vcd              what a trace says: handshakes, buffers, stages
  markervp map axi_dma_0                    addresses and registers that software sees

Exit codes: 0 done, 1 the program failed or a required job was not done, 2 wrong usage,
configuration or input, or something could not be written, 3 hardware or software broke a protocol
rule.)";

/// Of a program without an application.
constexpr const char* usual_examples =
    R"(  markervp run --design mine.so             a design of your own, results in out/
  markervp run --design mine.so samples.bin with its input, block by block
)";

constexpr const char* usual_run_help =
    R"(INPUT is what the design takes: files of samples, or nothing. With --linux it is an argument of
the application. Results: result.json and report.html.)";

constexpr const char* config_examples =
    R"(What it prints is a file for --config: with the same --program it makes the same run.)";

constexpr const char* import_help =
    R"(Writes design.yaml, xparameters.h, pl.dtsi (devices for Linux), registers.json (for notebooks),
CMakeLists.txt, and IMPORT.md, which says what became of each part. Importing again brings in what
changed in Vivado, and keeps your changes of design.yaml.)";

constexpr const char* report_examples =
    R"(One folder: writes report.html into it. Two folders of runs: a page that compares them.)";

constexpr const char* completion_help = R"(For bash:  source <(markervp completion bash))";

/// Larger numbers than anybody waits for. CLI11 takes what is too long for 64 bits as the largest
/// number.
constexpr std::uint64_t most_frames = 1'000'000'000;
constexpr std::size_t most_clocks = 1'000;

// Type names say to the reader and to the shell completion what a value is: FILE, DIR, or its
// choices with bars.

/// "scenes, images, folders, videos; files of samples": those of the application first.
std::string what_inputs_are() {
  std::vector<std::string> kinds;
  for (const study::InputKind* kind : study::input_kinds()) {
    if (kind->name != std::string_view("none")) kinds.insert(kinds.begin(), kind->what);
  }
  return vp::join(kinds, "; ");
}

void add_input_settings(CLI::App& command, std::map<std::string, std::string>& target) {
  for (const study::InputKind* kind : study::input_kinds()) {
    for (const study::InputSetting& setting : kind->settings) {
      const std::string name = setting.name;
      CLI::Option* option = command.add_option_function<std::string>(
          "--" + name, [&target, name](const std::string& value) { target[name] = value; },
          setting.meaning);
      option->type_name(setting.value);
      const std::vector<std::string> choices = vp::split(setting.value, '|');
      if (choices.size() > 1) option->check(CLI::IsMember(choices).description(""));
    }
  }
}

}  // namespace

void add_input_options(CLI::App& command, RunOptions& target) {
  command.add_option("INPUT", target.inputs, what_inputs_are())->type_name("");
  add_input_settings(command, target.input_settings);
  command.add_option("--frames", target.frames, "stop after this many inputs")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, most_frames).description(""));
  command.add_option("--repeat", target.repeat, "run all inputs this many times")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, most_frames).description(""));
}

namespace {

void add_platform_options(CLI::App& command, PlatformOptions& target) {
  command.add_option("--fidelity", target.fidelity, "how the PL is modelled (default: tlm)")
      ->type_name("tlm|clocked");
  command
      .add_option("--rate", target.rate, "inputs come at this rate: 60 fps (default: when wanted)")
      ->type_name("RATE");
  command
      .add_option("--program", target.program,
                  "PS program: a file, or the name of an installed one")
      ->type_name("FILE");
}

void add_linux_option(CLI::App& command, RunOptions& target) {
  command
      .add_option("--linux", target.linux_app,
                  "run a Linux application; its arguments are what is behind, after --")
      ->type_name("FILE");
}

void add_point_option(CLI::App& command, RunOptions& target) {
  command.add_option("--point", target.point, "run a point of a sweep again: out/NAME:KEY")
      ->type_name("POINT");
}

void add_output_options(CLI::App& command, RunOptions& target) {
  command.add_option("-o,--output", target.output, "folder for the results (default: out)")
      ->type_name("DIR");
  command.add_flag("--require-job", target.require_job,
                   "exit code 1 if a unit of work, or the run, did not do its job");
  for (const Requirement& requirement : application().requirements) {
    const std::string tally = requirement.tally;
    command.add_flag_callback(
        requirement.option, [&target, tally] { target.required.push_back(tally); },
        requirement.meaning);
  }
  command.add_flag("--strict", target.strict, "exit code 1 if the run was warned of something");
  if (application().draw)
    command.add_flag("--no-pictures", target.no_pictures, "no annotated pictures");
  command.add_flag("--no-report", target.no_report, "no page report.html");
  command.add_flag("-q,--quiet", target.quiet, "no lines for each unit of work");
}

void add_trace_options(CLI::App& command, RunOptions& target) {
  command.add_option("--trace", target.trace, "record waveforms, .vcd, .vcd.gz or .fst")
      ->type_name("FILE");
  command.add_option("--trace-window", target.trace_window, "record only then: 6ms:7ms")
      ->type_name("FROM:TO");
  command.add_option("--trace-filter", target.trace_filter, "record only these: 'pl.axi_dma_0.**'")
      ->type_name("GLOB")
      ->expected(1)
      ->take_all();
  command
      .add_option("--trace-level", target.trace_level,
                  "signals; registers inside too; and bus accesses")
      ->type_name("ports|registers|everything")
      ->check(CLI::IsMember({"ports", "registers", "everything"}).description(""));
  command.add_flag("--trace-clocks", target.trace_clocks, "record the clocks too");
  CLI::Option* trigger =
      command
          .add_option("--trace-trigger", target.trace_trigger,
                      "keep the frames in which this comes true: 'pl.axi_dma_0.mm2s_introut rises'")
          ->type_name("CONDITION");
  command.add_option("--trace-before", target.trace_before, "and so many frames before them")
      ->type_name("N")
      ->needs(trigger)
      ->check(CLI::Range(0u, 1000u).description(""));
  command
      .add_option("--trace-frame", target.trace_frame,
                  "a frame begins when this signal changes (default: ps.cpu.frame)")
      ->type_name("SIGNAL")
      ->needs(trigger);
  command
      .add_option("--trace-buffer", target.trace_buffer,
                  "MiB held until a frame is judged (default: 256)")
      ->type_name("N")
      ->needs(trigger)
      ->check(CLI::Range(std::size_t{1}, std::size_t{65536}).description(""));
  command.add_option("--timeline", target.timeline, "write a timeline for ui.perfetto.dev")
      ->type_name("FILE");
  command
      .add_option("--timeline-frames", target.timeline_frames,
                  "record so many frames in timeline and report (default: 2)")
      ->type_name("N")
      ->check(CLI::Range(std::uint32_t{0}, std::uint32_t{1'000'000}).description(""));
}

void add_debug_options(CLI::App& command, RunOptions& target) {
  command.add_option("--log-bus", target.log_bus, "write every bus access")->type_name("FILE");
  command
      .add_option("--log-bus-filter", target.log_bus_filter,
                  "only these: axi_dma_0, 0x41200000, 0x40000000:0x4FFFFFFF")
      ->type_name("DEVICE")
      ->expected(1)
      ->take_all();
  command
      .add_option("--transactions", target.transactions,
                  "write what passes the buses, as 'trace transactions --json' does")
      ->type_name("FILE");
  command
      .add_option("--register-coverage", target.register_coverage,
                  "write which registers and bits the program used")
      ->type_name("FILE");
  command
      .add_option("--software-profile", target.software_profile,
                  "write where the program's time goes, for speedscope.app; and onto the page")
      ->type_name("FILE");
  command
      .add_option("--control", target.control,
                  "let a test lead the run through this socket (docs/program-tests.md)")
      ->type_name("DESCRIPTOR");
  command
      .add_option("--terminal", target.terminals,
                  "make a terminal at the other end of uart0 or uart1, with a link to it")
      ->type_name("UART[=LINK]")
      ->expected(1)
      ->take_all();
}

void add_run(CLI::App& app, RunOptions& target) {
  CLI::App* command = app.add_subcommand("run", "run the platform");
  add_input_options(*command, target);
  add_design_option(*command, target.configuration);
  add_platform_options(*command, target);
  add_linux_option(*command, target);
  add_point_option(*command, target);
  add_configuration_options(*command, target.configuration);
  add_output_options(*command, target);
  add_trace_options(*command, target);
  add_debug_options(*command, target);
  command->footer(application().run_help ? application().run_help : usual_run_help);
}

void add_designs(CLI::App& app, DesignsOptions& target) {
  CLI::App* command =
      app.add_subcommand("designs", "list what may stand in the programmable logic");
  command->add_flag("--json", target.json, "for scripts");
}

void add_config(CLI::App& app, ConfigOptions& target) {
  CLI::App* command = app.add_subcommand("config", "print every parameter as it is in effect");
  command->add_option("PATH", target.path, "only this parameter, or this group: pl, ps.cpu")
      ->type_name("");
  add_platform_options(*command, target);
  add_design_option(*command, target.configuration);
  add_configuration_options(*command, target.configuration);
  command->footer(config_examples);
}

void add_map(CLI::App& app, MapOptions& target) {
  CLI::App* command =
      app.add_subcommand("map", "print memory map, registers, interrupts and clocks");
  command->add_option("DEVICE", target.device, "the registers of this device")->type_name("");
  command->add_flag("--registers", target.registers, "the registers of all devices");
  command->add_flag("--markdown", target.markdown, "everything, as a page of the documentation");
  command->add_flag("--xparameters", target.xparameters,
                    "xparameters.h, as bare-metal code includes it");
  command
      ->add_option_function<std::vector<std::string>>(
          "--device-tree",
          [&target](const std::vector<std::string>& files) {
            target.device_tree = files.empty() ? "" : files.front();
          },
          "the device tree that Linux would have, into a file (default: printed)")
      ->expected(0, 1)
      ->type_name("[FILE]");
  command->add_option("--diagram", target.diagram, "draw a design in YAML: .svg, .png or .dot")
      ->type_name("FILE");
  add_design_option(*command, target.configuration);
  add_configuration_options(*command, target.configuration);
}

void add_import(CLI::App& app, ImportOptions& target) {
  CLI::App* command =
      app.add_subcommand("import", "make a design of a Vivado hand-off: .hwh, .xsa or .hdf");
  command->add_option("FILE", target.file, "the hand-off")->type_name("");
  command->add_option("-o,--output", target.output, "folder (default: the design's name)")
      ->type_name("DIR");
  command->add_option("--rtl", target.rtl, "folders with RTL of its IP")->type_name("DIR");
  command
      ->add_option("--program", target.programs,
                   "sources of its PS program: main.c …, or a folder with them")
      ->type_name("FILE");
  command
      ->add_option("--device", target.device,
                   "import it as for this chip, as xc7z020-1, whose size, speed and power the "
                   "verdict has then")
      ->type_name("NAME");
  command
      ->add_option("--block-design", target.block_design, "which one, of an archive with several")
      ->type_name("NAME");
  command->add_flag("--shelf", target.shelf,
                    "print the IP that has a model, with what is modelled of each (Markdown)");
  command->footer(import_help);
}

void add_report(CLI::App& app, ReportOptions& target) {
  CLI::App* command =
      app.add_subcommand("report", "make the page of a result again, or compare two");
  command->add_option("DIR", target.folders, "folder of a run, sweep or validation; two runs")
      ->type_name("")
      ->expected(1, 2)
      ->required();
  command->add_option("-o,--output", target.output, "file of a comparison (default: compare.html)")
      ->type_name("FILE");
  command->footer(report_examples);
}

void add_devices(CLI::App& app, DevicesOptions& target) {
  CLI::App* command =
      app.add_subcommand("devices", "list the chips that a design can be built for");
  command->add_option("DEVICE", target.device, "every figure of this one, with its source")
      ->type_name("");
  command->add_flag("--json", target.json, "for programs");
}

void add_clocks(CLI::App& app, ClocksOptions& target) {
  CLI::App* command =
      app.add_subcommand("clocks", "list the clocks that PLLs and dividers make near a wish");
  command->add_option("WISH", target.wishes, "frequencies: 55MHz; of FCLK all of one chip")
      ->type_name("")
      ->required();
  command->add_option("--for", target.kind, "which clock (default: fclk)")
      ->type_name("fclk|cpu|cpu-421|ddr|mmcm|pll")
      ->check(CLI::IsMember({"fclk", "cpu", "cpu-421", "ddr", "mmcm", "pll"}).description(""));
  command->add_option("--input", target.input, "of an MMCM or PLL (default: 100 MHz)")
      ->type_name("FREQUENCY");
  command->add_option("--device", target.device, "on this chip (default: xc7z020-1)")
      ->type_name("DEVICE");
  command->add_option("--crystal", target.crystal, "PS_CLK (default: 33.333 MHz)")
      ->type_name("FREQUENCY");
  command->add_option("--count", target.count, "list so many (default: 8)")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, most_clocks).description(""));
  command->add_flag("--no-ethernet", target.no_ethernet, "the I/O PLL feeds no Ethernet");
  command->add_flag("--json", target.json, "for programs");
}

void add_power(CLI::App& app, PowerTableOptions& target) {
  CLI::App* command =
      app.add_subcommand("power", "coefficients of the power model; power of a design's figures");
  command->add_option("TABLE", target.table, "an own table, a file .json")->type_name("FILE");
  command->add_flag("--markdown", target.markdown, "with the source of each");
  CLI::App* estimate = command->add_subcommand(
      "estimate", "watts of a design that is described by LUT, FF, BRAM, DSP and clocks");
  estimate->add_option("FILE", target.design, "its figures, YAML (docs/power.md)")->required();
  estimate->add_option("--table", target.table, "other coefficients: installed, or a file .json")
      ->type_name("TABLE");
}

void add_completion(CLI::App& app, CompletionOptions& target) {
  CLI::App* command =
      app.add_subcommand("completion", "print a script that completes the command line");
  command->add_option("SHELL", target.shell, "for which shell")
      ->type_name("bash")
      ->check(CLI::IsMember({"bash"}).description(""))
      ->required();
  command->footer(completion_help);
}

}  // namespace

std::unique_ptr<CLI::App> make_app(CommandLine& target) {
  const Application& own = application();
  auto app = std::make_unique<CLI::App>(own.description, "markervp");
  app->set_version_flag("--version", version_text());
  app->set_help_flag("-h,--help", "print this help");
  app->require_subcommand(1);
  add_run(*app, target.run);
  add_again(*app, target);
  add_designs(*app, target.designs);
  add_config(*app, target.config);
  add_map(*app, target.map);
  add_import(*app, target.import);
  add_report(*app, target.report);
  add_devices(*app, target.devices);
  add_clocks(*app, target.clocks);
  add_power(*app, target.power);
  add_rtl(*app, target.rtl);
  add_trace_command(*app, target.trace);
  add_exploration(*app, target);
  for (const auto add : own.commands) {
    Command command = add(*app);
    target.application[command.name] = std::move(command.run);
  }
  add_completion(*app, target.completion);
  // Last: commands would take it over.
  app->footer(fmt::format(examples, own.examples ? own.examples : usual_examples));
  return app;
}

namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    const bool hidden = command->get_group().empty();
    if (!hidden) names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  const std::string nearest = vp::nearest_match(word, names);
  return nearest.empty() ? "" : "did you mean '" + nearest + "'? ";
}

/// The command that was chosen, or the program as a whole.
const CLI::App& chosen(const CLI::App& app) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  return commands.empty() ? app : *commands.front();
}

std::string see_help(const CLI::App& app) {
  const CLI::App& command = chosen(app);
  return &command == &app ? "'markervp --help' shows how"
                          : "'markervp " + command.get_name() + " --help' shows how";
}

bool is_input(const std::string& word) {
  const auto& kinds = study::input_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const study::InputKind* kind) {
    if (!kind->names) return false;
    const std::vector<std::string> names = kind->names();
    return std::find(names.begin(), names.end(), word) != names.end();
  });
}

std::string unknown_command(const CLI::App& app, const std::string& word) {
  std::string hint = did_you_mean(word, command_names(app));
  if (hint.empty() && is_input(word)) hint = "did you mean 'markervp run " + word + "'? ";
  return "unknown command '" + word + "': " + hint + "there are " +
         vp::join(command_names(app), ", ");
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        const std::vector<std::string>& arguments) {
  if (arguments.empty()) return "a command is missing: " + vp::one_of(command_names(app));
  const CLI::App& command = chosen(app);
  const bool is_word = arguments.front().rfind('-', 0) != 0;
  if (&command == &app && is_word) return unknown_command(app, arguments.front());
  const std::vector<std::string> extras = app.remaining(true);
  if (!extras.empty()) {
    const std::string name = extras.front().substr(0, extras.front().find('='));
    const std::string kind = name.rfind('-', 0) == 0 ? "unknown option '" : "unexpected argument '";
    return kind + name + "': " + did_you_mean(name, option_names(command)) + see_help(app);
  }
  return std::string(error.what()) + ": " + see_help(app);
}

}  // namespace platform::cli
