#pragma once

#include <dlfcn.h>
#include <signal.h>
#include <sys/types.h>

#include <cstddef>
#include <cstdint>

#include <chip/linux_app/protocol.h>

/// The shim: a library that is loaded before all others into a Linux application, and has functions
/// of the C library's names. It brings to the platform what the application does with its devices
/// and with time; everything else is the C library's.
///
/// It needs no C++ library, which the application may not have.
namespace shim {

using linux_app::Reply;
using linux_app::Request;
using linux_app::What;

/// The function of a name that the application would have called without the shim.
#define REAL(name)                                                                            \
  ([] {                                                                                       \
    static auto* const real = reinterpret_cast<decltype(&::name)>(::dlsym(RTLD_NEXT, #name)); \
    return real;                                                                              \
  }())

/// With /dev and /sys; null: this process has nothing to do with the platform.
const char* folder();
/// This process is the application, or a copy of it by fork(). False in what it started by exec().
bool is_application();
/// The caller's time is the platform's: it is the one thread that uses devices.
bool is_in_lock_step();
/// Calls of the one thread that uses devices; the first to open one is it.
void take_devices();
/// The thread that calls is the one that uses devices.
void become_user();

/// Asks the platform and waits for its answer; no signal handler runs meanwhile. Another thread is
/// refused, and a process that has no turn.
Reply ask(What what, std::uint64_t a = 0, std::uint64_t b = 0, std::uint64_t c = 0,
          const char* text = nullptr);
/// The same of `size` bytes, in a handler of a signal, which others do not interrupt.
Reply ask_in_handler(What what, std::uint64_t a, std::uint64_t b, std::uint32_t size);
/// Called behind each answer: what it says of interrupts.
void note_interrupts(const Reply& reply);

/// Warns of a call that gets EINVAL, which says too little: what is wrong with it, as printf()
/// writes it.
void warn_of_invalid(const char* format, ...) __attribute__((format(printf, 1, 2)));

/// Ends the run with a message: what went wrong, as printf() writes it. Where is added.
[[noreturn]] void fail(const char* format, ...) __attribute__((format(printf, 1, 2)));
/// Tells that a signal ends the application; `reason` may be empty.
void tell_death(int signal, std::uint64_t address, const char* reason);

/// Where the number of a descriptor of the shim's is kept, which the application does not see;
/// null: the descriptor is the application's.
int* own_descriptor(int descriptor);
/// The descriptor of the DDR.
int memory_file();

// ---- turn.cpp
/// To be called once, in the process that was started.
void prepare_turns();
/// Before each question: false if another process of the application uses the devices.
bool take_turn();
/// With the answer.
void end_turn(const Reply& reply);
/// The process that calls uses the devices, or would be the next.
bool may_take_turn();
/// Once: this process has its turn, and was refused the run's time before.
bool had_other_time();

// ---- stack.cpp
/// Faults of the thread that calls are handled on a stack of their own from now on.
void prepare_stack();
/// "the stack of its main thread overflowed ...", if an access to `address` with this stack pointer
/// did that; else "".
void describe_overflow(std::uintptr_t address, std::uintptr_t stack_pointer, char* text,
                       std::size_t size);

/// The instruction at which the application is in the one that is made now, where that is not
/// what its stack says: 0.
void stand_at(std::uintptr_t instruction);

/// Where the application is: "pc 0x1151 main+0x1c (app.c:12), called from …". Empty: not known.
void locate(char* text, std::size_t size);
/// To be called early: what locate() needs is loaded then, and not in a signal handler.
void prepare_to_locate();

// ---- files.cpp
/// The DDR: bus addresses [first, end).
void set_memory(std::uint64_t first, std::uint64_t end);
/// Some uio is open: an interrupt may end a wait.
bool may_be_interrupted();
/// The device that a descriptor is of, as stat() tells it; 0: none.
dev_t device_open_at(int descriptor);
/// Another process used the devices last, which knew of so many `interrupts`.
void resume_interrupts(const std::uint32_t* interrupts);

// ---- registers.cpp
/// mmap() of a device: below 2 GiB if the application leaves the place to the system, and at the
/// same place in each run. On the board a pointer has 32 bits, and programs keep it in an int.
void* map_low(void* address, std::size_t length, int protection, int flags, int file,
              std::int64_t offset);
/// mmap() of device registers: pages without access rights. Each access of the application faults,
/// is made by the platform, and the application continues: the instruction is stepped over with the
/// word in the page, so that it does what it always does.
void* map_registers(void* address, std::size_t length, int protection, int flags,
                    std::uint32_t bus_address);
/// An address of device registers.
bool are_registers(const void* address);
/// What the application may do with them. False: there are none.
bool protect_registers(void* address, std::size_t length, int protection);
/// They are registers no more.
void unmap_registers(void* address, std::size_t length);
/// Faults of the application are caught from now on.
void catch_faults();
constexpr int faults[] = {SIGSEGV, SIGBUS, SIGTRAP, SIGFPE, SIGILL, SIGABRT};

/// Blocks all signals but those of faults, for a scope.
class NoSignals {
 public:
  NoSignals();
  ~NoSignals();
  NoSignals(const NoSignals&) = delete;
  NoSignals& operator=(const NoSignals&) = delete;

 private:
  sigset_t before_;
};

}  // namespace shim
