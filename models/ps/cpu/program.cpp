#include <elf.h>

#include <hal/option_data.h>
#include <ps/cpu/program.h>
#include <ps/cpu/program_image.h>
#include <ps/cpu/program_watch.h>
#include <ps/memory/memory.h>
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
  if (option.unit == std::string_view(HAL_UNIT_FILE)) {
    const bool is_sound = option.default_value == 0 && option.minimum == 0 && option.maximum == 1;
    return is_sound ? "" : "names a file: its default is 0, its range 0 to 1";
  }
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
    PlatformMapping::end_unused();
    make_room(ProgramImage::wanted_by(path));
    auto object = std::make_shared<SharedObject>(path);
    loaded[path] = object;
    if (kept) kept->push_back(object);
    return object;
  }

  /// Keeps from here on what is opened, until another program needs its addresses. It is never
  /// destroyed, nor then what is in it.
  static void keep() {
    if (!kept) kept = new std::vector<std::shared_ptr<SharedObject>>;
  }

  explicit SharedObject(const std::string& path)
      : wanted_(ProgramImage::wanted_by(path)),
        image_(path),
        may_start_core_(needs_symbol(path, "hal_cpu_start")),
        is_sanitized_(needs_symbol(path, "__asan_init")) {
    const auto* const area =
        static_cast<const markervp_charge_area*>(image_.symbol("markervp_charge"));
    if (area && image_.code()) charge_.emplace(*area, *image_.code());
  }
  // Destructors of static objects then find what their constructors left, however often the program
  // ran. Not so where gcov counts: its counters would be new, too, and written as another run.
  ~SharedObject() {
    if (charge_) charge_->stop();
    if (!write_coverage()) image_.restore();
  }
  SharedObject(const SharedObject&) = delete;
  SharedObject& operator=(const SharedObject&) = delete;

  const hal_program* description() const {
    return static_cast<const hal_program*>(image_.symbol(symbol));
  }
  const ProgramImage& image() const { return image_; }
  CodeCharge* charge() { return charge_ ? &*charge_ : nullptr; }
  bool may_start_core() const { return may_start_core_ || second() != nullptr; }
  bool is_sanitized() const { return is_sanitized_; }
  void (*boot() const)(void) {
    return reinterpret_cast<void (*)(void)>(image_.symbol("markervp_boot"));
  }

  void (*second() const)(void) {
    return reinterpret_cast<void (*)(void)>(image_.symbol("markervp_core1"));
  }

 private:
  /// Unloads what is kept at these addresses and not in use.
  static void make_room(const ProgramImage::Span& wanted) {
    if (!kept || wanted.second == 0) return;
    const auto in_the_way = [&](const std::shared_ptr<SharedObject>& object) {
      return object.use_count() == 1 && object->wanted_.second != 0;
    };
    kept->erase(std::remove_if(kept->begin(), kept->end(), in_the_way), kept->end());
  }

  /// Writes the counters of gcov, where it was built with them.
  bool write_coverage() const {
    using Dump = void (*)();
    const auto dump = reinterpret_cast<Dump>(image_.symbol("__gcov_dump"));
    if (dump) {
      image_.close_heap();
      dump();
    }
    return dump != nullptr;
  }

  static std::vector<std::shared_ptr<SharedObject>>* kept;

  ProgramImage::Span wanted_;
  ProgramImage image_;
  std::optional<CodeCharge> charge_;
  bool may_start_core_;
  bool is_sanitized_;
};

std::vector<std::shared_ptr<SharedObject>>* SharedObject::kept = nullptr;

class LoadedProgram : public Program {
 public:
  LoadedProgram(std::shared_ptr<SharedObject> object, const hal_program& description,
                std::string path)
      : Program(description, std::move(path)), object_(std::move(object)) {}
  void reset() override { object_->image().restore(); }
  void end_heap_at(std::uintptr_t end) override { object_->image().end_heap_at(end); }
  std::uint64_t end() const override { return object_->image().end(); }
  CodeCharge* charge() override { return object_->charge(); }
  const MachineCode* code() const override { return object_->image().code(); }
  bool may_start_core() const override { return object_->may_start_core(); }
  bool is_sanitized() const override { return object_->is_sanitized(); }
  void (*boot() const)(void) override { return object_->boot(); }
  void (*second() const)(void) override { return object_->second(); }

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
