#include <ps/memory/residents.h>

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
