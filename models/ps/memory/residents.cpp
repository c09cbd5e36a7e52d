#include <ps/memory/residents.h>

#include <sys/mman.h>

#include <algorithm>
#include <utility>

namespace ps {

namespace {

std::vector<const Resident*>& all() {
  static std::vector<const Resident*> residents;
  return residents;
}

}  // namespace

Resident::Resident(std::string program, std::vector<Part> parts)
    : program_(std::move(program)), parts_(std::move(parts)) {
  const auto before = [](const Resident* a, const Resident* b) { return a->first() < b->first(); };
  all().insert(std::upper_bound(all().begin(), all().end(), this, before), this);
}

Resident::~Resident() {
  all().erase(std::find(all().begin(), all().end(), this));
}

std::vector<const Resident*> Resident::in(std::uint64_t first, std::uint64_t end) {
  std::vector<const Resident*> found;
  for (const Resident* resident : all()) {
    if (resident->first() < end && resident->end() > first) found.push_back(resident);
  }
  return found;
}

void map_ahead(const void* first, std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
  constexpr std::uintptr_t page = 4096;
  constexpr std::size_t few = 8 * page;
  if (bytes < few) return;
  const auto from = reinterpret_cast<std::uintptr_t>(first) & ~(page - 1);
  const std::uintptr_t end = reinterpret_cast<std::uintptr_t>(first) + bytes;
  madvise(reinterpret_cast<void*>(from), end - from, MADV_POPULATE_WRITE);
#else
  static_cast<void>(first);
  static_cast<void>(bytes);
#endif
}

__attribute__((no_sanitize("address", "undefined"))) void clear_variables(void* to,
                                                                          std::size_t size) {
#if defined(__x86_64__)
  asm volatile("rep stosb" : "+D"(to), "+c"(size) : "a"(0) : "memory");
#else
  auto* target = static_cast<volatile unsigned char*>(to);
  for (std::size_t i = 0; i < size; ++i) target[i] = 0;
#endif
}

// Plain copies of poisoned gaps would be reported, and so would memcpy().
__attribute__((no_sanitize("address", "undefined"))) void copy_variables(void* to, const void* from,
                                                                         std::size_t size) {
#if defined(__x86_64__)
  asm volatile("rep movsb" : "+D"(to), "+S"(from), "+c"(size) : : "memory");
#else
  auto* target = static_cast<volatile unsigned char*>(to);
  const auto* source = static_cast<const volatile unsigned char*>(from);
  for (std::size_t i = 0; i < size; ++i) target[i] = source[i];
#endif
}

}  // namespace ps
