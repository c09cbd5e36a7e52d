#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <hal/native_program.h>
#include <ps/cpu/machine_code.h>

namespace ps {

/// Charges a program for the basic blocks that it runs, in units of MachineCode::Block.
///
/// While it is on, the blocks' calls of __sanitizer_cov_trace_pc() are replaced by instructions
/// that take the cost of their block from a number in the program, and call markervp_charge_spent()
/// once it is used up. Where a call has no room for them behind it (MarkervpAssembly.h makes it),
/// it leads to a piece of code that does the same, at about a nanosecond a block. Blocks that cost
/// more than there are pieces for still call the tracer, and so do all where the host has none: the
/// sum is the same.
class CodeCharge {
 public:
  /// `area` and `code` are the program's, and outlive it.
  CodeCharge(const markervp_charge_area& area, const MachineCode& code);

  /// Turns it on for a run. `direct` false: each block calls the tracer, for one who counts them.
  void start(bool direct);
  /// Blocks call the tracer, which charges nothing.
  void stop() { lead(false); }

  volatile std::int64_t& left() const { return *area_.left; }
  /// Of the block that begins at this address; 0: it is not the program's.
  std::uint32_t cost_at(std::uintptr_t start) const {
    const auto found = costs_.find(start);
    return found == costs_.end() ? 0 : found->second;
  }

 private:
  /// A call, and what takes its place while the program is charged.
  struct Call {
    unsigned char* at;
    std::size_t bytes;
    std::array<unsigned char, MachineCode::charged_bytes> traced, charged;
  };
  void lead(bool to_pieces);
  void charge_here(Call& call, std::uint32_t cost) const;
  bool charge_elsewhere(Call& call, std::uint32_t cost) const;

  const markervp_charge_area& area_;
  std::unordered_map<std::uintptr_t, std::uint32_t> costs_;
  std::vector<Call> calls_;
  bool leads_to_pieces_ = false;
};

}  // namespace ps
