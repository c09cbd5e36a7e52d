#include <sweep/work_queue.h>

#include <sys/mman.h>

#include <cerrno>
#include <new>
#include <system_error>

namespace platform::sweep {

WorkQueue::WorkQueue(std::size_t items, std::uint32_t slots)
    : items_(items), bytes_(sizeof(Shared) + slots * sizeof(Slot)) {
  void* memory = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    throw std::system_error(errno, std::generic_category(), "no memory for a sweep's processes");
  shared_ = new (memory) Shared;
  for (std::uint32_t slot = 0; slot < slots; ++slot) new (this->slots() + slot) Slot(0);
}

WorkQueue::~WorkQueue() {
  ::munmap(shared_, bytes_);
}

std::optional<std::size_t> WorkQueue::take(std::uint32_t slot) {
  const std::uint64_t item = shared_->next++;
  if (item >= items_) return std::nullopt;
  hold(slot, item);
  return item;
}

std::optional<std::size_t> WorkQueue::held(std::uint32_t slot) const {
  const std::uint64_t item = slots()[slot];
  if (item == 0) return std::nullopt;
  return item - 1;
}

}  // namespace platform::sweep
