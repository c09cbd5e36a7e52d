#include "programs.h"

#include <fstream>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bench {

namespace {

double milliseconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) / 1e3;
}

/// The last line of a file that is not empty.
std::string last_line(const std::string& path) {
  std::ifstream file(path);
  std::string last;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

pid_t start(const Command& command, const std::string& folder) {
  std::vector<char*> arguments;
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const auto open = [&](int descriptor, const std::string& file, int flags) {
    posix_spawn_file_actions_addopen(&actions, descriptor, file.c_str(), flags, 0600);
  };
  open(STDIN_FILENO, "/dev/null", O_RDONLY);
  open(STDOUT_FILENO, folder + "/stdout", O_WRONLY | O_CREAT | O_TRUNC);
  open(STDERR_FILENO, folder + "/stderr", O_WRONLY | O_CREAT | O_TRUNC);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t process = 0;
  const int error =
      ::posix_spawn(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("cannot start " + command[0]);
  return process;
}

}  // namespace

ProcessResult run_process(const Command& command, const std::string& folder) {
  const pid_t process = start(command, folder);
  int status = 0;
  rusage usage{};
  ::wait4(process, &status, 0, &usage);
  ProcessResult result;
  result.usage.cpu_ms = milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime);
  result.usage.memory_mb = static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
  result.succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (!result.succeeded) {
    result.message = WIFSIGNALED(status) ? "ended by signal " + std::to_string(WTERMSIG(status))
                                         : last_line(folder + "/stderr");
  }
  return result;
}

namespace {

/// Frames per process that take some tenths of a second: long against the clock's resolution, short
/// against what disturbs.
struct FrameProgram {
  const char* name;
  const char* executable;
  const char* mode;
  int frames;
};

constexpr FrameProgram detectors[] = {
    {"thesis", "bench_rtl_thesis_frames", "", 2},
    {"clocked", "bench_clocked_frames", "ports", 15},
    {"lean", "bench_rtl_lean_frames", "", 3},
    {"registers", "bench_clocked_frames", "registers", 5},
    {"vcd", "bench_clocked_frames", "vcd", 5},
};

constexpr FrameProgram functions[] = {
    {"function", "bench_function_frames", "fast", 1000},
    {"scalar", "bench_function_frames", "scalar", 300},
    {"naive", "bench_function_frames", "naive", 20},
};

/// The two activities stand in the columns of the quiet image and of the worst one.
constexpr const char* vcd_modes[][2] = {
    {"untraced/demo", "untraced"}, {"own/demo", "own"},
    {"sc_trace/demo", "sc_trace"}, {"untraced/noise", "untraced-busy"},
    {"own/noise", "own-busy"},     {"sc_trace/noise", "sc_trace-busy"},
};

class List {
 public:
  explicit List(const ProgramOptions& options) : options_(options) {}

  void add_frames(const FrameProgram& program, const std::string& image,
                  const std::vector<std::string>& settings = {}) {
    Command arguments{"--image=" + image, "--frames=" + std::to_string(program.frames)};
    if (*program.mode) arguments.push_back(std::string("--mode=") + program.mode);
    for (const std::string& setting : settings) arguments.push_back("--set=" + setting);
    add_benchmark(std::string(program.name) + "/" + image, program.executable, arguments);
  }

  void add_benchmark(const std::string& name, const std::string& executable,
                     const Command& arguments) {
    Command command{options_.folder + "/" + executable,
                    std::string("--benchmark_out=") + json_file};
    command.insert(command.end(), arguments.begin(), arguments.end());
    programs_.push_back({name, Program::Kind::benchmark, command});
  }

  void add_run(const std::string& name, const Command& arguments) {
    Command command{options_.folder + "/markervp",  "run", "demo", "--output", "out", "--set",
                    "fidelity=" + options_.fidelity};
    command.insert(command.end(), arguments.begin(), arguments.end());
    programs_.push_back({name, Program::Kind::process, command});
  }

  std::vector<Program> take() { return std::move(programs_); }

 private:
  const ProgramOptions& options_;
  std::vector<Program> programs_;
};

void add_systems(List& list, const ProgramOptions& options, const std::string& image) {
  const bool fast = options.fidelity == "tlm";
  const std::string fidelity = "fidelity=" + options.fidelity;
  constexpr const char* executable = "bench_system_frames";
  const int frames = fast ? 300 : 5;
  list.add_frames({"preloaded", executable, "preload", frames}, image, {fidelity});
  for (const FrameProgram& program : functions) list.add_frames(program, image);
  list.add_frames({"uploaded", executable, "upload", frames}, image, {fidelity});
  list.add_frames({"improved", executable, "preload", frames}, image,
                  {fidelity, "design=improved", "profile=a9-O2"});
  if (options.parts && fast) {
    list.add_frames({"uploaded_clocked", executable, "upload", 5}, image, {"fidelity=clocked"});
  }
}

/// Each IP as RTL in the platform, next to the platform with its model and to that RTL alone.
void add_rtl(List& list, const ProgramOptions& options, const std::string& image) {
  for (const auto& [ip, around] : rtl_ips()) {
    std::vector<std::string> settings{"fidelity=tlm"};
    settings.insert(settings.end(), around.begin(), around.end());
    constexpr const char* executable = "bench_system_frames";
    list.add_frames({("modelled_" + ip).c_str(), executable, "preload", 5}, image, settings);
    settings.push_back("pl.fidelity." + ip + "=" + options.folder + "/bench_rtl_" + ip + ".so");
    list.add_frames({("mixed_" + ip).c_str(), executable, "preload", 5}, image, settings);
    list.add_frames({("alone_" + ip).c_str(), executable, "alone", 5}, image, settings);
  }
}

}  // namespace

std::vector<Program> programs(const ProgramOptions& options) {
  List list(options);
  for (const std::string& image : options.images) {
    for (const FrameProgram& program : detectors) list.add_frames(program, image);
    add_systems(list, options, image);
    if (options.parts) add_rtl(list, options, image);
  }
  for (const auto& [name, mode] : vcd_modes) {
    list.add_benchmark(name, "bench_vcd_writing", {"--frames=8", std::string("--mode=") + mode});
  }
  list.add_benchmark("reading/demo", "bench_trace_reading", {"--frames=3", "--mode=quiet"});
  list.add_benchmark("reading/noise", "bench_trace_reading", {"--frames=3", "--mode=busy"});
  list.add_run("run/demo", {});
  if (options.parts) list.add_benchmark("", "bench_kernels", {"--benchmark_min_time=0.1"});
  return list.take();
}

Program memory_run(const ProgramOptions& options, const std::string& name, int frames) {
  List list(options);
  list.add_run(name,
               {"--repeat", std::to_string(frames), "--no-pictures", "--no-report", "--quiet"});
  return list.take().front();
}

std::vector<std::vector<std::string>> equal_groups(const std::vector<std::string>& images) {
  std::vector<std::vector<std::string>> groups;
  for (const std::string& image : images) {
    auto& group = groups.emplace_back();
    for (const FrameProgram& program : detectors) {
      group.push_back(std::string(program.name) + "/" + image);
    }
  }
  return groups;
}

}  // namespace bench
