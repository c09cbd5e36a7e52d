#include <CLI/CLI.hpp>
#include <cstdint>

#include <cli/app.h>

namespace platform::cli {

namespace {

constexpr std::size_t most_accesses = 1'000'000;
constexpr std::uint64_t most_events = 1'000'000'000'000;
constexpr std::uint64_t most_faults = 10'000'000;

constexpr const char* history_examples =
    R"(  markervp run demo --program mine.so
  markervp history out --register axi_dma_0.MM2S_DMASR --before 15.2ms
Runs are deterministic: it makes the run again, from the same folder, and writes nothing.)";

constexpr const char* debug_examples =
    R"(  markervp run demo --program mine.so
  markervp debug out --at 15.2ms
  markervp debug out --register axi_dma_0.MM2S_DMASR --access 3
  markervp debug out --warning 1 --command backtrace --command 'info locals'
It makes the run again up to there; gdb is then in the program, with the commands of markervp.gdb
(registers, peek, simtime, program). 'continue' runs on to the next access or warning, or the end.)";

void add_history(CLI::App& app, HistoryOptions& target) {
  CLI::App* command =
      app.add_subcommand("history", "who read or wrote a register last in a run, from which line");
  command->add_option("DIR", target.folder, "folder of the run")->type_name("")->required();
  command
      ->add_option("--register", target.at,
                   "the register, or an address: axi_dma_0.MM2S_DMASR, ddr+0x100, 0x41200000")
      ->type_name("NAME")
      ->required();
  command->add_option("--before", target.before, "before this time: 15.2ms (default: at the end)")
      ->type_name("TIME");
  command->add_option("--count", target.count, "so many accesses (default: 5)")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, most_accesses).description(""));
  command->add_flag("--writes", target.writes_only, "writes only");
  command->footer(history_examples);
}

void add_debug(CLI::App& app, DebugOptions& target) {
  CLI::App* command =
      app.add_subcommand("debug", "gdb in the program of a run, at a moment of that run");
  command->add_option("DIR", target.folder, "folder of the run")->type_name("")->required();
  CLI::Option* at =
      command->add_option("--at", target.at, "at this time: 15.2ms")->type_name("TIME");
  CLI::Option* at_register =
      command
          ->add_option("--register", target.at_register,
                       "at an access of this register or address: axi_dma_0.MM2S_DMASR")
          ->type_name("NAME")
          ->excludes(at);
  command->add_option("--access", target.access, "the one with this number (default: 1)")
      ->type_name("N")
      ->needs(at_register)
      ->check(CLI::Range(std::uint64_t{1}, most_events).description(""));
  command->add_flag("--writes", target.writes_only, "count writes only")->needs(at_register);
  CLI::Option* warning =
      command->add_option("--warning", target.warning, "at the warning with this number")
          ->type_name("N")
          ->excludes(at)
          ->excludes(at_register)
          ->check(CLI::Range(std::uint64_t{1}, most_events).description(""));
  command->add_flag("--failure", "where the program was stopped (default)")
      ->excludes(at)
      ->excludes(at_register)
      ->excludes(warning);
  command->add_option("--command", target.commands, "for gdb, which ends after the last one")
      ->type_name("COMMAND")
      ->expected(1)
      ->take_all();
  command->footer(debug_examples);
}

constexpr const char* faults_examples =
    R"(  markervp faults campaign.yaml --count 10000
A campaign says what runs and what may go wrong: 'design: thesis', 'inputs: [z1.0, z2.0]',
'classes: [bus, memory]' (docs/faults.md). Each fault is drawn from the seed, and can be had again.)";

void add_faults(CLI::App& app, FaultsOptions& target) {
  CLI::App* command = app.add_subcommand(
      "faults", "what the system does when things go wrong: many faults, counted");
  command->add_option("FILE", target.file, "the campaign")->type_name("")->required();
  command->add_option("-o,--output", target.output, "folder of the results (default: out/faults)")
      ->type_name("DIR");
  command->add_option("--count", target.count, "so many faults, whatever the file says")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, most_faults).description(""));
  command->add_option("--seed", target.seed, "draws others than the file's seed")->type_name("N");
  command->add_option("--jobs", target.jobs, "processes at a time (default: one a core)")
      ->type_name("N")
      ->check(CLI::Range(1U, 256U).description(""));
  command->add_flag("--quiet", target.quiet, "no bar");
  command->footer(faults_examples);
}

}  // namespace

void add_again(CLI::App& app, CommandLine& target) {
  add_history(app, target.history);
  add_debug(app, target.debug);
  add_faults(app, target.faults);
}

}  // namespace platform::cli
