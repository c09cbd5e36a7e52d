#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <vp/error.h>
#include <vp/fault_trap.h>

/// Shared objects that a user brings: PS programs, RTL, designs. What they do to the process is an
/// error with a message.
namespace vp {

/// A kind of such an object.
struct ObjectKind {
  const char* name;    ///< in messages: "RTL"
  const char* build;   ///< what builds it: "markervp_add_rtl"
  const char* advice;  ///< instead of work in constructors of static objects
};
inline constexpr ObjectKind program_object{"program", "markervp_add_program",
                                           "do such work in the entry function"};
inline constexpr ObjectKind rtl_object{"RTL", "markervp_add_rtl", "leave it out"};
inline constexpr ObjectKind design_object{"design", "markervp_add_design",
                                          "do such work in the constructor of the design"};

/// Loads the shared object `path` and returns its handle. Throws InputError "cannot load KIND
/// 'PATH': WHY" for a file that is missing, truncated, for another machine, no shared object, or
/// needs what nothing defines; ProtocolError if a constructor of its static objects ends or damages
/// the process.
void* load_object(const ObjectKind& kind, const std::string& path);

/// An ELF file of 64 bits that ends before what its headers name: it is mapped as they say, and
/// touching what it lacks is a bus error (SIGBUS). False for what is no ELF file.
bool is_truncated_object(const std::string& path);

/// Unloads it. If a destructor ends or damages the process, the process ends with a message and
/// exit code 3: the loader cannot continue.
void unload_object(const ObjectKind& kind, const std::string& path, void* handle);

/// Of a loaded one that stays: while one of its functions is under way in a call of call_objects(),
/// faults belong to it.
void keep_object(const ObjectKind& kind, const std::string& path, void* handle);

/// For signal handlers, too.
bool has_kept_objects();

/// "RTL 'x.so'" for an address of code in an object that is kept; null for any other. For signal
/// handlers, too.
const char* foreign_object_at(std::uintptr_t address);

/// The platform's own code failed. If an object is kept, which may have written where it must not,
/// the process ends with a message and exit code 3; otherwise this returns. For signal handlers.
void end_if_damaged();

/// Runs `code`, which touches an object. Returns what stopped it: "it called exit(0)", "it threw an
/// exception: …"; empty if nothing did.
std::string stopped_by(const std::function<void()>& code);

/// A function of an object ended or damaged the process.
class ObjectEnd : public ProtocolError {
 public:
  explicit ObjectEnd(const Fault& fault);
  const Fault& fault() const { return fault_; }

 private:
  Fault fault_;
};

/// How calls of objects are watched that do not return.
struct CallLimit {
  /// Changes with each progress, after which a call may take long again; null: nothing does.
  std::uint64_t (*progress)(const void* context) = nullptr;
  const void* context = nullptr;
  /// Lets the code return soon; null: it does. For a signal handler.
  void (*interrupt)() = nullptr;
};

/// Runs `code` of the platform, which calls functions of objects that are kept. Throws ObjectEnd,
/// with nothing unwound, if one of them ends or damages the process. Exceptions pass.
void call_objects(const std::function<void()>& code);
/// The same, also if one of them does not return for long.
void call_objects(const std::function<void()>& code, const CallLimit& limit);

/// Ends the process as exit() does; with a message and exit code 3 if the destructor of an object
/// that is kept ends or damages it.
[[noreturn]] void exit_with_objects(int code);

}  // namespace vp
