#include <vp/foreign_object.h>

#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <string_view>

#include <vp/file.h>
#include <vp/host_ticks.h>
#include <vp/kernel.h>

namespace vp {

namespace {

/// Exit code of a process whose end an object caused, as of any rule that is broken.
constexpr int protocol_broken = 3;

/// Host time that constructors and destructors, or one call of a function, may take (decision).
constexpr std::uint64_t most_ns = 10'000'000'000;
/// Host time that the code gets to return when it was asked to (decision).
constexpr std::uint64_t grace_ns = 2'000'000'000;

/// Stack of the thread that loads objects, as far as the host tells.
std::size_t loading_stack() {
  constexpr std::size_t usual = std::size_t{8} << 20;
  rlimit limit{};
  const bool known = getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return known ? static_cast<std::size_t>(limit.rlim_cur) : usual;
}

/// Empty if the file has none.
std::optional<Elf64_Ehdr> elf_header(std::istream& file) {
  Elf64_Ehdr header{};
  file.seekg(0);
  if (!file.read(reinterpret_cast<char*>(&header), sizeof header)) return std::nullopt;
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return std::nullopt;
  return header;
}

std::string machine_name(std::uint16_t machine) {
  switch (machine) {
    case EM_ARM:
      return "ARM";
    case EM_AARCH64:
      return "AArch64";
    case EM_386:
      return "x86";
    case EM_X86_64:
      return "x86-64";
    default:
      return "ELF machine number " + std::to_string(machine);
  }
}

/// The loader itself says "no such file" of another machine's. Class and machine are at the same
/// place in all ELF files.
std::string problem_of_machine(const ObjectKind& kind, const Elf64_Ehdr& header) {
  std::ifstream executable("/proc/self/exe", std::ios::binary);
  const auto own = elf_header(executable);
  if (!own ||
      (header.e_machine == own->e_machine && header.e_ident[EI_CLASS] == own->e_ident[EI_CLASS])) {
    return {};
  }
  return "it is for another machine, " + machine_name(header.e_machine) +
         "; build it for this one, " + machine_name(own->e_machine) + ", with " + kind.build;
}

/// What is no ELF file at all is left to the loader's own message.
std::string problem_of_file(const ObjectKind& kind, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const auto header = elf_header(file);
  if (!header) return {};
  std::string other_machine = problem_of_machine(kind, *header);
  if (!other_machine.empty()) return other_machine;
  return is_truncated_object(path) ? "the file is truncated: build or copy it again" : "";
}

/// Throws for what the loader would wait for.
std::string absolute(const std::string& path, const std::string& start) {
  char resolved[PATH_MAX];
  if (!realpath(path.c_str(), resolved)) throw InputError(start + std::strerror(errno));
  std::error_code ignored;
  if (std::filesystem::is_other(resolved, ignored))
    throw InputError(start + "it is a pipe or a device: name a file");
  if (std::filesystem::is_directory(resolved, ignored))
    throw InputError(start + "Is a directory; name the shared object in it");
  return resolved;
}

std::string at_end(const ObjectKind& kind, const std::string& path, const char* what,
                   const std::string& problem) {
  return std::string(kind.name) + " '" + path + "': " + problem + ", in the " + what +
         " of a static object: " + kind.advice;
}

/// Ends code that takes too much of the host's time.
class LoadingWatch : private HostTicks::Listener {
 public:
  LoadingWatch() { HostTicks::add(*this); }
  ~LoadingWatch() { HostTicks::remove(*this); }
  LoadingWatch(const LoadingWatch&) = delete;
  LoadingWatch& operator=(const LoadingWatch&) = delete;

 private:
  void on_host_tick(std::uint64_t spent_ns, void* context) override {
    // Instrumented code has had a tick to stop by itself, outside of the C library.
    if (ForeignCode::stop != ForeignCode::Stop::none) return FaultTrap::leave_from_signal(context);
    spent_ns_ += spent_ns;
    if (spent_ns_ >= most_ns) ForeignCode::ask_to_stop(ForeignCode::Stop::host_time);
  }

  std::uint64_t spent_ns_ = 0;
};

/// An object that is kept. A signal handler reads it: never removed.
struct Kept {
  std::uintptr_t first = 0, end = 0;
  char name[512];
};
constexpr std::size_t most_kept = 64;
Kept kept[most_kept];
std::atomic<std::size_t> kept_count{0};

int take_range(dl_phdr_info* info, std::size_t, void* data) {
  Kept& object = *static_cast<Kept*>(data);
  if (info->dlpi_addr != object.first) return 0;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = info->dlpi_phdr[i];
    if (header.p_type == PT_LOAD)
      object.end =
          std::max<std::uintptr_t>(object.end, info->dlpi_addr + header.p_vaddr + header.p_memsz);
  }
  return 1;
}

/// The object whose function is under way.
const char* object_of(const Fault& fault) {
  for (std::size_t i = 0; i < fault.frame_count; ++i) {
    if (const char* name = foreign_object_at(fault.frames[i])) return name;
  }
  return nullptr;
}

std::string text_of(const Fault& fault) {
  const char* const object = object_of(fault);
  const std::string start = object ? std::string(object) + ": " : "";
  if (fault.kind == Fault::Kind::host_time)
    return start + "a call of it has not returned after " +
           std::to_string(most_ns / 1'000'000'000) + " s: does it loop, or wait?";
  return start + fault.text(object ? "it" : "an object") +
         (&fault == FaultTrap::stray() ? ", in a thread of its own" : "");
}

/// Ends a call that takes too long, and code that a stray thread of an object waits for.
class CallWatch : private HostTicks::Listener {
 public:
  explicit CallWatch(const CallLimit& limit) : limit_(limit) { HostTicks::add(*this); }
  ~CallWatch() { HostTicks::remove(*this); }
  CallWatch(const CallWatch&) = delete;
  CallWatch& operator=(const CallWatch&) = delete;

 private:
  void on_host_tick(std::uint64_t spent_ns, void* context) override {
    if (FaultTrap::stray()) return end_for_stray(spent_ns);
    const std::uint64_t now = limit_.progress ? limit_.progress(limit_.context) : 0;
    const bool moves = now != progress_;
    progress_ = now;
    if (moves || ForeignCode::runs || !FaultTrap::in_object(context)) {
      spent_ns_ = 0;
      return;
    }
    spent_ns_ += spent_ns;
    if (spent_ns_ >= most_ns) FaultTrap::leave_object_from_signal(context);
  }
  void end_for_stray(std::uint64_t spent_ns) {
    if (waited_ns_ == 0 && limit_.interrupt) limit_.interrupt();
    waited_ns_ += spent_ns + 1;
    if (waited_ns_ < grace_ns) return;
    remove_part_files();
    constexpr std::string_view text =
        "markervp: an RTL or a design ended or damaged the process in a thread of its own, and the "
        "run does not end: start no threads in it\n";
    static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
    end_process(protocol_broken);
  }

  const CallLimit limit_;
  std::uint64_t progress_ = 0, spent_ns_ = 0, waited_ns_ = 0;
};

struct Call {
  const std::function<void()>& code;
  std::string thrown;
};

void catch_all(void* context) {
  Call& call = *static_cast<Call*>(context);
  try {
    call.code();
  } catch (const std::exception& error) {
    call.thrown = std::string("it threw an exception: ") + error.what();
  } catch (...) {
    call.thrown = "it threw an exception";
  }
}

}  // namespace

bool is_truncated_object(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  const auto header = elf_header(file);
  if (!header) return false;
  std::uint64_t end = std::max(
      header->e_phoff, header->e_shoff + std::uint64_t{header->e_shnum} * header->e_shentsize);
  for (unsigned i = 0; i < header->e_phnum; ++i) {
    Elf64_Phdr segment{};
    file.seekg(static_cast<std::streamoff>(header->e_phoff + i * sizeof segment));
    if (!file.read(reinterpret_cast<char*>(&segment), sizeof segment)) break;
    if (segment.p_type == PT_LOAD) end = std::max(end, segment.p_offset + segment.p_filesz);
  }
  return !file || static_cast<std::uint64_t>(size) < end;
}

std::string stopped_by(const std::function<void()>& code) {
  Call call{code, {}};
  FaultTrap trap(loading_stack());
  const LoadingWatch watch;
  ForeignCode::start();
  const Fault* fault = trap.call(&catch_all, &call);
  ForeignCode::runs = false;
  return fault ? fault->text("it") : call.thrown;
}

void* load_object(const ObjectKind& kind, const std::string& path) {
  const std::string start = std::string("cannot load ") + kind.name + " '" + path + "': ";
  const std::string file = absolute(path, start);
  const std::string problem = problem_of_file(kind, file);
  if (!problem.empty()) throw InputError(start + problem);
  void* handle = nullptr;
  const std::string stopped =
      stopped_by([&] { handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL); });
  if (!stopped.empty()) throw ProtocolError(at_end(kind, path, "constructor", stopped));
  if (!handle) throw InputError(start + load_problem(file, dlerror()));
  return handle;
}

void unload_object(const ObjectKind& kind, const std::string& path, void* handle) {
  const std::string stopped = stopped_by([handle] { dlclose(handle); });
  if (stopped.empty()) return;
  std::cerr << "markervp: " << at_end(kind, path, "destructor", stopped) << std::endl;
  end_process(protocol_broken);
}

void keep_object(const ObjectKind& kind, const std::string& path, void* handle) {
  const link_map* map = nullptr;
  const std::size_t count = kept_count;
  if (count == most_kept || dlinfo(handle, RTLD_DI_LINKMAP, &map) != 0) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (kept[i].first == map->l_addr) return;
  }
  Kept& object = kept[count];
  object.first = map->l_addr;
  std::snprintf(object.name, sizeof object.name, "%s '%s'", kind.name, path.c_str());
  dl_iterate_phdr(&take_range, &object);
  ++kept_count;
}

bool has_kept_objects() {
  return kept_count != 0;
}

const char* foreign_object_at(std::uintptr_t address) {
  for (std::size_t i = 0; i < kept_count; ++i) {
    if (kept[i].first <= address && address < kept[i].end) return kept[i].name;
  }
  return nullptr;
}

void end_if_damaged() {
  if (!has_kept_objects()) return;
  remove_part_files();
  const auto say = [](const char* text) {
    static_cast<void>(!::write(STDERR_FILENO, text, std::strlen(text)));
  };
  say("markervp: the platform's own code failed while ");
  say(kept[0].name);
  say(kept_count == 1 ? " is loaded" : " and others are loaded");
  say(": it wrote where it must not, or this is a bug of markervp: run without it to see\n");
  end_process(protocol_broken);
}

ObjectEnd::ObjectEnd(const Fault& fault) : ProtocolError(text_of(fault)), fault_(fault) {}

void call_objects(const std::function<void()>& code, const CallLimit& limit) {
  const CallWatch watch(limit);
  call_objects(code);
}

void call_objects(const std::function<void()>& code) {
  FaultTrap trap(loading_stack(), FaultTrap::Of::objects);
  const Fault* const stray_before = FaultTrap::stray();
  const Fault* fault = nullptr;
  try {
    fault =
        trap.call([](void* context) { (*static_cast<const std::function<void()>*>(context))(); },
                  const_cast<std::function<void()>*>(&code));
  } catch (...) {
    // It stopped because of the stray thread.
    if (FaultTrap::stray() == stray_before) throw;
  }
  if (!fault && FaultTrap::stray() != stray_before) fault = FaultTrap::stray();
  if (fault) throw ObjectEnd(*fault);
}

void exit_with_objects(int code) {
  std::cout.flush();
  std::fflush(nullptr);
  remove_part_files();  // of what was not unwound
  if (!has_kept_objects()) run_exit_handlers(code);
  FaultTrap trap(loading_stack());
  const LoadingWatch watch;
  ForeignCode::start();
  const Fault* fault =
      trap.call([](void* context) { run_exit_handlers(*static_cast<int*>(context)); }, &code);
  const std::string text = fault ? text_of(*fault) : "";
  std::fprintf(stderr, "markervp: %s, in the destructor of a static object: leave it out\n",
               text.c_str());
  end_process(protocol_broken);
}

}  // namespace vp
