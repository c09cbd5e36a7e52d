// The heap of a program. It lies behind its static data in the DDR, as on the chip: what malloc()
// and new give is reached by DMA engines, has 32-bit addresses, and they are the same in every run.
// First fit, in order of addresses.
#include <hal/native_program.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>

// A sanitizer of addresses has a heap of its own.
#if !defined(__SANITIZE_ADDRESS__)

extern "C" {
void __libc_free(void* block);
void* __libc_memalign(std::size_t alignment, std::size_t bytes);
void* __libc_realloc(void* block, std::size_t bytes);
extern char _end __attribute__((visibility("hidden")));  // of the program's static data
}

namespace {

/// Before each block; of 16 bytes, which keeps blocks aligned.
struct Head {
  std::size_t bytes;  ///< with this
  Head* next;         ///< the next free one
};
constexpr std::size_t grain = sizeof(Head), page = 4096;
Head* first_free = nullptr;

void release(void* block);

unsigned char* heap_first() {
  const auto data_end = (reinterpret_cast<std::uintptr_t>(&_end) + page - 1) & ~(page - 1);
  return reinterpret_cast<unsigned char*>(data_end + MARKERVP_HEAP_GAP);
}

}  // namespace

markervp_heap_area markervp_heap = {nullptr, nullptr, nullptr, &release};

namespace {

void prepare() {
  if (markervp_heap.first != nullptr) return;
  markervp_heap.first = markervp_heap.top = heap_first();
  if (markervp_heap.end == nullptr) markervp_heap.end = markervp_heap.first + MARKERVP_HEAP_AT_LOAD;
}

/// The DDR is gone, and the heap in it. What still runs writes the counters of gcov.
bool is_closed() {
  return markervp_heap.end < markervp_heap.first;
}

Head* head_of(void* block) {
  return static_cast<Head*>(block) - 1;
}

bool is_own(const void* block) {
  return markervp_heap.first <= block && block < markervp_heap.top;
}

/// Puts a free block in its place, and joins it with its neighbours.
void put(Head* block) {
  Head** link = &first_free;
  Head* before = nullptr;
  while (*link != nullptr && *link < block) {
    before = *link;
    link = &before->next;
  }
  block->next = *link;
  *link = block;
  const auto join = [](Head* one) {
    if (reinterpret_cast<unsigned char*>(one) + one->bytes !=
        reinterpret_cast<unsigned char*>(one->next))
      return;
    one->bytes += one->next->bytes;
    one->next = one->next->next;
  };
  join(block);
  if (before != nullptr) join(before);
}

/// The rest of a block behind `bytes` becomes free.
void cut(Head* block, std::size_t bytes) {
  if (block->bytes - bytes < 2 * grain) return;
  auto* const rest = reinterpret_cast<Head*>(reinterpret_cast<unsigned char*>(block) + bytes);
  rest->bytes = block->bytes - bytes;
  block->bytes = bytes;
  put(rest);
}

Head* take(std::size_t bytes) {
  for (Head** link = &first_free; *link != nullptr; link = &(*link)->next) {
    Head* const found = *link;
    if (found->bytes < bytes) continue;
    *link = found->next;
    cut(found, bytes);
    return found;
  }
  if (static_cast<std::size_t>(markervp_heap.end - markervp_heap.top) < bytes) return nullptr;
  auto* const grown = reinterpret_cast<Head*>(markervp_heap.top);
  markervp_heap.top += bytes;
  grown->bytes = bytes;
  return grown;
}

void* allocate(std::size_t size, std::size_t alignment) {
  prepare();
  if (is_closed()) return __libc_memalign(alignment, size);
  if (size > ~std::uint32_t{0} || alignment > ~std::uint32_t{0}) return nullptr;
  const std::size_t bytes = (size + grain - 1) / grain * grain + (size == 0 ? 2 : 1) * grain;
  if (alignment <= grain) {
    Head* const block = take(bytes);
    return block == nullptr ? nullptr : block + 1;
  }
  Head* block = take(bytes + alignment + 2 * grain);
  if (block == nullptr) return nullptr;
  const auto start = reinterpret_cast<std::uintptr_t>(block + 1);
  if (start % alignment != 0) {
    // What lies before the aligned place is a block of its own.
    const std::uintptr_t aligned = (start + 2 * grain + alignment - 1) / alignment * alignment;
    const std::size_t before = aligned - start;
    auto* const moved = reinterpret_cast<Head*>(aligned) - 1;
    moved->bytes = block->bytes - before;
    block->bytes = before;
    put(block);
    block = moved;
  }
  cut(block, bytes);
  return block + 1;
}

void release(void* block) {
  if (block == nullptr) return;
  if (!is_own(block)) return __libc_free(block);  // of the C library
  if (!is_closed()) put(head_of(block));
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
  void* const block = allocate(size, alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

}  // namespace

// The compiler knows these names, and takes no attribute for them.
__asm__(".hidden malloc, free, calloc, realloc, memalign, aligned_alloc");

extern "C" void* malloc(std::size_t size) noexcept {
  return allocate(size, grain);
}
extern "C" void free(void* block) noexcept {
  release(block);
}
extern "C" void* calloc(std::size_t count, std::size_t size) noexcept {
  std::size_t bytes = 0;
  if (__builtin_mul_overflow(count, size, &bytes)) return nullptr;
  void* const block = allocate(bytes, grain);
  return block == nullptr ? nullptr : std::memset(block, 0, bytes);
}
extern "C" void* realloc(void* block, std::size_t size) noexcept {
  if (block == nullptr) return allocate(size, grain);
  if (!is_own(block)) return __libc_realloc(block, size);
  const std::size_t old = head_of(block)->bytes - grain;
  if (size <= old) return block;
  void* const moved = allocate(size, grain);
  if (moved == nullptr) return nullptr;
  std::memcpy(moved, block, old);
  release(block);
  return moved;
}
extern "C" void* memalign(std::size_t alignment, std::size_t size) noexcept {
  return (alignment & (alignment - 1)) != 0 ? nullptr : allocate(size, alignment);
}
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return memalign(alignment, size);
}

void* operator new(std::size_t size) {
  return allocate_or_throw(size, grain);
}
void* operator new[](std::size_t size) {
  return allocate_or_throw(size, grain);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, grain);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, grain);
}
void operator delete(void* block) noexcept {
  release(block);
}
void operator delete[](void* block) noexcept {
  release(block);
}
void operator delete(void* block, std::size_t) noexcept {
  release(block);
}
void operator delete[](void* block, std::size_t) noexcept {
  release(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
  release(block);
}
void operator delete[](void* block, std::align_val_t) noexcept {
  release(block);
}
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  release(block);
}
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept {
  release(block);
}

#endif
