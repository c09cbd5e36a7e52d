#include <sys/mman.h>
#include <unistd.h>

#include <ps/cpu/memory_watch.h>

namespace ps {

MemoryWatch* MemoryWatch::active_ = nullptr;

void MemoryWatch::watch(std::vector<Range> ranges) {
  lift();
  touched_.reset();
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  for (Range& range : ranges) {
    range.first -= range.first % page;
    range.second = (range.second + page - 1) / page * page;
  }
  pages_ = std::move(ranges);
  if (pages_.empty()) return;
  active_ = this;
  watching_ = true;
  protect(PROT_NONE);
}

void MemoryWatch::lift() {
  if (!watching_) return;
  watching_ = false;
  active_ = nullptr;
  protect(PROT_READ | PROT_WRITE);
}

void MemoryWatch::protect(int access) const {
  for (const Range& range : pages_) {
    mprotect(reinterpret_cast<void*>(range.first), range.second - range.first, access);
  }
}

// What follows the loop, and the simulator itself (a DMA's write), end the watch, too, but are
// nobody's mistake.
bool MemoryWatch::on_fault(std::uintptr_t address, bool by_loop) {
  MemoryWatch* watch = active_;
  if (!watch) return false;
  for (const Range& range : watch->pages_) {
    if (address < range.first || address >= range.second) continue;
    watch->lift();
    if (by_loop) watch->touched_ = address;
    return true;
  }
  return false;
}

}  // namespace ps
