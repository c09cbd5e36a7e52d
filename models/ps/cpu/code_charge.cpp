#include <ps/cpu/code_charge.h>

#include <sys/mman.h>

#include <cstring>

extern "C" void __sanitizer_cov_trace_pc(void);

namespace ps {

CodeCharge::CodeCharge(const markervp_charge_area& area, const MachineCode& code) : area_(area) {
  const auto tracer = reinterpret_cast<std::uintptr_t>(&__sanitizer_cov_trace_pc);
  for (const MachineCode::Block& block : code.blocks(tracer)) {
    costs_.emplace(block.start, block.cost);
    if (block.cost > area_.stub_count) continue;
    Call call{reinterpret_cast<unsigned char*>(block.start) - sizeof call.tracer, 0, 0};
    std::memcpy(&call.tracer, call.distance, sizeof call.tracer);
    const auto piece = reinterpret_cast<std::uintptr_t>(area_.stubs) +
                       (block.cost - 1) * std::uintptr_t{area_.stub_bytes};
    call.piece = static_cast<std::int32_t>(piece - block.start);
    calls_.push_back(call);
  }
}

void CodeCharge::start(bool direct) {
  lead(direct);
}

// The pages of the calls, from the first to the last, become writable meanwhile.
void CodeCharge::lead(bool to_pieces) {
  if (to_pieces == leads_to_pieces_ || calls_.empty()) return;
  constexpr std::uintptr_t page = 4096;
  const auto first = reinterpret_cast<std::uintptr_t>(calls_.front().distance) & ~(page - 1);
  const auto end = reinterpret_cast<std::uintptr_t>(calls_.back().distance) + sizeof(std::int32_t);
  auto* const pages = reinterpret_cast<void*>(first);
  if (mprotect(pages, end - first, PROT_READ | PROT_WRITE) != 0) return;
  for (const Call& call : calls_) {
    const std::int32_t distance = to_pieces ? call.piece : call.tracer;
    std::memcpy(call.distance, &distance, sizeof distance);
  }
  mprotect(pages, end - first, PROT_READ | PROT_EXEC);
  leads_to_pieces_ = to_pieces;
}

}  // namespace ps
