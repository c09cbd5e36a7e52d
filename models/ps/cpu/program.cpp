#include <dlfcn.h>
#include <elf.h>

#include <ps/cpu/program.h>
#include <ps/cpu/static_image.h>
#include <vp/error.h>
#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>

namespace ps {

namespace {

constexpr const char* symbol = "hal_program_info";

/// Throws if the description cannot be used. `what` is "program 'x'".
void check(const hal_program& program, const std::string& what) {
  if (program.abi != HAL_ABI) {
    throw vp::InputError(what + " was built for version " + std::to_string(program.abi) +
                         " of the HAL, this is version " + std::to_string(HAL_ABI) +
                         ": rebuild it");
  }
  const bool complete = program.name && program.entry &&
                        (program.work || program.work_count == 0) &&
                        (program.functions || program.function_count == 0) &&
                        (program.options || program.option_count == 0);
  if (!complete) {
    throw vp::InputError(what + " has an incomplete " + symbol +
                         ": it needs a name, an entry, and a table for each count that is not 0");
  }
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

  explicit SharedObject(const std::string& path) : handle_(load(path)), image_(handle_) {}
  // Destructors of static objects then find what their constructors left, however often the program
  // ran.
  ~SharedObject() {
    image_.restore();
    dlclose(handle_);
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
    if (void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) return handle;
    throw vp::InputError("cannot load program '" + path + "': " + dlerror());
  }

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
