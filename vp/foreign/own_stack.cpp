#include <vp/own_stack.h>

#include <ucontext.h>

#include <cstdint>
#include <exception>
#include <stdexcept>

/// Of a build with the address sanitizer (vp/report/address_sanitizer.cpp), and of no other.
extern "C" void markervp_note_stack(void* first, std::size_t size) __attribute__((weak));

namespace vp {

namespace {

struct Visit {
  void (*code)(void* context);
  void* context;
  std::exception_ptr thrown;
};

// makecontext() passes ints.
void enter(unsigned high, unsigned low) {
  auto& visit = *reinterpret_cast<Visit*>(std::uintptr_t{high} << 32 | low);
  try {
    visit.code(visit.context);
  } catch (...) {
    visit.thrown = std::current_exception();
  }
}

}  // namespace

void run_on_stack(void* first, std::size_t size, void (*code)(void* context), void* context) {
  Visit visit{code, context, nullptr};
  ucontext_t here, there;
  if (getcontext(&there) != 0) throw std::runtime_error("the host has no user contexts");
  there.uc_stack.ss_sp = first;
  there.uc_stack.ss_size = size;
  there.uc_link = &here;
  const auto address = reinterpret_cast<std::uintptr_t>(&visit);
  if (markervp_note_stack) markervp_note_stack(first, size);
  makecontext(&there, reinterpret_cast<void (*)()>(&enter), 2, static_cast<unsigned>(address >> 32),
              static_cast<unsigned>(address));
  // Not swapcontext(), at which the address sanitizer warns on the console. The end of `enter`
  // comes back to behind getcontext().
  volatile bool visited = false;
  getcontext(&here);
  if (!visited) {
    visited = true;
    setcontext(&there);
    throw std::runtime_error("the host enters no user context");
  }
  if (visit.thrown) std::rethrow_exception(visit.thrown);
}

}  // namespace vp
