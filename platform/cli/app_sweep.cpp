#include <cli/app.h>

#include <CLI/CLI.hpp>
#include <cstdint>

namespace platform::cli {

namespace {

constexpr std::uint64_t most_points = 10'000'000;
constexpr std::uint32_t most_jobs = 1024;
constexpr std::uint32_t most_tasks = 1'000'000;

constexpr const char* sweep_help =
    R"(FILE is a YAML file (docs/exploration.md), or a study that --list shows:
  markervp sweep pixel-clock                   results in out/pixel-clock
  markervp sweep mine.yaml --dry-run           check it and show its points
  markervp sweep mine.yaml --engine slurm      on a cluster
A sweep may be stopped at any time: the same command goes on. No point is computed twice.)";

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

void add_sweep(CLI::App& app, SweepOptions& target) {
  CLI::App* command = app.add_subcommand("sweep", "compute many design points");
  command->add_option("FILE", target.file, "what to sweep")->type_name("");
  command->add_flag("--list", target.list, "the studies that come with the program");
  command->add_option("-o,--output", target.output, "folder for the results (default: out/NAME)")
      ->type_name("DIR");
  command->add_option("--limit", target.limit, "only the first points")
      ->type_name("N")
      ->check(number_range(std::uint64_t{1}, most_points));
  command->add_flag("--yes", target.yes, "run even a very large sweep");
  command->add_flag("--dry-run", target.dry_run, "check everything, show the points, run nothing");
  command->add_flag("--no-report", target.no_report, "no page report.html");
  command->add_flag("--require-all", target.require_all, "exit code 1 if a point failed to run");
  add_run_options(*command, target);
  command->footer(sweep_help);
}

/// What Slurm calls. Not for people: without a group it is in no help.
void add_sweep_worker(CLI::App& app, SweepWorkerOptions& target) {
  CLI::App* command = app.add_subcommand("sweep-worker", "compute a task of a sweep on a cluster");
  command->group("");
  command->add_option("DIR", target.folder, "the sweep")->required();
  command->add_option("SUBMISSION", target.submission, "its number")->required();
  command->add_option("TASK", target.task, "its number")->required();
  command->add_option("POINTS", target.points_a_process, "points a process")->required();
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
  command->add_option("DIR", target.folder, "folder of the sweep")->type_name("DIR")->required();
  command->add_option("--figure", target.figures, "of what (default: the sweep's objectives)")
      ->type_name("FIGURE")
      ->expected(1)
      ->take_all();
  command->add_flag("--all", target.all, "take all points that ran, feasible or not");
}

void add_compare(CLI::App& app, CompareOptions& target) {
  CLI::App* command = app.add_subcommand("compare", "in what two runs or points differ");
  command->add_option("A", target.first, "result.json, its folder, or a point's file")
      ->type_name("FILE")
      ->required();
  command->add_option("B", target.second, "the other")->type_name("FILE")->required();
}

}  // namespace

void add_exploration(CLI::App& app, CommandLine& target) {
  add_sweep(app, target.sweep);
  add_sweep_worker(app, target.sweep_worker);
  add_pareto(app, target.pareto);
  add_sensitivity(app, target.sensitivity);
  add_compare(app, target.compare);
}

}  // namespace platform::cli
