#include <ps/cpu/code_charge.h>

#include <sys/mman.h>

#include <cstring>

extern "C" void __sanitizer_cov_trace_pc(void);

namespace ps {

namespace {

constexpr std::size_t call_bytes = 5;

}  // namespace

CodeCharge::CodeCharge(const markervp_charge_area& area, const MachineCode& code) : area_(area) {
  const auto tracer = reinterpret_cast<std::uintptr_t>(&__sanitizer_cov_trace_pc);
  for (const MachineCode::Block& block : code.blocks(tracer)) {
    costs_.emplace(block.start, block.cost);
    Call call{reinterpret_cast<unsigned char*>(block.start) - call_bytes, call_bytes, {}, {}};
    std::memcpy(call.traced.data(), call.at, call_bytes);
    if (area_.stub_count != 0 && MachineCode::has_room(block.start)) {
      charge_here(call, block.cost);
    } else if (!charge_elsewhere(call, block.cost)) {
      continue;
    }
    calls_.push_back(call);
  }
}

// subq $cost, left(%rip); jle to what the room names.
void CodeCharge::charge_here(Call& call, std::uint32_t cost) const {
  constexpr std::size_t subtraction = 11, room_names = call_bytes + 3;
  call.bytes = MachineCode::charged_bytes;
  std::memcpy(call.traced.data(), call.at, call.bytes);
  std::memcpy(call.charged.data(), MachineCode::charged_begin, sizeof MachineCode::charged_begin);
  const auto left =
      static_cast<std::int32_t>(reinterpret_cast<std::uintptr_t>(area_.left) -
                                reinterpret_cast<std::uintptr_t>(call.at) - subtraction);
  std::memcpy(&call.charged[sizeof MachineCode::charged_begin], &left, sizeof left);
  std::memcpy(&call.charged[subtraction - sizeof cost], &cost, sizeof cost);
  call.charged[subtraction] = 0x0F;
  call.charged[subtraction + 1] = 0x8E;
  std::memcpy(&call.charged[subtraction + 2], call.at + room_names, sizeof left);
}

// The same call, of a piece.
bool CodeCharge::charge_elsewhere(Call& call, std::uint32_t cost) const {
  if (cost > area_.stub_count) return false;
  const auto piece =
      reinterpret_cast<std::uintptr_t>(area_.stubs) + (cost - 1) * std::uintptr_t{area_.stub_bytes};
  const auto distance =
      static_cast<std::int32_t>(piece - reinterpret_cast<std::uintptr_t>(call.at) - call_bytes);
  call.charged[0] = call.traced[0];
  std::memcpy(&call.charged[1], &distance, sizeof distance);
  return true;
}

void CodeCharge::start(bool direct) {
  lead(direct);
}

// The pages of the calls, from the first to the last, become writable meanwhile.
void CodeCharge::lead(bool to_pieces) {
  if (to_pieces == leads_to_pieces_ || calls_.empty()) return;
  constexpr std::uintptr_t page = 4096;
  const auto first = reinterpret_cast<std::uintptr_t>(calls_.front().at) & ~(page - 1);
  const auto end = reinterpret_cast<std::uintptr_t>(calls_.back().at) + calls_.back().bytes;
  auto* const pages = reinterpret_cast<void*>(first);
  if (mprotect(pages, end - first, PROT_READ | PROT_WRITE) != 0) return;
  for (const Call& call : calls_)
    std::memcpy(call.at, (to_pieces ? call.charged : call.traced).data(), call.bytes);
  mprotect(pages, end - first, PROT_READ | PROT_EXEC);
  leads_to_pieces_ = to_pieces;
}

}  // namespace ps
