// Registers in the application's memory, and the faults of the application itself.

#include <errno.h>
#include <pthread.h>
#include <string.h>
#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>

#include "client.h"
#include "decode.h"

namespace shim {

namespace {

constexpr std::uintptr_t page = 4096;
constexpr greg_t trap_flag = 1 << 8;
constexpr std::size_t most_mappings = 256;

struct Mapping {
  std::uintptr_t first, end;
  std::uint64_t bus_address;
  int protection;

  bool contains(std::uintptr_t address) const { return first <= address && address < end; }
};
Mapping mappings[most_mappings];
std::size_t mapping_count = 0;

const Mapping* find(std::uintptr_t address) {
  for (std::size_t i = 0; i < mapping_count; ++i) {
    if (mappings[i].contains(address)) return &mappings[i];
  }
  return nullptr;
}

/// The access whose instruction runs now, in a page that is open for it.
struct Step {
  bool runs = false;
  bool writes;
  std::uint8_t size;
  std::uintptr_t address, instruction;
  std::uint64_t bus_address;
  std::uint64_t mask;  ///< of signals, before
} step;

void allow(std::uintptr_t address, bool access) {
  REAL(mprotect)
  (reinterpret_cast<void*>(address & ~(page - 1)), page,
   access ? PROT_READ | PROT_WRITE : PROT_NONE);
}

/// "06 0f 1c", the instruction.
struct Bytes {
  char text[3 * 8 + 1];
  explicit Bytes(const unsigned char* at) {
    constexpr const char* digits = "0123456789abcdef";
    for (std::size_t i = 0; i < 8; ++i) {
      text[3 * i] = digits[at[i] >> 4];
      text[3 * i + 1] = digits[at[i] & 15];
      text[3 * i + 2] = ' ';
    }
    text[3 * 8 - 1] = '\0';
  }
};

using Kind = MemoryAccess::Kind;

/// Refuses what no register takes.
void check(const MemoryAccess& access, std::uint64_t bus_address, const unsigned char* instruction,
           const ucontext_t& context) {
  const auto at = static_cast<unsigned>(bus_address);
  if (access.kind == Kind::unsupported)
    fail("the application accesses the registers at 0x%08X with %s (instruction %s)", at,
         access.why, Bytes(instruction).text);
  if (bus_address % access.size != 0)
    fail(
        "unaligned access: %u bytes at 0x%08X, which is not a multiple of %u; the chip ends it "
        "with SIGBUS",
        access.size, at, access.size);
  const auto& registers = context.uc_mcontext.gregs;
  if (access.kind == Kind::move && find(static_cast<std::uintptr_t>(registers[REG_RSI])) &&
      find(static_cast<std::uintptr_t>(registers[REG_RDI])))
    fail(
        "the application copies from register to register in one instruction, at 0x%08X: copy "
        "word by word, through pointers to volatile uint32_t",
        at);
}

/// The processor's registers, by the number that instructions give them.
constexpr int by_number[] = {REG_RAX, REG_RCX, REG_RDX, REG_RBX, REG_RSP, REG_RBP,
                             REG_RSI, REG_RDI, REG_R8,  REG_R9,  REG_R10, REG_R11,
                             REG_R12, REG_R13, REG_R14, REG_R15};

/// The lowest `bytes` of a value.
std::uint64_t lowest(std::uint64_t value, unsigned bytes) {
  return bytes == 8 ? value : value & ((std::uint64_t{1} << 8 * bytes) - 1);
}

/// Does what the instruction does, and passes it.
void make(const PlainMove& move, std::uint64_t bus_address, ucontext_t& context) {
  auto& registers = context.uc_mcontext.gregs;
  greg_t& target = registers[by_number[move.reg]];
  if (move.is_store) {
    const auto value = move.has_number ? move.number : static_cast<std::uint64_t>(target);
    ask_in_handler(What::write, bus_address, lowest(value, move.size), move.size);
  } else {
    std::uint64_t value = ask_in_handler(What::read, bus_address, 0, move.size).a;
    const unsigned bits = 8 * move.size;
    if (move.is_signed && (value >> (bits - 1) & 1) != 0) value |= ~std::uint64_t{0} << bits;
    value = lowest(value, move.width);
    // Narrow ones leave the rest of the register as it is.
    const auto before = static_cast<std::uint64_t>(target);
    if (move.width < 4) value |= before & ~lowest(~std::uint64_t{0}, move.width);
    target = static_cast<greg_t>(value);
  }
  registers[REG_RIP] += move.length;
}

/// True if it was for registers.
bool access_registers(std::uintptr_t address, ucontext_t& context) {
  const Mapping* const mapping = find(address);
  if (!mapping || step.runs) return false;
  constexpr greg_t write_fault = 2;
  auto& registers = context.uc_mcontext.gregs;
  const bool write = (registers[REG_ERR] & write_fault) != 0;
  const std::uint64_t bus_address = mapping->bus_address + (address - mapping->first);
  if ((mapping->protection & (write ? PROT_WRITE : PROT_READ)) == 0)
    fail("the application %s the registers at 0x%08X, which it mapped without %s",
         write ? "writes to" : "reads", static_cast<unsigned>(bus_address),
         write ? "PROT_WRITE" : "PROT_READ");
  const auto instruction = static_cast<std::uintptr_t>(registers[REG_RIP]);
  const auto* const bytes = reinterpret_cast<const unsigned char*>(instruction);
  const MemoryAccess access = decode(bytes);
  check(access, bus_address, bytes, context);

  PlainMove move;
  if (decode_move(bytes, move)) {
    make(move, bus_address, context);
    return true;
  }
  const bool reads = access.kind == Kind::both || !write;
  const std::uint64_t value = reads ? ask_in_handler(What::read, bus_address, 0, access.size).a : 0;
  allow(address, true);
  ::memcpy(reinterpret_cast<void*>(address), &value, access.size);
  step = {true, write, access.size, address, instruction, bus_address, 0};
  // Nothing of the application's comes between. The kernel's mask has 64 bits.
  ::memcpy(&step.mask, &context.uc_sigmask, sizeof step.mask);
  sigset_t none;
  ::sigfillset(&none);
  ::sigdelset(&none, SIGTRAP);
  ::sigdelset(&none, SIGSEGV);
  ::memcpy(&context.uc_sigmask, &none, sizeof step.mask);
  registers[REG_EFL] |= trap_flag;
  return true;
}

void end_step(ucontext_t& context) {
  step.runs = false;
  context.uc_mcontext.gregs[REG_EFL] &= ~trap_flag;
  ::memcpy(&context.uc_sigmask, &step.mask, sizeof step.mask);
  std::uint64_t value = 0;
  ::memcpy(&value, reinterpret_cast<const void*>(step.address), step.size);
  allow(step.address, false);
  if (!step.writes) return;
  stand_at(step.instruction);
  ask_in_handler(What::write, step.bus_address, value, step.size);
  stand_at(0);
}

/// What the application, or its sanitizer, wants done with the signals of ours.
struct sigaction wanted[2];  // SIGSEGV, SIGTRAP

struct sigaction* wanted_of(int signal) {
  return signal == SIGSEGV ? &wanted[0] : signal == SIGTRAP ? &wanted[1] : nullptr;
}

void die_by(int signal, const siginfo_t& info, const ucontext_t& context) {
  const bool has_address = (signal == SIGSEGV || signal == SIGBUS) && info.si_code > 0;
  const auto address = reinterpret_cast<std::uintptr_t>(info.si_addr);
  char reason[256] = "";
  if (has_address)
    describe_overflow(address, static_cast<std::uintptr_t>(context.uc_mcontext.gregs[REG_RSP]),
                      reason, sizeof reason);
  tell_death(signal, has_address && info.si_code != SI_KERNEL ? address : linux_app::no_address,
             reason);
  struct sigaction usual {};
  REAL(sigaction)(signal, &usual, nullptr);
  ::raise(
      signal);  // comes when this handler is over, if not at the instruction that is tried again
}

void on_signal(int signal, siginfo_t* info, void* data) {
  ucontext_t& context = *static_cast<ucontext_t*>(data);
  const int error = errno;
  if (signal == SIGTRAP && step.runs) {
    end_step(context);
  } else if (signal != SIGSEGV || info->si_code <= 0 ||
             !access_registers(reinterpret_cast<std::uintptr_t>(info->si_addr), context)) {
    const struct sigaction* const own = wanted_of(signal);
    if (own && (own->sa_flags & SA_SIGINFO) != 0) {
      own->sa_sigaction(signal, info, data);
    } else if (own && own->sa_handler != SIG_DFL && own->sa_handler != SIG_IGN) {
      own->sa_handler(signal);
    } else {
      die_by(signal, *info, context);
    }
  }
  errno = error;
}

}  // namespace

void catch_faults() {
  struct sigaction action {};
  action.sa_sigaction = &on_signal;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  ::sigfillset(&action.sa_mask);
  for (const int signal : faults) {
    struct sigaction before {};
    REAL(sigaction)(signal, nullptr, &before);
    struct sigaction* const own = wanted_of(signal);
    if (own) *own = before;
    if (own || before.sa_handler == SIG_DFL) REAL(sigaction)(signal, &action, nullptr);
  }
  REAL(sigaction)(linux_app::out_of_time, &action, nullptr);
}

void* map_low(void* address, std::size_t length, int protection, int flags, int file,
              std::int64_t offset) {
  constexpr std::uintptr_t first = 0x4000'0000, end = 0x8000'0000;
  constexpr unsigned most_trials = 4096;
  static std::uintptr_t next = first;
  const std::size_t size = (length + page - 1) / page * page;
  for (unsigned i = 0; !address && size <= end - first && i < most_trials; ++i) {
    if (size > end - next) next = first;
    void* const got = REAL(mmap)(reinterpret_cast<void*>(next), length, protection,
                                 flags | MAP_FIXED_NOREPLACE, file, static_cast<off_t>(offset));
    next += size;
    if (got != MAP_FAILED || errno != EEXIST) return got;
  }
  return REAL(mmap)(address, length, protection, flags, file, static_cast<off_t>(offset));
}

void* map_registers(void* address, std::size_t length, int protection, int flags,
                    std::uint32_t bus_address) {
  if ((flags & MAP_SHARED) == 0)
    fail(
        "mmap() of the registers at 0x%08X with MAP_PRIVATE: what is written goes to a copy, and "
        "never to the device; use MAP_SHARED",
        bus_address);
  if (mapping_count == most_mappings) {
    errno = ENOMEM;
    return MAP_FAILED;
  }
  const int kept = flags & (MAP_FIXED | MAP_FIXED_NOREPLACE);
  void* const got = map_low(address, length, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | kept, -1, 0);
  if (got == MAP_FAILED) return got;
  const auto first = reinterpret_cast<std::uintptr_t>(got);
  unmap_registers(got, length);
  mappings[mapping_count++] = {first, first + (length + page - 1) / page * page, bus_address,
                               protection};
  return got;
}

bool are_registers(const void* address) {
  return find(reinterpret_cast<std::uintptr_t>(address)) != nullptr;
}

// What is left of a mapping lies before or behind.
void unmap_registers(void* address, std::size_t length) {
  const auto first = reinterpret_cast<std::uintptr_t>(address);
  const std::uintptr_t end = first + (length + page - 1) / page * page;
  for (std::size_t i = 0; i < mapping_count;) {
    Mapping& of = mappings[i];
    if (of.end <= first || of.first >= end) {
      ++i;
    } else if (of.first < first) {
      of.end = first;
      ++i;
    } else if (of.end > end) {
      of.bus_address += end - of.first;
      of.first = end;
      ++i;
    } else {
      of = mappings[--mapping_count];
    }
  }
}

bool protect_registers(void* address, std::size_t length, int protection) {
  const auto first = reinterpret_cast<std::uintptr_t>(address);
  bool any = false;
  for (std::size_t i = 0; i < mapping_count; ++i) {
    if (mappings[i].end <= first || mappings[i].first >= first + length) continue;
    mappings[i].protection = protection;
    any = true;
  }
  return any;
}

namespace {

/// A set of signals to be blocked: without those by which accesses come.
class Blocked {
 public:
  explicit Blocked(const sigset_t* asked) : set_(asked) {
    if (!asked || !is_application()) return;
    without_ = *asked;
    ::sigdelset(&without_, SIGSEGV);
    ::sigdelset(&without_, SIGTRAP);
    set_ = &without_;
  }
  operator const sigset_t*() const { return set_; }

 private:
  const sigset_t* set_;
  sigset_t without_;
};

}  // namespace

}  // namespace shim

#pragma GCC visibility push(default)
extern "C" {

int sigaction(int signal, const struct sigaction* action, struct sigaction* before) noexcept {
  struct sigaction* const own = shim::is_application() ? shim::wanted_of(signal) : nullptr;
  if (!own) {
    if (!action) return REAL(sigaction)(signal, action, before);
    struct sigaction taken = *action;
    taken.sa_mask = *shim::Blocked(&action->sa_mask);
    return REAL(sigaction)(signal, &taken, before);
  }
  if (before) *before = *own;
  if (action) *own = *action;
  return 0;
}

sighandler_t signal(int number, sighandler_t handler) noexcept {
  struct sigaction* const own = shim::is_application() ? shim::wanted_of(number) : nullptr;
  if (!own) return REAL(signal)(number, handler);
  const sighandler_t before = own->sa_handler;
  *own = {};
  own->sa_handler = handler;
  return before;
}

int sigprocmask(int how, const sigset_t* set, sigset_t* before) noexcept {
  return REAL(sigprocmask)(how, how == SIG_UNBLOCK ? set : shim::Blocked(set), before);
}

int pthread_sigmask(int how, const sigset_t* set, sigset_t* before) noexcept {
  return REAL(pthread_sigmask)(how, how == SIG_UNBLOCK ? set : shim::Blocked(set), before);
}

int mprotect(void* address, size_t length, int protection) noexcept {
  if (shim::protect_registers(address, length, protection)) return 0;
  return REAL(mprotect)(address, length, protection);
}

}  // extern "C"
#pragma GCC visibility pop
