// What can be asked about a run that is over: it is made again for that.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cli/commands.h>
#include <cli/options.h>
#include <cli/program.h>
#include <host/document.h>
#include <host/output_folder.h>
#include <host/process.h>
#include <result/result_json.h>
#include <vp/error.h>
#include <vp/text.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <ostream>
#include <sstream>
#include <system_error>
#include <vector>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;

/// Of the run in `folder`. What it wrote beside its folder is left out.
RunOptions options_of(const std::string& folder) {
  const fs::path file = fs::path(folder) / "result.json";
  const result::Json result = host::read_json<result::Json>(file, "result", host::largest_result);
  std::vector<std::string> arguments;
  try {
    result.at("provenance").at("command_line").get_to(arguments);
  } catch (const result::Json::exception&) {
  }
  if (arguments.empty() || arguments.front() != "run")
    throw vp::InputError("'" + file.string() + "' is not of 'markervp run'");
  CommandLine line;
  parse_again(arguments, line);
  RunOptions& run = line.run;
  if (run.control) throw vp::InputError("a test led this run: make it again with that test");
  if (!run.terminals.empty()) {
    throw vp::InputError(
        "this run had a terminal (--terminal), and when each key was typed is not known:  "
        "type it with a test instead (docs/program-tests.md), that is the same each time");
  }
  run.trace.reset();
  run.trace_trigger.reset();
  run.trace_window.reset();
  run.trace_filter.clear();
  run.trace_clocks = false;
  run.log_bus.reset();
  run.log_bus_filter.clear();
  run.transactions.reset();
  run.timeline.reset();
  run.register_coverage.reset();
  run.software_profile.reset();
  return run;
}

}  // namespace

int tell_history(const HistoryOptions& options, std::ostream& out) {
  RunOptions run = options_of(options.folder);
  run.history = options;
  MemoryRun again;
  std::ostringstream told_before;
  try {
    run_in_memory(run, again, told_before);
  } catch (const vp::ProtocolError&) {  // as the run ended that is asked about
  }
  if (again.history.empty()) {
    out << "no " << (options.writes_only ? "write" : "access") << " of " << options.at
        << (options.before ? " before " + *options.before : "") << "\n";
  }
  for (const std::string& text : again.history) out << text << "\n";
  return done;
}

namespace {

/// Starts the run. Its process stops at the moment that is asked for, and ends with this one, and
/// with what becomes of this one.
pid_t start(const RunOptions& run, std::ostream& out, std::ostream& err) {
  out.flush();
  const pid_t process = ::fork();
  if (process < 0) throw std::system_error(errno, std::generic_category(), "no process for a run");
  if (process > 0) return process;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  MemoryRun again;
  again.console = &out;
  int code = host::exit_code_of([&] { return run_in_memory(run, again, err); }, err);
  if (!again.missed_stop.empty()) code = host::fail(err, again.missed_stop, wrong_input);
  out.flush();
  ::_exit(code);
}

/// Waits until it stops or ends. True: it stopped.
bool stopped(pid_t process, int& status) {
  while (true) {
    if (::waitpid(process, &status, WUNTRACED) < 0 && errno != EINTR) return false;
    if (!WIFSTOPPED(status)) return false;
    if (WSTOPSIG(status) == SIGSTOP) return true;
  }
}

/// 0, or why this process may not trace the one that is stopped.
int trace_problem(pid_t process) {
  if (::ptrace(PTRACE_SEIZE, process, nullptr, nullptr) != 0) return errno;
  ::waitpid(process, nullptr, 0);
  ::ptrace(PTRACE_DETACH, process, nullptr, nullptr);
  return 0;
}

/// What gdb does first. How it finds the process on its way is of no interest.
std::string session(pid_t process) {
  std::error_code ignored;
  const fs::path root = fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
  return "source " + (root / "share/markervp/markervp.gdb").string() + "\n" +
         "set logging file /dev/null\nset logging redirect on\nset logging enabled on\n" +
         "attach " + std::to_string(process) + "\n" +
         "handle SIGSTOP nostop noprint nopass\n"
         "break markervp_stop\ncommands\nsilent\nprogram\nend\n"
         "set logging enabled off\n"
         "program\n";
}

/// A file without a name, for a command of this process's.
std::string file_with(const std::string& text) {
  const int file = ::memfd_create("session.gdb", 0);
  if (file < 0 || ::write(file, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    throw std::system_error(errno, std::generic_category(), "no file for gdb");
  return "/dev/fd/" + std::to_string(file);
}

/// This process becomes gdb. Returns only if that fails.
void become_gdb(pid_t process, const std::vector<std::string>& commands) {
  std::vector<std::string> words{
      "gdb", "-q", "-iex", "set print symbol-loading off", "-x", file_with(session(process))};
  if (!commands.empty()) words.push_back("-batch");
  for (const std::string& command : commands) words.insert(words.end(), {"-ex", command});
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::unsetenv("DEBUGINFOD_URLS");  // it would ask whether to look for sources there
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_DFL);
  ::execvp(argv[0], argv.data());
}

}  // namespace

int debug_run(const DebugOptions& options, std::ostream& out, std::ostream& err) {
  RunOptions run = options_of(options.folder);
  if (run.linux_app) {
    throw vp::InputError(
        "this run had a Linux application (--linux), which is a process of its own: 'markervp "
        "history' tells who accessed a register, from which line");
  }
  run.debug = options;
  const pid_t process = start(run, out, err);
  int status = 0;
  if (!stopped(process, status)) return WIFEXITED(status) ? WEXITSTATUS(status) : protocol_broken;
  const int problem = trace_problem(process);
  if (problem == 0) become_gdb(process, options.commands);
  const std::string reason = std::strerror(errno);
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
  if (problem != 0) {
    throw vp::InputError(std::string("no debugger may look at processes here (") +
                         std::strerror(problem) +
                         "): in a container, start it with --cap-add=SYS_PTRACE");
  }
  throw vp::InputError("cannot start gdb (" + reason + "): install it, 'apt-get install gdb'");
}

}  // namespace platform::cli
