#include <linux_app/application.h>

#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include <elf.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <host/process.h>
#include <vp/error.h>
#include <vp/file.h>

namespace platform {

namespace {

namespace fs = std::filesystem;
using linux_app::What;

/// Of a program.
constexpr std::size_t longest_name = 128;
constexpr const char* shim_name = "libmarkervp_linux.so";
/// How long next() waits, of the host's time.
constexpr int longest_wait_us = 100'000, end_wait_us = 1'000;
/// What it prints while it asks for nothing is read when next() has waited.
constexpr int room_for_output = 1 << 20;

std::string find_shim() {
  const std::vector<std::string> folders = host::library_folders();
  std::error_code ignored;
  for (const std::string& folder : folders) {
    const std::string file = (fs::path(folder) / shim_name).string();
    if (!fs::exists(file, ignored)) continue;
    if (file.find_first_of(": ") == std::string::npos) return file;
    throw vp::InputError("--linux: '" + file +
                         "' has a space or a colon in its path, and LD_PRELOAD takes neither "
                         "(ld.so(8)): install markervp elsewhere");
  }
  throw vp::InputError("--linux: no " + std::string(shim_name) + " in " + folders.front() +
                       ": install markervp whole");
}

/// Of a file that begins as an ELF file does.
std::string machine_problem(const Elf64_Ehdr& header) {
  if (header.e_machine == EM_X86_64 && header.e_ident[EI_CLASS] == ELFCLASS64) return {};
  const bool arm = header.e_machine == EM_ARM || header.e_machine == EM_AARCH64;
  return std::string("is for another machine") + (arm ? ", ARM" : "") +
         ": build it for this one, x86-64 (gcc, not a cross compiler)";
}

/// The loader is what loads the shim.
bool has_loader(std::istream& file, const Elf64_Ehdr& header) {
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment{};
    file.seekg(static_cast<std::streamoff>(header.e_phoff + i * sizeof segment));
    if (!file.read(reinterpret_cast<char*>(&segment), sizeof segment)) return false;
    if (segment.p_type == PT_INTERP) return true;
  }
  return false;
}

/// Why the shim cannot be loaded into it, as the end of a sentence; "" if it can.
std::string problem_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return std::string("cannot be opened: ") + std::strerror(errno);
  if (!S_ISREG(status.st_mode)) return "is no file: name an executable";
  if (::access(path.c_str(), X_OK) != 0) return "may not be executed: chmod +x";
  if ((status.st_mode & (S_ISUID | S_ISGID)) != 0)
    return "is setuid or setgid, and Linux loads no shim into such a program: chmod ug-s";
  std::ifstream file(path, std::ios::binary);
  Elf64_Ehdr header{};
  if (!file.read(reinterpret_cast<char*>(&header), sizeof header) ||
      std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0)
    return "is no executable of Linux (ELF); of a script name the interpreter, and the script as "
           "its first argument";
  const std::string machine = machine_problem(header);
  if (!machine.empty()) return machine;
  if (!has_loader(file, header))
    return "is linked statically, and nothing loads the shim into it: link it without -static";
  return {};
}

std::string absolute(const std::string& file) {
  char path[PATH_MAX];
  return ::realpath(file.c_str(), path) ? path : file;
}

/// The environment with the shim before what is preloaded anyway.
std::vector<std::string> environment(const std::string& shim, const std::string& folder) {
  std::vector<std::string> variables;
  const auto begins = [](const std::string& text, const std::string& with) {
    return text.rfind(with, 0) == 0;
  };
  std::string preloaded = shim;
  for (char** at = environ; *at; ++at) {
    const std::string variable = *at;
    if (begins(variable, "LD_PRELOAD=")) {
      preloaded += ":" + variable.substr(variable.find('=') + 1);
    } else if (!begins(variable, linux_app::folder_variable + std::string("="))) {
      variables.push_back(variable);
    }
  }
  variables.push_back("LD_PRELOAD=" + preloaded);
  variables.push_back(linux_app::folder_variable + std::string("=") + folder);
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

[[noreturn]] void no_process(int error) {
  const std::error_code code(error, std::generic_category());
  if (!vp::HostError::is_cause(code))
    throw std::system_error(code, "no process for the application");
  throw vp::HostError("no process for the application: " + code.message() + vp::advice_for(error));
}

}  // namespace

LinuxApplication::LinuxApplication(const LinuxOptions& options)
    : options_(options),
      name_(fs::path(options.file).filename().string().substr(0, longest_name)),
      path_(absolute(options.file)),
      shim_(find_shim()) {
  const std::string problem = problem_of(path_);
  if (!problem.empty()) throw vp::InputError("--linux: '" + options.file + "' " + problem);
}

LinuxApplication::~LinuxApplication() {
  if (process_ > 0) {
    ::kill(-process_, SIGKILL);
    if (!status_) ::waitpid(process_, nullptr, 0);
  }
  for (const int descriptor : {socket_, output_}) {
    if (descriptor >= 0) ::close(descriptor);
  }
}

// A process group of its own: Ctrl-C is the platform's, which ends the whole group. From a terminal
// it could not read then.
void LinuxApplication::start(const std::string& folder, int memory, Print print) {
  print_ = std::move(print);
  int sockets[2], pipes[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets) != 0) no_process(errno);
  if (::pipe2(pipes, O_CLOEXEC) != 0) no_process(errno);
  socket_ = sockets[0];
  output_ = pipes[0];
  ::fcntl(output_, F_SETFL, O_NONBLOCK);
  ::fcntl(output_, F_SETPIPE_SZ, room_for_output);
  const timeval longest{0, longest_wait_us};
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, sockets[1], linux_app::socket_descriptor);
  posix_spawn_file_actions_adddup2(&actions, memory, linux_app::memory_descriptor);
  posix_spawn_file_actions_adddup2(&actions, pipes[1], STDOUT_FILENO);
  if (::isatty(STDIN_FILENO) != 0)
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  ::sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  ::sigfillset(&signals);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::vector<std::string> words{options_.file};
  words.insert(words.end(), options_.arguments.begin(), options_.arguments.end());
  std::vector<std::string> variables = environment(shim_, folder);
  const int error = ::posix_spawn(&process_, path_.c_str(), &actions, &attributes,
                                  pointers(words).data(), pointers(variables).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  ::close(sockets[1]);
  ::close(pipes[1]);
  if (error != 0) {
    process_ = 0;
    no_process(error);
  }
}

void LinuxApplication::print_output() {
  char text[4096];
  for (ssize_t count = 0; (count = ::read(output_, text, sizeof text)) > 0;)
    print_(text, static_cast<std::size_t>(count));
}

std::optional<LinuxApplication::Asked> LinuxApplication::receive() {
  Asked asked{};
  char text[linux_app::longest_text];
  iovec parts[2] = {{&asked.request, sizeof asked.request}, {text, sizeof text}};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = 2;
  const ssize_t count = ::recvmsg(socket_, &message, 0);
  if (count == 0) silent_ = true;
  const auto fixed = static_cast<ssize_t>(sizeof asked.request);
  if (count < fixed) return std::nullopt;
  asked.text.assign(text, ::strnlen(text, static_cast<std::size_t>(count - fixed)));
  return asked;
}

std::optional<LinuxApplication::Asked> LinuxApplication::next() {
  if (failure_) return std::exchange(failure_, std::nullopt);
  std::optional<Asked> asked;
  if (silent_) {
    ::usleep(end_wait_us);
  } else {
    asked = receive();
  }
  print_output();
  if (asked && asked->request.what == What::died) {
    death_ = {static_cast<int>(asked->request.a), asked->request.b, asked->text};
    asked.reset();
  }
  if (!asked) look_for_end();
  return asked;
}

void LinuxApplication::look_for_end() {
  int status = 0;
  if (::waitpid(process_, &status, WNOHANG) != process_) return;
  print_output();
  status_ = status;
}

void LinuxApplication::answer(const linux_app::Reply& reply) {
  while (::send(socket_, &reply, sizeof reply, MSG_NOSIGNAL) < 0 && errno == EINTR) continue;
}

std::string LinuxApplication::place() {
  linux_app::Reply question{};
  question.kind = linux_app::Reply::Kind::where;
  answer(question);
  while (!silent_) {
    std::optional<Asked> asked = receive();
    if (!asked && errno != EINTR && errno != EAGAIN) return {};
    if (asked && asked->request.what == What::place) return asked->text;
    if (asked && asked->request.what == What::failure) failure_ = std::move(asked);
  }
  return {};
}

// It answers at once, unless it has a handler of its own for that signal.
std::string LinuxApplication::end_for_time() {
  constexpr int most_waits = 500;  // it reads debug information, on a computer that may be busy
  ::kill(process_, linux_app::out_of_time);
  for (int i = 0; i < most_waits && !silent_; ++i) {
    const std::optional<Asked> asked = receive();
    if (asked && asked->request.what == What::died) return asked->text;
  }
  return {};
}

int LinuxApplication::exit_code() const {
  return status_ && WIFEXITED(*status_) ? WEXITSTATUS(*status_) : 0;
}

std::optional<LinuxApplication::Death> LinuxApplication::death() const {
  if (!status_ || !WIFSIGNALED(*status_)) return std::nullopt;
  const int signal = WTERMSIG(*status_);
  if (death_ && death_->signal == signal) return death_;
  return Death{signal, 0, {}};
}

bool LinuxApplication::was_replaced() const {
  if (!silent_ || status_) return false;
  std::error_code ignored;
  const fs::path now = fs::read_symlink("/proc/" + std::to_string(process_) + "/exe", ignored);
  return !now.empty() && now != path_;  // empty: it is about to end
}

}  // namespace platform
