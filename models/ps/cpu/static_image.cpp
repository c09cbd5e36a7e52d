#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

#include <ps/cpu/static_image.h>
#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace ps {

namespace {

using Span = std::pair<std::uintptr_t, std::uintptr_t>;  ///< first byte, one past the last

struct Search {
  const link_map* object;
  std::vector<Span> writable;
  Span read_only{0, 0};
  bool found = false;
};

int visit(dl_phdr_info* info, std::size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  bool is_it = false;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = info->dlpi_phdr[i];
    if (header.p_type != PT_DYNAMIC) continue;
    is_it =
        info->dlpi_addr + header.p_vaddr == reinterpret_cast<std::uintptr_t>(search.object->l_ld);
  }
  if (!is_it) return 0;
  search.found = true;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = info->dlpi_phdr[i];
    const std::uintptr_t first = info->dlpi_addr + header.p_vaddr;
    const Span span{first, first + header.p_memsz};
    if (header.p_type == PT_LOAD && (header.p_flags & PF_W) != 0) search.writable.push_back(span);
    if (header.p_type == PT_GNU_RELRO) search.read_only = span;
  }
  return 1;
}

// The sanitizers put poisoned gaps between variables: plain copies would be reported, and so would
// memcpy().
__attribute__((no_sanitize("address", "undefined"))) void copy(unsigned char* to,
                                                               const unsigned char* from,
                                                               std::size_t size) {
  volatile unsigned char* target = to;
  const volatile unsigned char* source = from;
  for (std::size_t i = 0; i < size; ++i) target[i] = source[i];
}

}  // namespace

StaticImage::StaticImage(void* handle) {
  Search search{};
  if (dlinfo(handle, RTLD_DI_LINKMAP, &search.object) != 0) throw std::runtime_error(dlerror());
  dl_iterate_phdr(visit, &search);
  if (!search.found) throw std::runtime_error("its segments were not found");

  // The loader protects whole pages: the page in which the read-only part ends stays writable from
  // there on.
  const std::uintptr_t page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const Span locked{search.read_only.first & ~(page - 1), search.read_only.second & ~(page - 1)};
  const auto keep = [this](std::uintptr_t first, std::uintptr_t end) {
    if (first >= end) return;
    Range range{reinterpret_cast<unsigned char*>(first), std::vector<unsigned char>(end - first)};
    copy(range.bytes.data(), range.address, range.bytes.size());
    ranges_.push_back(std::move(range));
  };
  for (const Span& span : search.writable) {
    keep(span.first, std::min(span.second, std::max(span.first, locked.first)));
    keep(std::max(span.first, std::min(span.second, locked.second)), span.second);
  }
}

void StaticImage::restore() const {
  for (const Range& range : ranges_) copy(range.address, range.bytes.data(), range.bytes.size());
}

std::size_t StaticImage::size() const {
  std::size_t total = 0;
  for (const Range& range : ranges_) total += range.bytes.size();
  return total;
}

}  // namespace ps
