#include <ps/cpu/line_guard.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>

#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>
#include <vp/kernel.h>

#include <ps/cpu/load_emulation.h>
#include <ps/cpu/program_watch.h>

namespace ps {

LineGuard* LineGuard::active_ = nullptr;
bool LineGuard::pending_ = false;

namespace {

/// More than there are devices that write memory.
constexpr std::size_t most_ranges = 8;
/// Decision: a program that polls one word of a page reads it twice before it is known to.
constexpr unsigned watch_steps_per_page = 8, watch_share = 4;

/// Linux: proc(5), TracerPid.
bool is_debugged() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "TracerPid:") continue;
    int tracer = 0;
    status >> tracer;
    return tracer != 0;
  }
  return false;
}

#if defined(__x86_64__)
constexpr bool can_step = true;
constexpr greg_t trap_flag = 1 << 8;

bool writes(const void* context) {
  constexpr greg_t write = 2;  // of the page fault's error code
  return (static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_ERR] & write) != 0;
}

std::uintptr_t instruction(const void* context) {
  return static_cast<std::uintptr_t>(
      static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
}

void set_trap(void* context, bool trap) {
  greg_t& flags = static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_EFL];
  flags = trap ? flags | trap_flag : flags & ~trap_flag;
}
#else
constexpr bool can_step = false;
bool writes(const void*) {
  return false;
}
std::uintptr_t instruction(const void*) {
  return 0;
}
void set_trap(void*, bool) {}
#endif

}  // namespace

void LineGuard::Lines::set(unsigned from, unsigned to, bool value) {
  for (unsigned word = from / bits; from < to; ++word) {
    const unsigned until = std::min(to, (word + 1) * bits);
    const unsigned count = until - from;
    const std::uint64_t ones = count == bits ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
    const std::uint64_t mask = ones << from % bits;
    words[word] = value ? words[word] | mask : words[word] & ~mask;
    from = until;
  }
}

LineGuard::LineGuard(std::uintptr_t first, std::uintptr_t end, unsigned steps, Listener listener)
    : first_(first),
      end_(end),
      listener_(std::move(listener)),
      stopped_(steps == 0 || sysconf(_SC_PAGESIZE) != static_cast<long>(page) || is_debugged()),
      steps_left_(steps),
      watch_steps_left_(steps / watch_share),
      pages_((end - first) / page) {
  struct sigaction action {};
  action.sa_sigaction = &LineGuard::on_trap;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  sigaction(SIGTRAP, &action, &old_trap_);
  active_ = this;
  vp::FaultTrap::on_access = &LineGuard::on_fault;
}

LineGuard::~LineGuard() {
  stop();
  vp::FaultTrap::on_access = nullptr;
  active_ = nullptr;
  sigaction(SIGTRAP, &old_trap_, nullptr);
}

/// Calls action(number of the page, first line in it, one past the last).
template <class Action>
void LineGuard::for_each_page(std::uintptr_t address, std::size_t bytes, Action action) {
  if (bytes == 0) return;
  const std::uintptr_t from = (address - first_) / line;
  const std::uintptr_t to = (std::min(address + bytes, end_) - first_ + line - 1) / line;
  for (std::uintptr_t at = from; at < to;) {
    const std::uintptr_t number = at / lines_per_page;
    const std::uintptr_t until = std::min(to, (number + 1) * lines_per_page);
    const std::uintptr_t start = number * lines_per_page;
    action(number, static_cast<unsigned>(at - start), static_cast<unsigned>(until - start));
    at = until;
  }
}

void LineGuard::guard(std::uintptr_t address, std::size_t bytes) {
  add(&Page::guarded, address, bytes);
}

void LineGuard::watch(std::uintptr_t address, std::size_t bytes) {
  if (watch_steps_left_ != 0) add(&Page::watched, address, bytes);
}

void LineGuard::release(std::uintptr_t address, std::size_t bytes) {
  remove(&Page::guarded, address, bytes);
}

void LineGuard::forget(std::uintptr_t address, std::size_t bytes) {
  if (used_ == 0) return;
  const std::uintptr_t from = std::max(address, first_ + used_from_ * page);
  const std::uintptr_t to = std::min(address + bytes, first_ + used_ * page);
  if (from < to) remove(&Page::watched, from, to - from);
}

// DMA engines write page after page while the program sleeps: one call closes them all.
void LineGuard::add(Lines Page::*kind, std::uintptr_t address, std::size_t bytes) {
  if (stopped_ || bytes == 0) return;
  used_from_ = std::min(used_from_, (address - first_) / page);
  used_ = std::max(used_, (std::min(address + bytes, end_) - 1 - first_) / page + 1);
  for_each_page(address, bytes, [&](std::size_t number, unsigned from, unsigned to) {
    Page& of = pages_[number];
    if (of.left_alone) return;
    // Closed for watched lines only, it is guarded from now on: with what is so before it.
    if (of.closed != 0 && kind == &Page::guarded && of.guarded.empty())
      of.closed = number > 0 && !pages_[number - 1].guarded.empty() ? pages_[number - 1].closed
                                                                    : ++closings_;
    (of.*kind).set(from, to, true);
    if (of.closed != 0) return;
    auto range = std::find_if(ranges_.begin(), ranges_.end(),
                              [number](const Range& r) { return r.to == number; });
    if (range == ranges_.end()) {
      if (ranges_.size() == most_ranges) {
        close();
        ranges_.pop_front();
      }
      range = ranges_.insert(ranges_.end(), {++closings_, number, number});
    }
    ++range->to;
    of.closed = range->closing;
    pending_ = true;
  });
}

void LineGuard::exclude(std::uintptr_t first, std::uintptr_t end) {
  for_each_page(first, end - first,
                [&](std::size_t number, unsigned, unsigned) { pages_[number].left_alone = true; });
}

void LineGuard::close() {
  pending_ = false;
  for (Range& range : ranges_) {
    if (range.closed_to != range.to) allow(range.closed_to, range.to, false);
    range.closed_to = range.to;
  }
}

void LineGuard::remove(Lines Page::*kind, std::uintptr_t address, std::size_t bytes) {
  if (stopped_) return;
  close();
  std::size_t from = 0, to = 0;  // to be opened
  for_each_page(address, bytes, [&](std::size_t number, unsigned first, unsigned last) {
    Page& of = pages_[number];
    if (of.closed == 0) return;
    (of.*kind).set(first, last, false);
    if (!of.empty()) {
      if (of.guarded.empty() || kind == &Page::watched) return;
      if (steps_left_ == 0 || !can_step) leave_alone_all_closed_with(number);
      return;
    }
    of = Page{};
    if (to != number) {
      if (from != to) allow(from, to, true);
      from = number;
    }
    to = number + 1;
  });
  if (from != to) allow(from, to, true);
}

void LineGuard::open(std::size_t number) {
  pages_[number] = Page{};
  allow(number, number + 1, true);
}

void LineGuard::leave_alone_all_closed_with(std::size_t number) {
  const std::uint32_t closing = pages_[number].closed;
  std::size_t from = number, to = number;
  while (from > 0 && pages_[from - 1].closed == closing) --from;
  while (to < used_ && pages_[to].closed == closing) ++to;
  for (std::size_t i = from; i < to; ++i) {
    pages_[i] = Page{};
    pages_[i].left_alone = true;
  }
  allow(from, to, true);
}

void LineGuard::stop() {
  if (std::exchange(stopped_, true)) return;
  close();
  for (std::size_t i = used_from_; i < used_; ++i) {
    if (pages_[i].closed != 0) open(i);
  }
}

void LineGuard::allow(std::size_t from, std::size_t to, bool access) const {
  mprotect(reinterpret_cast<void*>(first_ + from * page), (to - from) * page,
           access ? PROT_READ | PROT_WRITE : PROT_NONE);
}

bool LineGuard::on_fault(std::uintptr_t address, void* context) {
  return active_ && active_->fault(address, context);
}

void LineGuard::program_is_over() {
  if (active_) active_->stop();
}

bool LineGuard::fault(std::uintptr_t address, void* context) {
  if (address < first_ || address >= end_) return false;
  const std::size_t number = (address - first_) / page;
  Page& of = pages_[number];
  if (of.closed == 0) return false;
  const auto in_page = static_cast<unsigned>((address - first_) / line % lines_per_page);
  const bool by_program = ProgramWatch::runs;
  if (by_program && !writes(context)) {
    ProgramWatch::runs = false;
    offer(of, in_page, address, context);
    ProgramWatch::runs = true;
  } else {
    of.watched.set(in_page, in_page + 1, false);
  }
  of.guarded.set(in_page, in_page + 1, false);
  if (stopped_ || of.closed == 0) return true;
  // The simulator looks at what the program handed to it.
  if (of.empty() || !by_program || !may_step(of)) {
    open(number);
  } else {
    step(address, of.guarded.empty(), context);
  }
  return true;
}

// What is watched may be forgotten meanwhile, and the page be open.
void LineGuard::offer(Page& page, unsigned number, std::uintptr_t address, const void* context) {
  if (page.watched.has(number) && !watcher_(address, instruction(context)))
    page.watched.set(number, number + 1, false);
  if (page.guarded.has(number)) listener_(address);
}

// Where nothing but watched lines keeps the page closed, few are looked at.
bool LineGuard::may_step(Page& page) {
  if (!page.guarded.empty()) return true;
  if (watch_steps_left_ == 0 || page.watch_steps == watch_steps_per_page) return false;
  --watch_steps_left_;
  ++page.watch_steps;
  return true;
}

/// Executes one instruction, with the page open.
void LineGuard::step(std::uintptr_t address, bool for_watched, void* context) {
  const std::size_t number = (address - first_) / page;
  const bool goes_on = stepping_count_ != 0;
  const bool counts = !goes_on && !for_watched;
  if (!can_step || stepping_count_ == stepping_.size() || (counts && steps_left_ == 0)) {
    return leave_alone_all_closed_with(number);
  }
  if (counts) --steps_left_;
  const std::size_t in_page = page - address % page;
  if (second_view_ && !goes_on &&
      emulate_load(context, address, second_view_ + (address - first_), in_page))
    return;
  stepping_[stepping_count_++] = number;
  allow(number, number + 1, true);
  trap_is_set_ = true;
  set_trap(context, true);
}

void LineGuard::end_step(void* context) {
  while (stepping_count_ != 0) {
    const std::size_t number = stepping_[--stepping_count_];
    if (pages_[number].closed != 0) allow(number, number + 1, false);
  }
  trap_is_set_ = false;
  set_trap(context, false);
}

void LineGuard::on_trap(int signal, siginfo_t*, void* context) {
  if (active_ && active_->trap_is_set_) return active_->end_step(context);
  // Not ours: raise it again for the previous handler.
  sigaction(signal, active_ ? &active_->old_trap_ : nullptr, nullptr);
  vp::raise_again(signal);
}

}  // namespace ps
