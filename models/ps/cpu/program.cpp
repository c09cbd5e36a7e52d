#include <dlfcn.h>
#include <elf.h>
#include <sys/resource.h>

#include <ps/cpu/fault_trap.h>
#include <ps/cpu/program.h>
#include <ps/cpu/program_description.h>
#include <ps/cpu/program_watch.h>
#include <ps/cpu/static_image.h>
#include <vp/error.h>
#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>

namespace ps {

namespace {

constexpr const char* symbol = "hal_program_info";
/// Exit code of the process when it ends in a program's destructor, as of any rule that a program
/// breaks.
constexpr int protocol_broken = 3;

/// Host time that constructors and destructors of a program's static objects may take (decision).
constexpr std::uint64_t most_loading_ns = 10'000'000'000;

/// Stack of the thread that loads programs, as far as the host tells.
std::size_t loading_stack() {
  constexpr std::size_t usual = std::size_t{8} << 20;
  rlimit limit{};
  const bool known = getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return known ? static_cast<std::size_t>(limit.rlim_cur) : usual;
}

/// Runs code that touches a program's file, without a processor. Returns what stopped it; empty if
/// nothing did.
std::string stopped_by(const std::function<void()>& code) {
  struct Call {
    const std::function<void()>& code;
    std::string thrown;
  } call{code, {}};
  FaultTrap trap(loading_stack());
  ProgramWatch::start(~std::uint64_t{0});
  const Fault* fault = trap.call(
      [](void* context) {
        Call& call = *static_cast<Call*>(context);
        try {
          call.code();
        } catch (const std::exception& error) {
          call.thrown = std::string("it threw an exception: ") + error.what();
        } catch (...) {
          call.thrown = "it threw an exception";
        }
      },
      &call, {most_loading_ns});
  ProgramWatch::end();
  return fault ? fault->text() : call.thrown;
}

/// Throws if the description cannot be used. `what` is "program 'x'".
void check(const hal_program& program, const std::string& what) {
  std::string problem;
  const std::string stopped = stopped_by([&] { problem = problem_of(program); });
  if (!stopped.empty()) {
    problem = std::string("has a broken ") + symbol + " (" + stopped +
              "): its counts must be those of its tables";
  }
  if (!problem.empty()) throw vp::InputError(what + " " + problem);
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

/// The loader itself says "no such file" of it. Class and machine are at the same place in all ELF
/// files.
void check_machine(const std::string& path, const Elf64_Ehdr& header) {
  std::ifstream executable("/proc/self/exe", std::ios::binary);
  const auto own = elf_header(executable);
  if (!own ||
      (header.e_machine == own->e_machine && header.e_ident[EI_CLASS] == own->e_ident[EI_CLASS])) {
    return;
  }
  throw vp::InputError("cannot load program '" + path + "': it is for another machine, " +
                       machine_name(header.e_machine) + "; build it for this one, " +
                       machine_name(own->e_machine) + ", with markervp_add_program");
}

/// The loader maps a file as its headers say; touching what a truncated one lacks is a bus error
/// (SIGBUS). What is no ELF file at all is left to the loader's own message.
void check_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  const auto found = elf_header(file);
  if (!found) return;
  const Elf64_Ehdr& header = *found;
  check_machine(path, header);
  std::uint64_t end = header.e_phoff;
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment{};
    file.seekg(static_cast<std::streamoff>(header.e_phoff + i * sizeof segment));
    if (!file.read(reinterpret_cast<char*>(&segment), sizeof segment)) break;
    if (segment.p_type == PT_LOAD) end = std::max(end, segment.p_offset + segment.p_filesz);
  }
  if (file && static_cast<std::uint64_t>(size) >= end) return;
  throw vp::InputError("cannot load program '" + path + "': the file is truncated");
}

class LinkedProgram : public Program {
 public:
  explicit LinkedProgram(const hal_program& description) : Program(description, {}) {}
  void reset() override {}
};

/// A shared object in memory. Loading a file twice gives the same memory, so all users share the
/// picture taken first.
class SharedObject {
 public:
  static std::shared_ptr<SharedObject> open(const std::string& path) {
    static std::map<std::string, std::weak_ptr<SharedObject>> loaded;
    if (auto object = loaded[path].lock()) return object;
    auto object = std::make_shared<SharedObject>(path);
    loaded[path] = object;
    return object;
  }

  explicit SharedObject(const std::string& path)
      : path_(path), handle_(load(path)), image_(handle_) {}
  // Destructors of static objects then find what their constructors left, however often the program
  // ran.
  // A fault in one leaves the loader in the middle of its work: nothing can go on.
  ~SharedObject() {
    image_.restore();
    const std::string stopped = stopped_by([this] { dlclose(handle_); });
    if (stopped.empty()) return;
    std::cerr << "markervp: " << at_end(path_, "destructor", stopped) << std::endl;
    std::_Exit(protocol_broken);
  }
  SharedObject(const SharedObject&) = delete;
  SharedObject& operator=(const SharedObject&) = delete;

  const hal_program* description() const {
    return static_cast<const hal_program*>(dlsym(handle_, symbol));
  }
  void restore() const { image_.restore(); }

 private:
  static void* load(const std::string& path) {
    check_file(path);
    void* handle = nullptr;
    const std::string stopped =
        stopped_by([&] { handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); });
    if (!stopped.empty()) throw vp::ProtocolError(at_end(path, "constructor", stopped));
    if (handle) return handle;
    throw vp::InputError("cannot load program '" + path + "': " + dlerror());
  }

  static std::string at_end(const std::string& path, const char* what, const std::string& problem) {
    return "program '" + path + "': " + problem + ", in the " + what +
           " of a static object: do such work in the entry function";
  }

  std::string path_;
  void* handle_;
  StaticImage image_;
};

class LoadedProgram : public Program {
 public:
  LoadedProgram(std::shared_ptr<SharedObject> object, const hal_program& description,
                std::string path)
      : Program(description, std::move(path)), object_(std::move(object)) {}
  void reset() override { object_->restore(); }

 private:
  std::shared_ptr<SharedObject> object_;
};

/// Throws for what the loader would wait for.
std::string absolute(const std::string& path) {
  const std::string start = "cannot load program '" + path + "': ";
  char resolved[PATH_MAX];
  if (!realpath(path.c_str(), resolved)) throw vp::InputError(start + std::strerror(errno));
  std::error_code ignored;
  if (std::filesystem::is_other(resolved, ignored))
    throw vp::InputError(start + "it is a pipe or a device: name a file");
  return resolved;
}

}  // namespace

std::unique_ptr<Program> Program::linked(const hal_program& description) {
  check(description, "the linked program");
  return std::make_unique<LinkedProgram>(description);
}

std::unique_ptr<Program> Program::load(const std::string& path) {
  const std::string file = absolute(path);
  auto object = SharedObject::open(file);
  const hal_program* description = object->description();
  if (!description) {
    throw vp::InputError("'" + path + "' is not a PS program: it has no symbol " + symbol +
                         " (define it as <hal/hal.h> declares it)");
  }
  check(*description, "program '" + path + "'");
  return std::make_unique<LoadedProgram>(std::move(object), *description, file);
}

}  // namespace ps
