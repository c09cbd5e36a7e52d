#include <chip/linux_app/application.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
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
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <host/process.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/foreign_object.h>
#include <vp/host_ticks.h>

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
    std::string file = (fs::path(folder) / shim_name).string();
    if (!fs::exists(file, ignored)) continue;
    if (::access(file.c_str(), R_OK) != 0)
      throw vp::InputError("--linux: '" + file + "' cannot be read (" + std::strerror(errno) +
                           "), and the application would run without it: install markervp whole");
    if (file.find_first_of(": ") == std::string::npos) return file;
    throw vp::InputError("--linux: '" + file +
                         "' has a space or a colon in its path, and LD_PRELOAD takes neither "
                         "(ld.so(8)): install markervp elsewhere");
  }
  throw vp::InputError("--linux: no " + std::string(shim_name) + " in " + folders.front() +
                       ": install markervp whole");
}

/// Of a file that begins as an ELF file does. The shim is built for one machine and decodes its
/// instructions.
std::string machine_problem(const Elf64_Ehdr& header) {
  const bool has_64_bits = header.e_ident[EI_CLASS] == ELFCLASS64;
  if (header.e_machine == EM_X86_64 && has_64_bits) return {};
  const std::string advice = ": build it for this computer, x86-64 (gcc, no cross compiler";
  switch (header.e_machine) {
    case EM_ARM:
      return "is for ARM, 32 bits, as the board runs it, and this computer has no such processor" +
             advice + ")";
    case EM_AARCH64:
      return "is for ARM, 64 bits" + advice + ")";
    case EM_386:
    case EM_X86_64:
      return "is of 32 bits (gcc " + std::string(header.e_machine == EM_386 ? "-m32" : "-mx32") +
             "), and the shim has 64" + advice + ", without that option)";
    default:
      return "is for another machine" + advice + ")";
  }
}

/// The path of its loader, which also loads the shim; "" if it has no loader.
std::string loader_of(std::istream& file, const Elf64_Ehdr& header) {
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment{};
    file.seekg(static_cast<std::streamoff>(header.e_phoff + i * sizeof segment));
    if (!file.read(reinterpret_cast<char*>(&segment), sizeof segment)) return {};
    if (segment.p_type != PT_INTERP) continue;
    std::string path(std::min<std::size_t>(segment.p_filesz, PATH_MAX), '\0');
    file.seekg(static_cast<std::streamoff>(segment.p_offset));
    file.read(path.data(), static_cast<std::streamsize>(path.size()));
    return path.c_str();
  }
  return {};
}

/// What Linux gives a program that its user does not have; it loads no library of the user's then.
std::string privilege_of(const std::string& path, const struct stat& status) {
  if ((status.st_mode & (S_ISUID | S_ISGID)) != 0)
    return "is setuid or setgid, and Linux loads no shim into such a program: chmod ug-s";
  if (::getxattr(path.c_str(), "security.capability", nullptr, 0) > 0)
    return "has file capabilities, and Linux loads no shim into such a program, which would reach "
           "this computer's own devices: setcap -r";
  return {};
}

/// Why the shim cannot be loaded into it, as the end of a sentence; "" if it can.
std::string problem_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return std::string("cannot be opened: ") + std::strerror(errno);
  if (!S_ISREG(status.st_mode)) return "is no file: name an executable";
  if (::access(path.c_str(), X_OK) != 0) return "may not be executed: chmod +x";
  std::string privilege = privilege_of(path, status);
  if (!privilege.empty()) return privilege;
  std::ifstream file(path, std::ios::binary);
  Elf64_Ehdr header{};
  if (!file.read(reinterpret_cast<char*>(&header), sizeof header) ||
      std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0)
    return "is no executable of Linux (ELF); of a script name the interpreter, and the script as "
           "its first argument";
  std::string machine = machine_problem(header);
  if (!machine.empty()) return machine;
  if (vp::is_truncated_object(path)) return "is truncated: build or copy it again";
  const std::string loader = loader_of(file, header);
  if (loader.empty())
    return "is linked statically, and nothing loads the shim into it: link it without -static";
  if (fs::path(loader).filename().string().rfind("ld-linux", 0) != 0)
    return "is linked with another C library than glibc ('" + loader +
           "'), which the shim replaces functions of: build it with this computer's gcc";
  return {};
}

/// Linux maps no library of such a file system, and the application would run without it.
void check_shim(const std::string& shim) {
  struct statvfs status {};
  if (::statvfs(shim.c_str(), &status) != 0 || (status.f_flag & ST_NOEXEC) == 0) return;
  throw vp::InputError("--linux: '" + shim +
                       "' lies on a file system that is mounted noexec, so no application can load "
                       "it, and it would reach this computer's own devices: install markervp "
                       "elsewhere, or mount it with exec");
}

/// Those of the shim lie behind those of the application.
void check_descriptors() {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  if (limit.rlim_cur >= linux_app::fewest_descriptors) return;
  throw vp::InputError("--linux: this shell allows " + std::to_string(limit.rlim_cur) +
                       " open files, and the application needs " +
                       std::to_string(linux_app::fewest_descriptors) + " to reach the platform: " +
                       "'ulimit -n " + std::to_string(linux_app::fewest_descriptors) + "' or more");
}

std::string absolute(const std::string& file) {
  char path[PATH_MAX];
  return ::realpath(file.c_str(), path) ? path : file;
}

/// The environment with the shim before what is preloaded anyway. AddressSanitizer wants to be
/// first there, and need not be: what the shim replaces calls its functions.
std::vector<std::string> environment(const std::string& shim, const std::string& folder) {
  constexpr const char *preload = "LD_PRELOAD=", *sanitizer = "ASAN_OPTIONS=";
  std::vector<std::string> variables;
  std::string preloaded = shim, options;
  for (char** at = environ; *at; ++at) {
    const std::string variable = *at;
    const std::string value = variable.substr(variable.find('=') + 1);
    const auto is = [&](const std::string& name) { return variable.rfind(name, 0) == 0; };
    if (is(preload)) {
      preloaded += ":" + value;
    } else if (is(sanitizer)) {
      options = value + ":";
    } else if (!is(linux_app::folder_variable + std::string("="))) {
      variables.push_back(variable);
    }
  }
  variables.push_back(preload + preloaded);
  variables.push_back(sanitizer + options + "verify_asan_link_order=0");
  variables.push_back(linux_app::folder_variable + std::string("=") + folder);
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  list.reserve(words.size() + 1);
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

/// The same file with a number that no descriptor of the application's has.
int move_away(int descriptor) {
  return ::fcntl(descriptor, F_DUPFD_CLOEXEC, linux_app::memory_descriptor + 1);
}

/// Where the application's process has them; false: errno says why not.
bool place_descriptors(int socket, int memory, int output) {
  const int ask = move_away(socket), ddr = move_away(memory);
  if (ask < 0 || ddr < 0 || ::dup2(ask, linux_app::socket_descriptor) < 0 ||
      ::dup2(ddr, linux_app::memory_descriptor) < 0 || ::dup2(output, STDOUT_FILENO) < 0)
    return false;
  return ::isatty(STDIN_FILENO) == 0 ||
         ::dup2(::open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO) == STDIN_FILENO;
}

}  // namespace

LinuxApplication::LinuxApplication(const LinuxOptions& options)
    : options_(options),
      name_(fs::path(options.file).filename().string().substr(0, longest_name)),
      path_(absolute(options.file)),
      shim_(find_shim()) {
  const std::string problem = problem_of(path_);
  if (!problem.empty()) throw vp::InputError("--linux: '" + options.file + "' " + problem);
  check_shim(shim_);
  check_descriptors();
}

LinuxApplication::~LinuxApplication() {
  vp::HostTicks::follow(0);
  tree_.reset();
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
  socket_ = sockets[0];
  if (::pipe2(pipes, O_CLOEXEC) != 0) no_process(errno);
  output_ = pipes[0];
  ::fcntl(output_, F_SETFL, O_NONBLOCK);
  ::fcntl(output_, F_SETPIPE_SZ, room_for_output);
  const timeval longest{0, longest_wait_us};
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);

  std::vector<std::string> words{options_.file};
  words.insert(words.end(), options_.arguments.begin(), options_.arguments.end());
  std::vector<std::string> variables = environment(shim_, folder);
  const std::vector<char*> argv = pointers(words), envp = pointers(variables);
  const auto become = [&] {
    if (!place_descriptors(sockets[1], memory, pipes[1])) return errno;
    ::execve(path_.c_str(), argv.data(), envp.data());
    return errno;
  };
  int error = 0;
  try {
    tree_.emplace(become);
    process_ = user_ = tree_->first();
    // It computes while the platform waits for it.
    vp::HostTicks::follow(tree_->root());
  } catch (const std::system_error& problem) {
    error = problem.code().value();
  }
  ::close(sockets[1]);
  ::close(pipes[1]);
  if (error != 0) no_process(error);
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
    note_death(*asked);
    asked.reset();
  } else if (asked && asked->request.what != What::failure) {
    user_ = static_cast<pid_t>(asked->request.process);
  }
  if (!asked) look_for_end();
  return asked;
}

void LinuxApplication::note_death(const Asked& asked) {
  const std::size_t end = std::min(asked.text.find('\n'), asked.text.size());
  deaths_[static_cast<pid_t>(asked.request.process)] = {
      static_cast<int>(asked.request.a), asked.request.b, asked.text.substr(0, end),
      asked.text.substr(std::min(end + 1, asked.text.size()))};
}

// A copy whose own parent waited for it was that one's matter. What has gone has been noted.
void LinuxApplication::look_for_end() {
  const bool user_has_gone = ::kill(user_, 0) != 0 && errno == ESRCH;
  while (const std::optional<host::ProcessTree::End> end = tree_->next_end())
    ends_[end->process] = end->status;
  if (tree_->lost() && !failure_) return note_loss();
  if (!silent_ || ends_.count(process_) == 0 || !user_has_gone) return;
  print_output();
  const bool by_copy = ends_[process_] == 0 && ends_.count(user_) != 0;
  ended_ = by_copy ? user_ : process_;
  status_ = ends_[ended_];
}

// The application and what it started are in a group of their own, with the exception of sessions.
void LinuxApplication::note_loss() {
  ::kill(-process_, SIGKILL);
  failure_.emplace();
  failure_->request.what = What::failure;
  failure_->text =
      "the process between markervp and the application, which notes its end, was ended from "
      "outside: let the application send signals to none but its own processes, and leave enough "
      "memory";
}

bool LinuxApplication::is_stopped() const {
  std::ifstream file("/proc/" + std::to_string(user_) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t state = text.rfind(") ");
  return state != std::string::npos && text.compare(state + 2, 1, "T") == 0;
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

// It answers at once, unless it has a handler of its own for that signal, or is just ending.
std::string LinuxApplication::end_for_time() {
  // It reads debug information, on a computer that may be busy. Ticks interrupt receive().
  constexpr std::chrono::minutes longest_answer{1};
  look_for_end();
  if (ends_.count(user_) != 0 || is_stopped()) return {};
  ::kill(user_, linux_app::out_of_time);
  const auto end = std::chrono::steady_clock::now() + longest_answer;
  while (!silent_ && !host::InterruptGuard::noted() && std::chrono::steady_clock::now() < end) {
    const std::optional<Asked> asked = receive();
    if (!asked) look_for_end();
    if (ends_.count(user_) != 0) return {};
    if (!asked || asked->request.what != What::died) continue;
    note_death(*asked);
    return deaths_[static_cast<pid_t>(asked->request.process)].place;
  }
  return {};
}

int LinuxApplication::exit_code() const {
  return status_ && WIFEXITED(*status_) ? WEXITSTATUS(*status_) : 0;
}

std::optional<LinuxApplication::Death> LinuxApplication::death() const {
  if (!status_ || !WIFSIGNALED(*status_)) return std::nullopt;
  const int signal = WTERMSIG(*status_);
  const auto told = deaths_.find(ended_);
  if (told != deaths_.end() && told->second.signal == signal) return told->second;
  return Death{signal, linux_app::no_address, {}, {}};
}

// The kernel closes descriptors after it has taken the file away of what ends.
std::optional<std::string> LinuxApplication::replacement() const {
  if (!silent_ || status_) return std::nullopt;
  std::error_code ignored;
  const fs::path now = fs::read_symlink("/proc/" + std::to_string(user_) + "/exe", ignored);
  if (now.empty()) return std::nullopt;
  return now.string();
}

}  // namespace platform
