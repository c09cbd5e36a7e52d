// frame_status with the interface of Verilated RTL. It ends or damages its process in the way and
// at the moment that the environment names: HOSTILE="eval:exit".
#include <pl/common/rtl_interface.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>

#include <err.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

volatile int zero = 0;
volatile int* volatile nowhere = nullptr;

__attribute__((noinline)) int recurse(int depth) {
  volatile char room[512];
  room[0] = static_cast<char>(depth);
  return zero == 0 ? recurse(depth + 1) + room[0] : 0;
}

void end(const std::string& way) {
  if (way == "exit") std::exit(0);
  if (way == "_exit") ::_exit(0);
  if (way == "quick_exit") std::quick_exit(0);
  if (way == "errx") ::errx(0, "the end");
  if (way == "abort") std::abort();
  if (way == "terminate") std::terminate();
  if (way == "fault") *nowhere = 1;
  if (way == "blocked" || way == "blocked_thread") {
    sigset_t all;
    sigfillset(&all);
    if (way == "blocked") ::sigprocmask(SIG_BLOCK, &all, nullptr);
    if (way == "blocked_thread") ::pthread_sigmask(SIG_SETMASK, &all, nullptr);
    *nowhere = 1;
  }
  if (way == "division") zero = 100 / zero;
  if (way == "illegal") __builtin_trap();
  if (way == "overflow") zero = recurse(0);
#if defined(__x86_64__)
  if (way == "breakpoint") __asm__ volatile("int3");
#endif
  if (way == "kill") ::kill(::getpid(), SIGKILL);
  if (way == "raise") std::raise(SIGUSR1);
  if (way == "harmless") std::raise(SIGCHLD);
  if (way == "execl") ::execl("/bin/true", "true", nullptr);
  if (way == "execve") {
    char* const nothing[] = {nullptr};
    ::execve("/bin/true", nothing, nothing);
  }
  if (way == "syscall") ::syscall(SYS_exit_group, 0);
  if (way == "fork") static_cast<void>(::fork());
  if (way == "throw") throw 5;
  if (way == "error") throw std::runtime_error("no more");
  if (way == "loop")
    while (zero == 0) continue;
  if (way == "thread") std::thread([] { std::exit(0); }).detach();
  if (way == "faulty_thread") std::thread([] { *nowhere = 1; }).detach();
  if (way == "joined_thread") std::thread([] { std::exit(0); }).join();
}

void reach(const std::string& moment) {
  const char* const text = std::getenv("HOSTILE");
  const std::string asked = text ? text : "";
  if (asked.compare(0, moment.size() + 1, moment + ":") == 0) end(asked.substr(moment.size() + 1));
}

struct Static {
  Static() { reach("constructor"); }
  ~Static() { reach("destructor"); }
} object;

struct Status {
  unsigned char clk, rst, frame_ena, idle, corner_out, blob_out, busy, done;
  unsigned char before, drain, started;
  unsigned edges;
};

Status& of(void* model) {
  return *static_cast<Status*>(model);
}

/// In the second frame.
constexpr unsigned fatal_edge = 500'000;

const RtlEnd* eval(void* model) {
  Status& s = of(model);
  if (s.clk && !s.before) {
    if (s.rst) s.edges = 0;
    if (s.rst || s.frame_ena) {
      s.drain = 15;
      s.started = !s.rst;
    } else if (s.started && s.drain != 0) {
      --s.drain;
    }
    if (++s.edges == fatal_edge) reach("eval");
  }
  s.before = s.clk;
  s.busy = s.started && (s.drain != 0 || !s.idle || s.frame_ena);
  s.done = s.started && !s.busy && !s.corner_out && !s.blob_out;
  return nullptr;
}

const RtlPort ports[] = {{"clk", 1, 0, "status.sv:1"},        {"rst", 1, 0, "status.sv:2"},
                         {"frame_ena", 1, 0, "status.sv:3"},  {"idle", 1, 0, "status.sv:4"},
                         {"corner_out", 1, 0, "status.sv:5"}, {"blob_out", 1, 0, "status.sv:6"},
                         {"busy", 1, 1, "status.sv:7"},       {"done", 1, 1, "status.sv:8"}};

const RtlDescriptor descriptor = {
    INTERFACE,
    "frame_status",
    "status",
    "status.sv:1",
    sizeof ports / sizeof *ports,
    ports,
    0,
    nullptr,
    0,
    nullptr,
    [](const char*, uint64_t) -> void* {
      reach("create");
      return new Status();
    },
    [](void* model) { delete &of(model); },
    eval,
    nullptr,
    [](void*) -> const RtlEnd* { return nullptr; },
    nullptr,
    [](void* model, uint32_t port) -> void* { return &of(model).clk + port; },
    0,
    nullptr,
    0,
    nullptr,
    nullptr};

}  // namespace

extern "C" const RtlDescriptor* markervp_rtl(void) {
  reach("descriptor");
  return &descriptor;
}
