#include <ps/cpu/program_watch.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>

#include <backtrace.h>
#include <cxxabi.h>
#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <ucontext.h>
#include <unistd.h>
#include <unwind.h>

namespace ps {

namespace {

#if defined(__x86_64__)
/// Where an empty loop continues. A leaf function may be in one with any stack pointer.
__attribute__((noinline, force_align_arg_pointer)) void loop_with_call() {
  while (true) look_at_empty_loop();
}

// As if the jump were a call: a stack walk finds the loop. What lies below the stack pointer
// is of no use any more.
void leave_empty_loop(void* context) {
  greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const auto instruction = static_cast<std::uintptr_t>(registers[REG_RIP]);
  if (!HostWatch::is_empty_loop(instruction)) return;
  registers[REG_RSP] -= static_cast<greg_t>(sizeof(std::uintptr_t));
  *reinterpret_cast<std::uintptr_t*>(registers[REG_RSP]) = instruction + 1;
  registers[REG_RIP] = reinterpret_cast<greg_t>(&loop_with_call);
}
#else
void leave_empty_loop(void*) {}
#endif

}  // namespace

// The program must not be ended from outside in the middle of this.
bool ProgramWatch::count_block(std::uintptr_t address) {
  constexpr std::uint32_t elsewhere =
      MachineCode::units_per_cycle;  // instrumented, but not its own
  runs = false;
  if (block_counts) ++(*block_counts)[address];
  const std::uint32_t cost = charge ? charge->cost_at(address) : 0;
  runs = true;
  if (charge) {
    const std::int64_t left = charge->left() - (cost != 0 ? cost : elsewhere);
    charge->left() = left;
    blocks_left = blocks_limit;
    return left > 0;
  }
  if (++counted_ >= counted_limit_) return false;
  blocks_left = blocks_limit;
  return true;
}

bool HostWatch::is_empty_loop(std::uintptr_t instruction) {
#if defined(__x86_64__)
  const auto* bytes = reinterpret_cast<const unsigned char*>(instruction);
  constexpr unsigned char jump = 0xEB, to_itself = 0xFE, to_nop = 0xFD, nop = 0x90;
  if (bytes[0] == nop) return bytes[1] == jump && bytes[2] == to_nop;
  return bytes[0] == jump && (bytes[1] == to_itself || (bytes[1] == to_nop && bytes[-1] == nop));
#else
  static_cast<void>(instruction);
  return false;
#endif
}

void HostWatch::arm(const HostLimit& limit) {
  if (limit.ns == 0) return;
  limit_ = limit;
  spent_ns_ = progress_ = 0;
  told_ = false;
  vp::HostTicks::add(*this);
}

void HostWatch::disarm() {
  vp::HostTicks::remove(*this);
}

void HostWatch::on_host_tick(std::uint64_t spent_ns, void* context) {
  count(spent_ns);
  const bool runs = ProgramWatch::runs;
  const bool told_before = told_;
  if (runs && told_before && !ProgramWatch::ends_itself)
    return vp::FaultTrap::leave_from_signal(context);
  told_ = ProgramWatch::stop != ProgramWatch::Stop::none;
  // Each call of the HAL sets the number of basic blocks anew.
  if (told_) ProgramWatch::ask_to_stop(ProgramWatch::stop);
  // It is in a HAL call, between which it may be hardly ever.
  if (told_before) vp::HostTicks::hurry();
  if (runs) leave_empty_loop(context);
}

void HostWatch::count(std::uint64_t spent_ns) {
  const std::uint64_t progress = limit_.progress ? limit_.progress(limit_.context) : 0;
  const bool in_one_call = !ProgramWatch::runs && ProgramWatch::mark_call();
  if (progress != progress_) spent_ns_ = 0;
  progress_ = progress;
  if (in_one_call) return;
  spent_ns_ += spent_ns;
  if (spent_ns_ >= limit_.ns && ProgramWatch::stop == ProgramWatch::Stop::none) {
    ProgramWatch::ask_to_stop(ProgramWatch::Stop::host_time);
  }
}

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
  link_map* object = nullptr;
  if (dladdr1(inside, &info, reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP) == 0) return;
  file_ = info.dli_fname;
  base_ = reinterpret_cast<std::uintptr_t>(info.dli_fbase);
  bias_ = object->l_addr;
}

bool CodeLocator::contains(std::uintptr_t address) const {
  return base_ != 0 && base_of(reinterpret_cast<const void*>(address)) == base_;
}

const std::string& CodeLocator::text(std::uintptr_t address) const {
  const auto [known, is_new] = texts_.try_emplace(address);
  if (is_new) known->second = look_up(address);
  return known->second;
}

std::string CodeLocator::look_up(std::uintptr_t address) const {
  if (content_.empty()) {
    std::ifstream stream(file_, std::ios::binary);
    content_.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  const std::uintptr_t place = this->place(address);
  const std::string symbol = symbol_in(content_, place);
  return hex_short(place) + (symbol.empty() ? "" : " " + symbol);
}

// An instruction that was inlined has several, the innermost first. libbacktrace knows the objects
// that were loaded when it was asked for the first time.
std::vector<CodeLocator::Line> CodeLocator::lines(std::uintptr_t address) const {
  const auto ignore = [](void*, const char*, int) {};
  if (!debug_) debug_ = backtrace_create_state(nullptr, 0, ignore, nullptr);
  std::vector<Line> found;
  if (!debug_) return found;
  const auto take = [](void* data, std::uintptr_t, const char* file, int line,
                       const char* function) {
    if (!file) return 0;
    static_cast<std::vector<Line>*>(data)->push_back(
        {function ? demangled(function) : "", std::string(file) + ":" + std::to_string(line)});
    return 0;
  };
  backtrace_pcinfo(debug_, address, take, ignore, &found);
  return found;
}

std::string CodeLocator::symbol(std::uintptr_t address) const {
  const std::string& place = text(address);
  const std::size_t from = place.find(' '), to = place.rfind('+');
  if (from == place.npos || to == place.npos || to < from) return {};
  return place.substr(from + 1, to - from - 1);
}

std::vector<std::string> CodeLocator::functions(std::uintptr_t address) const {
  std::vector<std::string> names;
  for (Line& line : lines(address)) names.push_back(std::move(line.function));
  if (!names.empty()) names.pop_back();
  const std::string around = symbol(address);
  names.push_back(around.empty() ? text(address) : around);
  return names;
}

// Parts of a function that seldom run lie elsewhere, with names of their own. Two functions of one
// name are one.
std::map<std::string, std::uint64_t> CodeLocator::calls(
    const ProgramWatch::BlockCounts& blocks) const {
  std::map<std::uintptr_t, std::uint64_t> in_order(blocks.begin(), blocks.end());
  std::map<std::string, std::uint64_t> calls;
  std::uintptr_t last_start = 0;
  for (const auto& [address, count] : in_order) {
    if (!contains(address)) continue;
    const std::string name = symbol(address);
    if (name.empty() || name.find("[clone .cold") != name.npos) continue;
    const std::string& place = text(address);
    const std::uintptr_t start =
        address - std::strtoull(place.c_str() + place.rfind('+') + 1, nullptr, 16);
    if (start == last_start) continue;
    last_start = start;
    calls[name] += count;
  }
  return calls;
}

std::string CodeLocator::path(const std::vector<std::uintptr_t>& calls) const {
  constexpr std::size_t most = 8;  // levels: deeper ones say little
  std::string text;
  std::size_t levels = 0;
  const char* how = ", in ";
  const auto add = [&](const Line& line) {
    if (++levels > most) return;
    text += how + line.function + (line.place.empty() ? "" : " (" + line.place + ")");
    how = ", called from ";
  };
  for (const std::uintptr_t call : calls) {
    if (!contains(call)) continue;
    const std::vector<Line> found = lines(call);
    const bool innermost = text.empty();
    if (innermost) text = "pc " + this->text(call);
    if (innermost && found.size() < 2) {
      if (!found.empty()) text += " (" + found.front().place + ")";
      how = ", called from ";
    } else if (found.empty()) {
      add({functions(call).front(), ""});
    } else {
      for (const Line& line : found) add(line);
    }
  }
  return levels > most ? text + ", …" : text;
}

// The first address is that of the interrupted instruction; the others are return addresses.
std::vector<std::uintptr_t> return_addresses() {
  std::vector<std::uintptr_t> addresses;
  const auto take = [](_Unwind_Context* frame, void* list) {
    constexpr std::size_t most = 128;
    auto& found = *static_cast<std::vector<std::uintptr_t>*>(list);
    int at_instruction = 0;
    const std::uintptr_t address = _Unwind_GetIPInfo(frame, &at_instruction);
    if (address == 0) return _URC_END_OF_STACK;
    found.push_back(at_instruction != 0 ? address : address - 1);
    return found.size() < most ? _URC_NO_REASON : _URC_END_OF_STACK;
  };
  _Unwind_Backtrace(take, &addresses);
  return addresses;
}

}  // namespace ps
