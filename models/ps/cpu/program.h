#pragma once

#include <hal/hal.h>
#include <ps/cpu/code_charge.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ps {

/// The names of an option's values, which its unit lists ("none|low|high"); none: its values
/// are numbers.
std::vector<std::string> option_names(const hal_option_info& option);

/// A PS program that a Cpu can run.
class Program {
 public:
  /// Loads a plug-in. Throws vp::InputError with one line if the file is missing, is not a shared
  /// object, needs undefined symbols, describes no program, or was built for another HAL;
  /// vp::ProtocolError if a constructor of its static objects does what ends a program in a run.
  static std::unique_ptr<Program> load(const std::string& path);
  /// A program that is part of this executable; reset() does nothing. Throws vp::InputError as
  /// load() does.
  static std::unique_ptr<Program> linked(const hal_program& description);

  /// From here on programs stay in memory until the process ends, without their destructors: one
  /// that runs many times then loads each once. Each run finds fresh variables as ever (reset()).
  static void keep_loaded();

  virtual ~Program() = default;

  const hal_program& description() const { return *description_; }
  const char* name() const { return description_->name; }
  /// Absolute path of the plug-in; empty if linked.
  const std::string& path() const { return path_; }

  /// One past the last byte of it that lies in the DDR, its heap included; 0: none does.
  virtual std::uint64_t end() const { return 0; }
  /// Its heap may grow up to this address. After each reset().
  virtual void end_heap_at(std::uintptr_t) {}
  /// Charges it for the code that it runs; null: it counts its work, or is linked.
  virtual CodeCharge* charge() { return nullptr; }
  /// Its code; null: it is part of this executable.
  virtual const MachineCode* code() const { return nullptr; }

  /// True if it may start the second core, because it refers to hal_cpu_start(). Unknown, and
  /// therefore false, for a linked program.
  virtual bool may_start_core() const { return false; }

  /// True if it was built with the address sanitizer, which knows the host's stacks only: it runs
  /// on those.
  virtual bool is_sanitized() const { return false; }

  /// The substitute for the board's boot code, which runs before the entry function:
  /// `markervp_boot` of its libraries. May be null.
  virtual void (*boot() const)(void) { return nullptr; }
  /// The second core's program, `markervp_core1`, which is another file on the chip. Null: none.
  virtual void (*second() const)(void) { return nullptr; }

  /// Makes its static variables what they were after loading: before each run. Variables inside
  /// functions are fresh too. What a static object holds on the heap is not reset; programs for the
  /// chip have no such objects.
  virtual void reset() = 0;

 protected:
  Program(const hal_program& description, std::string path)
      : description_(&description), path_(std::move(path)) {}

 private:
  const hal_program* description_;
  std::string path_;
};

}  // namespace ps
