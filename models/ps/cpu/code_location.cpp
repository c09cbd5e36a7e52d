#include <cxxabi.h>
#include <dlfcn.h>
#include <elf.h>
#include <execinfo.h>

#include <ps/cpu/code_location.h>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>

namespace ps {

namespace {

std::string hex_short(std::uintptr_t value) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text;
  do {
    text.insert(text.begin(), digits[value % 16]);
    value /= 16;
  } while (value != 0);
  return "0x" + text;
}

std::string demangled(const char* name) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> text(
      abi::__cxa_demangle(name, nullptr, nullptr, &status), std::free);
  return status == 0 && text ? text.get() : name;
}

/// A structure in the file's bytes; null if the file is too short.
template <class T>
const T* at(const std::vector<char>& file, std::uint64_t offset, std::uint64_t count = 1) {
  if (offset > file.size() || count > (file.size() - offset) / sizeof(T)) return nullptr;
  return reinterpret_cast<const T*>(file.data() + offset);
}

// The table that the loader does not need: a program's functions are hidden from others.
std::string symbol_in(const std::vector<char>& file, std::uintptr_t place) {
  const auto* header = at<Elf64_Ehdr>(file, 0);
  if (!header) return {};
  const auto* sections = at<Elf64_Shdr>(file, header->e_shoff, header->e_shnum);
  if (!sections) return {};
  for (unsigned i = 0; i < header->e_shnum; ++i) {
    const Elf64_Shdr& table = sections[i];
    if (table.sh_type != SHT_SYMTAB || table.sh_link >= header->e_shnum) continue;
    const std::uint64_t count = table.sh_size / sizeof(Elf64_Sym);
    const Elf64_Shdr& names = sections[table.sh_link];
    const auto* symbols = at<Elf64_Sym>(file, table.sh_offset, count);
    const auto* text = at<char>(file, names.sh_offset, names.sh_size);
    if (!symbols || !text) return {};
    for (std::uint64_t s = 0; s < count; ++s) {
      const Elf64_Sym& symbol = symbols[s];
      if (ELF64_ST_TYPE(symbol.st_info) != STT_FUNC || symbol.st_name >= names.sh_size) continue;
      if (place < symbol.st_value || place - symbol.st_value >= symbol.st_size) continue;
      return demangled(text + symbol.st_name) + "+" + hex_short(place - symbol.st_value);
    }
  }
  return {};
}

std::uintptr_t base_of(const void* address) {
  Dl_info info{};
  return dladdr(address, &info) != 0 ? reinterpret_cast<std::uintptr_t>(info.dli_fbase) : 0;
}

}  // namespace

CodeLocator::CodeLocator(const void* inside) {
  Dl_info info{};
  if (dladdr(inside, &info) == 0) return;
  file_ = info.dli_fname;
  base_ = reinterpret_cast<std::uintptr_t>(info.dli_fbase);
}

bool CodeLocator::contains(std::uintptr_t address) const {
  return base_ != 0 && base_of(reinterpret_cast<const void*>(address)) == base_;
}

std::string CodeLocator::text(std::uintptr_t address) const {
  std::ifstream stream(file_, std::ios::binary);
  const std::vector<char> file((std::istreambuf_iterator<char>(stream)),
                               std::istreambuf_iterator<char>());
  const std::uintptr_t place = address - base_;
  const std::string symbol = symbol_in(file, place);
  return hex_short(place) + (symbol.empty() ? "" : " " + symbol);
}

std::uintptr_t CodeLocator::first_inside(const std::vector<std::uintptr_t>& addresses) const {
  for (const std::uintptr_t address : addresses) {
    if (contains(address)) return address;
  }
  return 0;
}

std::vector<std::uintptr_t> return_addresses() {
  constexpr int most = 128;
  void* frames[most];
  const int count = backtrace(frames, most);
  std::vector<std::uintptr_t> addresses;
  for (int i = 0; i < count; ++i) {
    addresses.push_back(reinterpret_cast<std::uintptr_t>(frames[i]) - 1);
  }
  return addresses;
}

}  // namespace ps
