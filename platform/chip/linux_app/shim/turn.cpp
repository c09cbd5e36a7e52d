// Which process of the application uses its devices: the one that was started, or a copy of it that
// fork() made. They take turns where their order cannot be the host's.

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include <atomic>

#include "client.h"

namespace shim {

namespace {

/// A turn: the process that has it, whether it waits for an answer, and how often it has asked.
constexpr std::uint64_t process_mask = (1 << 24) - 1, busy = 1 << 24, one = 1 << 25;

/// In memory that copies share.
struct Shared {
  std::atomic<std::uint64_t> turn;
  std::uint32_t interrupts[linux_app::most_uio];  ///< as the last answer said
};
Shared* shared = nullptr;
pid_t self = 0;
std::uint64_t known = 0;  ///< the turn of this process' last question, or before it was made
bool is_copy = false;     ///< by fork()
bool was_user = false;    ///< this process has used devices
bool was_told_other_time = false;

pid_t user_in(std::uint64_t turn) {
  return static_cast<pid_t>(turn & process_mask);
}

/// It has ended, and its parent knows.
bool is_gone(pid_t process) {
  const int before = errno;
  const bool gone = ::kill(process, 0) < 0 && errno == ESRCH;
  errno = before;
  return gone;
}

/// What the one did that has gone lies before all that this process does from now on.
void before_fork() {
  const std::uint64_t now = shared->turn;
  if (now != known && was_user && is_gone(user_in(now))) known = now;
}

void begin_copy() {
  self = ::getpid();
  is_copy = true;
  was_user = was_told_other_time = false;
  become_user();
}

/// clone() and _Fork() call no handler.
void notice_fork() {
  if (::getpid() != self) begin_copy();
}

}  // namespace

void prepare_turns() {
  void* const page = REAL(mmap)(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE,
                                MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) fail("the host has no memory for the application");
  shared = static_cast<Shared*>(page);
  self = ::getpid();
  known = static_cast<std::uint64_t>(self);
  shared->turn = known;
  ::pthread_atfork(before_fork, nullptr, begin_copy);
}

// A copy may take a turn if nothing was asked since its fork. A process that asked before takes the
// turn back from a copy that it has waited for.
bool take_turn() {
  notice_fork();
  std::uint64_t now = shared->turn;
  const bool follows = now == known || (was_user && is_gone(user_in(now)));
  if ((now & busy) != 0 || !follows) return false;
  const std::uint64_t mine = ((now & ~process_mask) + one) | static_cast<std::uint64_t>(self);
  if (!shared->turn.compare_exchange_strong(now, mine | busy)) return false;
  if (user_in(now) != self) resume_interrupts(shared->interrupts);
  known = mine;
  was_user = true;
  return true;
}

void end_turn(const Reply& reply) {
  ::memcpy(shared->interrupts, reply.interrupts, sizeof reply.interrupts);
  shared->turn = known;
}

bool may_take_turn() {
  notice_fork();
  if (!is_copy || was_user) return true;
  const std::uint64_t now = shared->turn;
  const bool may = now == known && is_gone(user_in(now));
  was_told_other_time |= !may;
  return may;
}

bool had_other_time() {
  const bool had = was_told_other_time;
  was_told_other_time = false;
  return had;
}

namespace {

/// It waits for something: it is not about to end, however busy the host is.
bool sleeps(pid_t process) {
  char text[512];
  ::snprintf(text, sizeof text, "/proc/%d/stat", process);
  const int file = REAL(open)(text, O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const ssize_t count = REAL(read)(file, text, sizeof text - 1);
  REAL(close)(file);
  text[count > 0 ? count : 0] = '\0';
  const char* const name_end = ::strrchr(text, ')');
  return name_end && ::strncmp(name_end, ") S", 3) == 0;
}

/// A copy that becomes a session of its own is usually a daemon: it waits for the end of its
/// parent, so that it has the run's time from now on. It does not wait for a parent that stays.
void await_turn() {
  constexpr timespec pause{0, 1'000'000};
  constexpr int most_pauses = 2000, most_in_sleep = 20;
  notice_fork();
  if (!is_copy || was_user) return;
  for (int i = 0, asleep = 0; i < most_pauses && asleep < most_in_sleep; ++i) {
    const std::uint64_t now = shared->turn;
    if (now != known || is_gone(user_in(now))) return;
    asleep = sleeps(user_in(now)) ? asleep + 1 : 0;
    REAL(nanosleep)(&pause, nullptr);
  }
}

}  // namespace

}  // namespace shim

#pragma GCC visibility push(default)
extern "C" {

pid_t setsid(void) noexcept {
  if (shim::is_application()) shim::await_turn();
  return REAL(setsid)();
}

// That of the C library calls fork() and setsid() inside itself.
int daemon(int keeps_folder, int keeps_streams) noexcept {
  const pid_t copy = ::fork();
  if (copy < 0) return -1;
  if (copy > 0) ::_exit(0);
  if (::setsid() < 0 || (keeps_folder == 0 && ::chdir("/") != 0)) return -1;
  if (keeps_streams != 0) return 0;
  const int nothing = ::open("/dev/null", O_RDWR);
  if (nothing < 0) return -1;
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) ::dup2(nothing, stream);
  if (nothing > STDERR_FILENO) ::close(nothing);
  return 0;
}

// A child that shares the memory of its parent would change the shim's notes of it.
pid_t vfork(void) noexcept {
  return ::fork();
}

}  // extern "C"
#pragma GCC visibility pop
