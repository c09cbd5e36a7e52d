#include <ps/cpu/program_image.h>

#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <ps/memory/memory.h>
#include <vp/error.h>
#include <vp/foreign_object.h>
#include <vp/text.h>

namespace ps {

namespace {

constexpr std::uintptr_t host_page = 4096;

std::uintptr_t down(std::uintptr_t address) {
  return address & ~(host_page - 1);
}
std::uintptr_t up(std::uintptr_t address) {
  return down(address + host_page - 1);
}

struct Search {
  const link_map* object;
  std::vector<ElfW(Phdr)> headers;
};

int visit(dl_phdr_info* info, std::size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  const std::vector<ElfW(Phdr)> headers(info->dlpi_phdr, info->dlpi_phdr + info->dlpi_phnum);
  for (const ElfW(Phdr) & header : headers) {
    if (header.p_type == PT_DYNAMIC &&
        info->dlpi_addr + header.p_vaddr == reinterpret_cast<std::uintptr_t>(search.object->l_ld)) {
      search.headers = headers;
    }
  }
  return search.headers.empty() ? 0 : 1;
}

}  // namespace

ProgramImage::Span ProgramImage::wanted_by(const std::string& path) {
  // The loader refuses what is no program; a pipe would wait for its writer.
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {0, 0};
  std::ifstream file(path, std::ios::binary);
  Elf64_Ehdr header{};
  Span span{~std::uintptr_t{0}, 0};
  const bool is_elf = file.read(reinterpret_cast<char*>(&header), sizeof header) &&
                      std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 &&
                      header.e_ident[EI_CLASS] == ELFCLASS64;
  if (!is_elf) return {0, 0};
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment{};
    file.seekg(static_cast<std::streamoff>(header.e_phoff + i * sizeof segment));
    if (!file.read(reinterpret_cast<char*>(&segment), sizeof segment)) break;
    if (segment.p_type != PT_LOAD) continue;
    span.first = std::min<std::uintptr_t>(span.first, down(segment.p_vaddr));
    span.second = std::max<std::uintptr_t>(span.second, up(segment.p_vaddr + segment.p_memsz));
  }
  return span.second == 0 || span.first == 0 ? Span{0, 0} : span;
}

ProgramImage::ProgramImage(const std::string& path) : path_(path) {
  const Span wanted = wanted_by(path);
  try {
    reserve_heap(wanted);
    handle_ = vp::load_object(vp::program_object, path);
    take_segments();
    settle(wanted);
  } catch (...) {
    if (handle_) vp::unload_object(vp::program_object, path_, handle_);
    if (heap_.second != heap_.first)
      munmap(reinterpret_cast<void*>(heap_.first), heap_.second - heap_.first);
    throw;
  }
}

ProgramImage::~ProgramImage() {
  vp::unload_object(vp::program_object, path_, handle_);
  resident_.reset();
  if (heap_.second != heap_.first)
    munmap(reinterpret_cast<void*>(heap_.first), heap_.second - heap_.first);
}

void* ProgramImage::symbol(const char* name) const {
  return dlsym(handle_, name);
}

// For the constructors of static objects.
void ProgramImage::reserve_heap(const Span& wanted) {
  if (wanted.second == 0) return;
  const std::uintptr_t first = wanted.second + MARKERVP_HEAP_GAP;
  void* const at = reinterpret_cast<void*>(first);
  void* const got = mmap(at, MARKERVP_HEAP_AT_LOAD, PROT_READ | PROT_WRITE,
                         MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED_NOREPLACE, -1, 0);
  if (got == at) {
    heap_ = {first, first + MARKERVP_HEAP_AT_LOAD};
  } else if (got != MAP_FAILED) {
    munmap(got, MARKERVP_HEAP_AT_LOAD);
  }
}

void ProgramImage::take_segments() {
  Search search{};
  if (dlinfo(handle_, RTLD_DI_LINKMAP, &search.object) != 0) throw vp::InputError(dlerror());
  dl_iterate_phdr(visit, &search);
  if (search.headers.empty())
    throw vp::InputError("program '" + path_ + "': its segments were not found");
  bias_ = search.object->l_addr;
  // The loader protects whole pages: the page in which the read-only part ends stays writable from
  // there on.
  Span locked{0, 0};
  for (const ElfW(Phdr) & header : search.headers) {
    const std::uintptr_t first = bias_ + header.p_vaddr;
    if (header.p_type == PT_GNU_RELRO) locked = {down(first), down(first + header.p_memsz)};
  }
  for (const ElfW(Phdr) & header : search.headers) {
    if (header.p_type != PT_LOAD) continue;
    const Span span{bias_ + header.p_vaddr, bias_ + header.p_vaddr + header.p_memsz};
    mapped_.push_back({down(span.first), up(span.second)});
    if ((header.p_flags & PF_X) != 0) code_.emplace(span.first, span.second);
    if ((header.p_flags & PF_W) == 0) continue;
    const Span before{span.first, std::min(span.second, std::max(span.first, locked.first))};
    const Span behind{std::max(span.first, std::min(span.second, locked.second)), span.second};
    for (const Span& part : {before, behind}) {
      if (part.first < part.second) writable_.push_back(part);
    }
  }
}

// What the constructors took of the heap belongs to the variables.
void ProgramImage::settle(const Span& wanted) {
  if (wanted.second != 0 && (bias_ != 0 || heap_.first == 0)) {
    const std::uintptr_t end = wanted.second + MARKERVP_HEAP_GAP + MARKERVP_HEAP_AT_LOAD;
    const std::string who = heap_.first == 0 ? occupant(wanted.first, end) : "";
    throw vp::InputError("program '" + path_ + "' needs the host addresses " +
                         vp::hex(wanted.first) + " to " + vp::hex(end) + ", which " +
                         (who.empty() ? "the host refuses" : "are occupied by " + who) +
                         ": run one program at a time, or make its variables smaller");
  }
  for (const Span& part : writable_) keep(part.first, part.second);
  if (wanted.second == 0) return;
  const auto* const area = static_cast<const markervp_heap_area*>(symbol("markervp_heap"));
  const auto top = area && area->top ? reinterpret_cast<std::uintptr_t>(area->top) : heap_.first;
  if (up(top) < heap_.second) munmap(reinterpret_cast<void*>(up(top)), heap_.second - up(top));
  heap_.second = up(top);
  if (top != heap_.first) keep(heap_.first, top);
  std::vector<Resident::Part> parts;
  for (const Span& segment : mapped_) parts.push_back({segment.first, segment.second, false});
  for (const Span& span : writable_) {
    const Span pages{down(span.first), up(span.second)};
    Resident::Part& whole = *std::find_if(parts.begin(), parts.end(), [&](const auto& part) {
      return part.first <= pages.first && pages.second <= part.end;
    });
    const std::uint64_t end = whole.end;
    whole.end = pages.first;
    parts.push_back({pages.first, pages.second, true});
    if (pages.second < end) parts.push_back({pages.second, end, false});
  }
  if (heap_.second != heap_.first) parts.push_back({heap_.first, heap_.second, true});
  std::sort(parts.begin(), parts.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  parts.erase(std::remove_if(parts.begin(), parts.end(),
                             [](const auto& part) { return part.first == part.end; }),
              parts.end());
  resident_.emplace(std::filesystem::path(path_).stem().string(), parts);
}

// Most of the variables of a program are 0, in pages that need no copy.
void ProgramImage::keep(std::uintptr_t first, std::uintptr_t end) {
  for (std::uintptr_t at = first; at < end;) {
    const std::uintptr_t next = std::min(end, down(at) + host_page);
    std::vector<unsigned char> bytes(next - at);
    copy_variables(bytes.data(), reinterpret_cast<const void*>(at), bytes.size());
    const bool is_clear =
        std::all_of(bytes.begin(), bytes.end(), [](unsigned char byte) { return byte == 0; });
    if (is_clear) bytes.clear();
    Saved* const last = saved_.empty() ? nullptr : &saved_.back();
    if (last && last->address + last->size == reinterpret_cast<unsigned char*>(at) &&
        last->bytes.empty() == is_clear) {
      last->size += next - at;
      last->bytes.insert(last->bytes.end(), bytes.begin(), bytes.end());
    } else {
      saved_.push_back({reinterpret_cast<unsigned char*>(at), next - at, std::move(bytes)});
    }
    at = next;
  }
}

void ProgramImage::restore() const {
  for (const Saved& saved : saved_) {
    map_ahead(saved.address, saved.size);
    if (saved.bytes.empty()) {
      clear_variables(saved.address, saved.size);
    } else {
      copy_variables(saved.address, saved.bytes.data(), saved.size);
    }
  }
}

void ProgramImage::end_heap_at(std::uintptr_t end) const {
  auto* const area = static_cast<markervp_heap_area*>(symbol("markervp_heap"));
  if (area && resident_) area->end = reinterpret_cast<unsigned char*>(end);
}

void ProgramImage::close_heap() const {
  auto* const area = static_cast<markervp_heap_area*>(symbol("markervp_heap"));
  if (area) area->end = reinterpret_cast<unsigned char*>(1);  // before its first byte
}

}  // namespace ps
