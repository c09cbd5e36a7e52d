#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <unistd.h>

#include <ps/cpu/program.h>
#include <ps/cpu/program_watch.h>
#include <vp/error.h>
#include <vp/fault_trap.h>
#include <vp/foreign_object.h>
#include <algorithm>
#include <cerrno>
#include <climits>
#include <cmath>
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
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ps {

namespace {

/// A copy of the writable static memory of a loaded shared object (.data, .bss, without what the
/// loader made read-only), taken on construction: right after loading, when the constructors of
/// static objects have run.
///
/// Heap memory that static objects own is not part of it.
class StaticImage {
 public:
  /// `handle` from dlopen(). Throws std::runtime_error if the object cannot be found among the
  /// loaded ones.
  explicit StaticImage(void* handle);

  /// Puts everything back as it was.
  void restore() const;

 private:
  struct Range {
    unsigned char* address;
    std::vector<unsigned char> bytes;
  };
  std::vector<Range> ranges_;
};

using Span = std::pair<std::uintptr_t, std::uintptr_t>;  ///< first byte, one past the last

struct Search {
  const link_map* object;
  std::vector<Span> writable;
  Span read_only{0, 0};
  bool found = false;
};

int visit(dl_phdr_info* info, std::size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  bool is_it = false;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = info->dlpi_phdr[i];
    if (header.p_type != PT_DYNAMIC) continue;
    is_it =
        info->dlpi_addr + header.p_vaddr == reinterpret_cast<std::uintptr_t>(search.object->l_ld);
  }
  if (!is_it) return 0;
  search.found = true;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = info->dlpi_phdr[i];
    const std::uintptr_t first = info->dlpi_addr + header.p_vaddr;
    const Span span{first, first + header.p_memsz};
    if (header.p_type == PT_LOAD && (header.p_flags & PF_W) != 0) search.writable.push_back(span);
    if (header.p_type == PT_GNU_RELRO) search.read_only = span;
  }
  return 1;
}

// The sanitizers put poisoned gaps between variables: plain copies would be reported, and so would
// memcpy().
__attribute__((no_sanitize("address", "undefined"))) void copy(unsigned char* to,
                                                               const unsigned char* from,
                                                               std::size_t size) {
#if defined(__x86_64__)
  asm volatile("rep movsb" : "+D"(to), "+S"(from), "+c"(size) : : "memory");
#else
  volatile unsigned char* target = to;
  const volatile unsigned char* source = from;
  for (std::size_t i = 0; i < size; ++i) target[i] = source[i];
#endif
}

StaticImage::StaticImage(void* handle) {
  Search search{};
  if (dlinfo(handle, RTLD_DI_LINKMAP, &search.object) != 0) throw std::runtime_error(dlerror());
  dl_iterate_phdr(visit, &search);
  if (!search.found) throw std::runtime_error("its segments were not found");

  // The loader protects whole pages: the page in which the read-only part ends stays writable from
  // there on.
  const std::uintptr_t page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const Span locked{search.read_only.first & ~(page - 1), search.read_only.second & ~(page - 1)};
  const auto keep = [this](std::uintptr_t first, std::uintptr_t end) {
    if (first >= end) return;
    Range range{reinterpret_cast<unsigned char*>(first), std::vector<unsigned char>(end - first)};
    copy(range.bytes.data(), range.address, range.bytes.size());
    ranges_.push_back(std::move(range));
  };
  for (const Span& span : search.writable) {
    keep(span.first, std::min(span.second, std::max(span.first, locked.first)));
    keep(std::max(span.first, std::min(span.second, locked.second)), span.second);
  }
}

void StaticImage::restore() const {
  for (const Range& range : ranges_) copy(range.address, range.bytes.data(), range.bytes.size());
}

/// More than any program has (decision): a larger count is a mistake.
constexpr std::uint32_t most_entries = 4096;
constexpr std::size_t longest_name = 128;
constexpr std::size_t longest_text = 4096;

bool is_text(const char* text, std::size_t longest) {
  return text && strnlen(text, longest + 1) <= longest;
}

bool is_name(const char* text) {
  return is_text(text, longest_name) && *text != '\0';
}

/// A key of the configuration.
bool is_key(std::string_view name) {
  constexpr std::string_view allowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  return name.find_first_not_of(allowed) == std::string_view::npos;
}

std::string problem_of_table(const char* kind, const void* table, std::uint32_t count) {
  if (count > most_entries) {
    return std::string("claims ") + std::to_string(count) + " " + kind + "s: at most " +
           std::to_string(most_entries) + " are taken";
  }
  if (count != 0 && !table)
    return std::string("has an incomplete hal_program_info: it counts ") + kind +
           "s, but has no table of them";
  return {};
}

/// `name(i)` is that of entry number i.
template <class Name>
std::string problem_of_names(const char* kind, std::uint32_t count, Name name) {
  std::set<std::string_view> seen;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::string which = std::string(kind) + " number " + std::to_string(i);
    if (!is_name(name(i))) {
      return "has no name for " + which + ": it needs 1 to " + std::to_string(longest_name) +
             " characters";
    }
    if (!seen.insert(name(i)).second) {
      return "has two " + std::string(kind) + "s named '" + name(i) + "': rename one";
    }
  }
  return {};
}

std::string problem_of_values(const hal_option_info& option) {
  const std::vector<std::string> names = option_names(option);
  if (names.empty()) return {};
  for (const std::string& name : names) {
    if (name.empty()) return "has an empty name among its values";
  }
  if (option.minimum == 0 && option.maximum == static_cast<double>(names.size() - 1) &&
      option.default_value == std::floor(option.default_value)) {
    return {};
  }
  return "names " + std::to_string(names.size()) +
         " values: its default is the place of one of them, its range 0 to " +
         std::to_string(names.size() - 1);
}

std::string problem_of_option(const hal_option_info& option) {
  const std::string which = std::string("option '") + option.name + "'";
  if (!is_key(option.name)) return "has the " + which + ": use letters, digits and _ only";
  if (option.name == std::string_view("opt")) {
    return "has the " + which + ", a name that the platform uses itself (sw.opt): rename it";
  }
  if (!is_text(option.unit, longest_text) || !is_text(option.documentation, longest_text)) {
    return "has the " + which + " without unit or documentation: either may be \"\"";
  }
  const bool finite = std::isfinite(option.default_value) && std::isfinite(option.minimum) &&
                      std::isfinite(option.maximum);
  if (!finite || option.minimum > option.default_value || option.default_value > option.maximum) {
    return "has the " + which + " with the default " + std::to_string(option.default_value) +
           " and the range " + std::to_string(option.minimum) + " to " +
           std::to_string(option.maximum) + ": give finite numbers, the default in the range";
  }
  const std::string names = problem_of_values(option);
  return names.empty() ? "" : "has the " + which + ", which " + names;
}

/// What makes a description unusable, as the end of a sentence that begins with the program's name;
/// empty if nothing does. Reads all of its tables, so a wrong count or pointer is a fault here.
std::string problem_of(const hal_program& program) {
  if (program.abi != HAL_ABI) {
    return "was built for version " + std::to_string(program.abi) +
           " of the HAL, this is version " + std::to_string(HAL_ABI) + ": rebuild it";
  }
  if (is_name(program.name) && !program.entry) {
    return "is not a PS program: it has neither main() nor an entry in its hal_program_info";
  }
  if (!is_name(program.name)) {
    return "has an incomplete hal_program_info: it needs a name";
  }
  std::string problem = problem_of_table("unit", program.work, program.work_count);
  if (problem.empty())
    problem = problem_of_table("function", program.functions, program.function_count);
  if (problem.empty()) problem = problem_of_table("option", program.options, program.option_count);
  if (problem.empty()) {
    problem = problem_of_names("unit", program.work_count,
                               [&](std::uint32_t i) { return program.work[i]; });
  }
  if (problem.empty()) {
    problem = problem_of_names("function", program.function_count,
                               [&](std::uint32_t i) { return program.functions[i]; });
  }
  if (problem.empty()) {
    problem = problem_of_names("option", program.option_count,
                               [&](std::uint32_t i) { return program.options[i].name; });
  }
  for (std::uint32_t i = 0; problem.empty() && i < program.option_count; ++i)
    problem = problem_of_option(program.options[i]);
  return problem;
}

constexpr const char* symbol = "hal_program_info";

/// Throws if the description cannot be used. `what` is "program 'x'".
void check(const hal_program& program, const std::string& what) {
  std::string problem;
  const std::string stopped = vp::stopped_by([&] { problem = problem_of(program); });
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

/// Does the loader look for `symbol` elsewhere when it loads the file?
bool needs_symbol(const std::string& path, const char* symbol) {
  std::ifstream stream(path, std::ios::binary);
  const auto header = elf_header(stream);
  if (!header) return false;
  const auto section = [&](unsigned number) {
    Elf64_Shdr shown{};
    stream.seekg(static_cast<std::streamoff>(header->e_shoff + number * sizeof shown));
    stream.read(reinterpret_cast<char*>(&shown), sizeof shown);
    return shown;
  };
  const auto bytes = [&](const Elf64_Shdr& of) {
    std::vector<char> read(of.sh_size);
    stream.seekg(static_cast<std::streamoff>(of.sh_offset));
    stream.read(read.data(), static_cast<std::streamsize>(read.size()));
    return read;
  };
  for (unsigned i = 0; i < header->e_shnum && stream; ++i) {
    const Elf64_Shdr table = section(i);
    if (table.sh_type != SHT_DYNSYM) continue;
    const std::vector<char> symbols = bytes(table), names = bytes(section(table.sh_link));
    for (std::size_t at = 0; stream && at + sizeof(Elf64_Sym) <= symbols.size();
         at += sizeof(Elf64_Sym)) {
      Elf64_Sym entry{};
      std::memcpy(&entry, symbols.data() + at, sizeof entry);
      if (entry.st_shndx == SHN_UNDEF && entry.st_name < names.size() &&
          std::strncmp(names.data() + entry.st_name, symbol, names.size() - entry.st_name) == 0) {
        return true;
      }
    }
  }
  return false;
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
    if (kept) kept->push_back(object);
    return object;
  }

  /// Keeps from here on what is opened. It is never destroyed, nor then what is in it.
  static void keep() {
    if (!kept) kept = new std::vector<std::shared_ptr<SharedObject>>;
  }

  explicit SharedObject(const std::string& path)
      : path_(path),
        handle_(vp::load_object(vp::program_object, path)),
        image_(handle_),
        may_start_core_(needs_symbol(path, "hal_cpu_start")) {}
  // Destructors of static objects then find what their constructors left, however often the program
  // ran. Not so where gcov counts: its counters would be new, too, and written as another run.
  ~SharedObject() {
    if (!write_coverage()) image_.restore();
    vp::unload_object(vp::program_object, path_, handle_);
  }
  SharedObject(const SharedObject&) = delete;
  SharedObject& operator=(const SharedObject&) = delete;

  const hal_program* description() const {
    return static_cast<const hal_program*>(dlsym(handle_, symbol));
  }
  void restore() const { image_.restore(); }
  bool may_start_core() const { return may_start_core_; }
  void (*boot() const)(void) {
    return reinterpret_cast<void (*)(void)>(dlsym(handle_, "markervp_boot"));
  }

 private:
  /// Writes the counters of gcov, where it was built with them.
  bool write_coverage() const {
    using Dump = void (*)();
    const auto dump = reinterpret_cast<Dump>(dlsym(handle_, "__gcov_dump"));
    if (dump) dump();
    return dump != nullptr;
  }

  static std::vector<std::shared_ptr<SharedObject>>* kept;

  std::string path_;
  void* handle_;
  StaticImage image_;
  bool may_start_core_;
};

std::vector<std::shared_ptr<SharedObject>>* SharedObject::kept = nullptr;

class LoadedProgram : public Program {
 public:
  LoadedProgram(std::shared_ptr<SharedObject> object, const hal_program& description,
                std::string path)
      : Program(description, std::move(path)), object_(std::move(object)) {}
  void reset() override { object_->restore(); }
  bool may_start_core() const override { return object_->may_start_core(); }
  void (*boot() const)(void) override { return object_->boot(); }

 private:
  std::shared_ptr<SharedObject> object_;
};

}  // namespace

std::vector<std::string> option_names(const hal_option_info& option) {
  std::vector<std::string> names;
  std::istringstream unit(option.unit);
  for (std::string name; std::getline(unit, name, '|');) names.push_back(name);
  if (names.size() < 2) names.clear();
  return names;
}

std::unique_ptr<Program> Program::linked(const hal_program& description) {
  check(description, "the linked program");
  return std::make_unique<LinkedProgram>(description);
}

void Program::keep_loaded() {
  SharedObject::keep();
}

std::unique_ptr<Program> Program::load(const std::string& path) {
  // One that cannot be resolved is refused by the loader.
  std::error_code ignored;
  const std::filesystem::path resolved = std::filesystem::canonical(path, ignored);
  const std::string file = ignored ? path : resolved.string();
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
