// Where the application is: the calls that are under way, with lines where it has debug
// information.
#include <backtrace.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/auxv.h>
#include <unwind.h>

#include "client.h"

// Of the C++ library, where the application has one.
extern "C" __attribute__((weak)) char* __cxa_demangle(const char*, char*, std::size_t*, int*);

namespace shim {

namespace {

constexpr std::size_t most_frames = 128;
constexpr unsigned most_levels = 8;  // deeper ones say little

backtrace_state* debug = nullptr;
void* own_base = nullptr;
void* c_library_base = nullptr;
void* application_base = nullptr;
std::uintptr_t instruction = 0;

void ignore(void*, const char*, int) {}

void* base_of(std::uintptr_t address) {
  Dl_info info{};
  return ::dladdr(reinterpret_cast<void*>(address), &info) != 0 ? info.dli_fbase : nullptr;
}

struct Frames {
  std::uintptr_t at[most_frames];
  std::size_t count = 0;
};

// What a signal interrupted is at its instruction; who called, behind it.
_Unwind_Reason_Code take(_Unwind_Context* context, void* data) {
  Frames& frames = *static_cast<Frames*>(data);
  int at_instruction = 0;
  const std::uintptr_t address = _Unwind_GetIPInfo(context, &at_instruction);
  if (address == 0 || frames.count == most_frames) return _URC_END_OF_STACK;
  frames.at[frames.count++] = at_instruction != 0 ? address : address - 1;
  return _URC_NO_REASON;
}

/// Text of bounded length.
class Text {
 public:
  Text(char* text, std::size_t size) : text_(text), size_(size) { text_[0] = '\0'; }
  bool empty() const { return used_ == 0; }
  template <class... Value>
  void add(const char* format, Value... value) {
    if (used_ + 1 >= size_) return;
    const int more = ::snprintf(text_ + used_, size_ - used_, format, value...);
    if (more > 0) used_ = used_ + static_cast<std::size_t>(more) < size_ ? used_ + more : size_ - 1;
  }
  void add_name(const char* name) {
    int status = -1;
    char* const plain = __cxa_demangle ? __cxa_demangle(name, nullptr, nullptr, &status) : nullptr;
    add("%s", status == 0 && plain ? plain : name);
    ::free(plain);
  }

 private:
  char* text_;
  std::size_t size_, used_ = 0;
};

/// An address in the application: in one function, or in several that were inlined there.
struct Place {
  std::uintptr_t address;
  unsigned lines = 0;  ///< known of it, the innermost function's first
  const char* symbol = nullptr;
  std::uintptr_t start = 0;  ///< of the symbol
};

void take_symbol(void* data, std::uintptr_t, const char* name, std::uintptr_t start,
                 std::uintptr_t) {
  Place& place = *static_cast<Place*>(data);
  place.symbol = name;
  place.start = start;
}

int count_line(void* data, std::uintptr_t, const char* file, int, const char*) {
  if (file) ++static_cast<Place*>(data)->lines;
  return 0;
}

Place find(std::uintptr_t address) {
  Place place{address};
  ::backtrace_syminfo(debug, address, take_symbol, ignore, &place);
  ::backtrace_pcinfo(debug, address, count_line, ignore, &place);
  return place;
}

/// In its executable, or a library with debug information.
bool is_of_application(const Place& place) {
  const void* const base = base_of(place.address);
  if (base == application_base) return true;
  return base && base != own_base && base != c_library_base && place.lines != 0;
}

/// Writes what is there, as the platform does for programs of its own.
class Writer {
 public:
  explicit Writer(Text& text) : text_(text) {}

  void add(const Place& place) {
    has_one_line_ = text_.empty() && place.lines == 1;
    if (text_.empty()) add_counter(place);
    if (place.lines != 0) {
      ::backtrace_pcinfo(debug, place.address, take_line, ignore, this);
    } else if (how_ == called) {
      begin(place.symbol);
    }
    how_ = called;
  }

 private:
  static constexpr const char* inlined = ", in ";
  static constexpr const char* called = ", called from ";

  void add_counter(const Place& place) {
    const auto base = reinterpret_cast<std::uintptr_t>(base_of(place.address));
    text_.add("pc 0x%zx", static_cast<std::size_t>(place.address - base));
    if (!place.symbol) return;
    text_.add("%s", " ");
    text_.add_name(place.symbol);
    text_.add("+0x%zx", static_cast<std::size_t>(place.address - place.start));
  }
  void begin(const char* function) {
    text_.add("%s", how_);
    text_.add_name(function ? function : "?");
    how_ = called;
  }
  static int take_line(void* data, std::uintptr_t, const char* file, int line,
                       const char* function) {
    Writer& self = *static_cast<Writer*>(data);
    if (!file) return 0;
    if (!self.has_one_line_) self.begin(function);
    self.text_.add(" (%s:%d)", file, line);
    return 0;
  }

  Text& text_;
  const char* how_ = inlined;
  bool has_one_line_ = false;
};

}  // namespace

void stand_at(std::uintptr_t at) {
  instruction = at;
}

void prepare_to_locate() {
  own_base = base_of(reinterpret_cast<std::uintptr_t>(&own_base));
  c_library_base = base_of(reinterpret_cast<std::uintptr_t>(::dlsym(RTLD_NEXT, "abort")));
  application_base = base_of(::getauxval(AT_ENTRY));
  debug = ::backtrace_create_state(nullptr, 0, ignore, nullptr);
  Frames frames;
  _Unwind_Backtrace(take, &frames);
}

void locate(char* text, std::size_t size) {
  Text out(text, size);
  Frames frames;
  _Unwind_Backtrace(take, &frames);
  Writer writer(out);
  unsigned levels = 0;
  for (std::size_t i = 0; i < frames.count && levels < most_levels; ++i) {
    Place place = find(frames.at[i]);
    if (!is_of_application(place)) continue;
    if (levels++ == 0 && instruction != 0) place = find(instruction);
    writer.add(place);
    if (place.symbol && ::strcmp(place.symbol, "main") == 0) return;
  }
}

}  // namespace shim
