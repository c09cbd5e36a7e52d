#include <ps/cpu/machine_code.h>

#include <Zydis/Zydis.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>

namespace ps {

namespace {

/// What an instruction of code compiled with -O0 takes on a Cortex-A9, in cycles, by its kind. All
/// derived: non-negative least squares over 33 small programs (checksums, filters, sorting,
/// matrices, strings, state machines …), whose A9 code of -O0 was timed as scripts/calibrate does,
/// with llvm-mca and warm caches. Errors: 10 % on average, 25 % at most (docs/calibration.md).
namespace cost {
constexpr double plain = 0.69;        ///< between registers
constexpr double load = 0.74;         ///< an operand that is read from memory
constexpr double store = 1.42;        ///< one that is written
constexpr double call = 0.42;         ///< call, return, push, pop
constexpr double multiply = 2.9;      ///< of integers
constexpr double divide = 28.6;       ///< of integers: a function of the library there
constexpr double real = 5.5;          ///< of floating point: addition, multiplication, conversion
constexpr double real_divide = 10.1;  ///< division, square root
}  // namespace cost

struct Instruction {
  ZydisDecodedInstruction head;
  ZydisDecodedOperand operands[ZYDIS_MAX_OPERAND_COUNT];
  std::uintptr_t next;  ///< address behind it

  /// Of a jump or call; none: it is computed.
  std::optional<std::uintptr_t> target() const {
    const ZydisDecodedOperand& operand = operands[0];
    if (operand.type != ZYDIS_OPERAND_TYPE_IMMEDIATE || !operand.imm.is_relative) return {};
    return next + static_cast<std::uintptr_t>(operand.imm.value.s);
  }
};

class Decoder {
 public:
  Decoder() { ZydisDecoderInit(&decoder_, ZYDIS_MACHINE_MODE_LONG_64, ZYDIS_STACK_WIDTH_64); }
  std::optional<Instruction> at(std::uintptr_t address, std::uintptr_t end) const {
    Instruction found{};
    if (address >= end ||
        !ZYAN_SUCCESS(ZydisDecoderDecodeFull(&decoder_, reinterpret_cast<const void*>(address),
                                             end - address, &found.head, found.operands))) {
      return {};
    }
    found.next = address + found.head.length;
    return found;
  }

 private:
  ZydisDecoder decoder_;
};

double cost_of_operation(const Instruction& instruction, bool in_memory) {
  switch (instruction.head.mnemonic) {
    case ZYDIS_MNEMONIC_CALL:
    case ZYDIS_MNEMONIC_RET:
    case ZYDIS_MNEMONIC_PUSH:
    case ZYDIS_MNEMONIC_POP:
    case ZYDIS_MNEMONIC_LEAVE:
      return cost::call;
    case ZYDIS_MNEMONIC_IMUL:
    case ZYDIS_MNEMONIC_MUL:
      return cost::multiply;
    case ZYDIS_MNEMONIC_IDIV:
    case ZYDIS_MNEMONIC_DIV:
      return cost::divide;
    case ZYDIS_MNEMONIC_DIVSS:
    case ZYDIS_MNEMONIC_DIVSD:
    case ZYDIS_MNEMONIC_SQRTSS:
    case ZYDIS_MNEMONIC_SQRTSD:
      return cost::real_divide;
    case ZYDIS_MNEMONIC_ADDSS:
    case ZYDIS_MNEMONIC_ADDSD:
    case ZYDIS_MNEMONIC_SUBSS:
    case ZYDIS_MNEMONIC_SUBSD:
    case ZYDIS_MNEMONIC_MULSS:
    case ZYDIS_MNEMONIC_MULSD:
      return cost::real;
    // What a 32-bit processor does without.
    case ZYDIS_MNEMONIC_CDQE:
    case ZYDIS_MNEMONIC_CWDE:
    case ZYDIS_MNEMONIC_CDQ:
    case ZYDIS_MNEMONIC_CQO:
    case ZYDIS_MNEMONIC_MOVSXD:
    case ZYDIS_MNEMONIC_MOVAPS:
    case ZYDIS_MNEMONIC_MOVAPD:
    case ZYDIS_MNEMONIC_PXOR:
    case ZYDIS_MNEMONIC_NOP:
    case ZYDIS_MNEMONIC_ENDBR64:
      return 0;
    default:
      break;
  }
  const char* const name = ZydisMnemonicGetString(instruction.head.mnemonic);
  switch (instruction.head.meta.category) {
    case ZYDIS_CATEGORY_CONVERT:
      return cost::real;
    case ZYDIS_CATEGORY_COND_BR:  // predicted, and issued beside another
    case ZYDIS_CATEGORY_UNCOND_BR:
      return 0;
    default:
      return in_memory && std::strncmp(name, "mov", 3) == 0 ? 0 : cost::plain;
  }
}

double cost_of(const Instruction& instruction) {
  unsigned reads = 0, writes = 0;
  for (unsigned i = 0; i < instruction.head.operand_count_visible; ++i) {
    const ZydisDecodedOperand& operand = instruction.operands[i];
    if (operand.type != ZYDIS_OPERAND_TYPE_MEMORY || operand.mem.type != ZYDIS_MEMOP_TYPE_MEM) {
      continue;
    }
    if ((operand.actions & ZYDIS_OPERAND_ACTION_MASK_READ) != 0) ++reads;
    if ((operand.actions & ZYDIS_OPERAND_ACTION_MASK_WRITE) != 0) ++writes;
  }
  return cost_of_operation(instruction, reads + writes != 0) + reads * cost::load +
         writes * cost::store;
}

constexpr std::size_t room_bytes = 12;

/// A call of the tracer was replaced by what charges the block.
bool is_charged(std::uintptr_t at, std::uintptr_t end) {
  constexpr std::size_t jump = 11;
  const auto* const bytes = reinterpret_cast<const unsigned char*>(at);
  return at + MachineCode::charged_bytes <= end &&
         std::memcmp(bytes, MachineCode::charged_begin, sizeof MachineCode::charged_begin) == 0 &&
         bytes[jump] == 0x0F && bytes[jump + 1] == 0x8E;
}

/// The address that a stub of the linker's jumps to, through a table that the loader filled.
std::optional<std::uintptr_t> through_table(const Decoder& decoder, std::uintptr_t stub,
                                            std::uintptr_t end) {
  auto jump = decoder.at(stub, end);
  if (jump && jump->head.mnemonic == ZYDIS_MNEMONIC_ENDBR64) jump = decoder.at(jump->next, end);
  if (!jump || jump->head.mnemonic != ZYDIS_MNEMONIC_JMP) return {};
  const ZydisDecodedOperand& operand = jump->operands[0];
  if (operand.type != ZYDIS_OPERAND_TYPE_MEMORY || operand.mem.base != ZYDIS_REGISTER_RIP)
    return {};
  return *reinterpret_cast<const std::uintptr_t*>(
      jump->next + static_cast<std::uintptr_t>(operand.mem.disp.value));
}

/// Where a `switch` leads: its compare with the last case, and the table of 32-bit offsets that
/// GCC and Clang jump through. Follows the instructions of one path.
class JumpTable {
 public:
  void look_at(const Instruction& instruction) {
    const auto mnemonic = instruction.head.mnemonic;
    const ZydisDecodedOperand& from = instruction.operands[1];
    if (mnemonic == ZYDIS_MNEMONIC_CMP || mnemonic == ZYDIS_MNEMONIC_SUB) {
      compared_ = from.type == ZYDIS_OPERAND_TYPE_IMMEDIATE ? from.imm.value.u : most_cases;
    } else if (instruction.head.meta.category == ZYDIS_CATEGORY_COND_BR) {
      cases_ = mnemonic == ZYDIS_MNEMONIC_JNBE && compared_ < most_cases ? compared_ + 1 : 0;
      table_ = 0;
    } else if (mnemonic == ZYDIS_MNEMONIC_LEA && from.mem.base == ZYDIS_REGISTER_RIP) {
      table_ = instruction.next + static_cast<std::uintptr_t>(from.mem.disp.value);
    }
  }

  /// The targets of a jump that computes where it goes; none: it is no `switch` that is known.
  std::vector<std::uintptr_t> targets() const {
    std::vector<std::uintptr_t> found(table_ == 0 ? 0 : cases_);
    for (std::size_t i = 0; i < found.size(); ++i) {
      std::int32_t offset;
      std::memcpy(&offset, reinterpret_cast<const char*>(table_) + i * sizeof offset,
                  sizeof offset);
      found[i] = table_ + static_cast<std::uintptr_t>(std::intptr_t{offset});
    }
    return found;
  }

 private:
  static constexpr std::uint64_t most_cases = 1024;

  std::uint64_t compared_ = most_cases;  ///< with a constant
  std::size_t cases_ = 0;
  std::uintptr_t table_ = 0;
};

}  // namespace

bool MachineCode::has_room(std::uintptr_t start) {
  constexpr unsigned char first[] = {0x0F, 0x1F, 0x80}, second[] = {0x0F, 0x1F, 0x44, 0, 0};
  const auto* const bytes = reinterpret_cast<const unsigned char*>(start);
  return std::memcmp(bytes, first, sizeof first) == 0 &&
         std::memcmp(bytes + 7, second, sizeof second) == 0;
}

std::vector<MachineCode::Block> MachineCode::blocks(std::uintptr_t tracer) const {
  const Decoder decoder;
  std::vector<Block> found;
  double cycles = 0;  // since the last call, or the last function's end
  bool in_block = false;
  std::optional<std::uintptr_t> stub;  // of the tracer
  const auto is_call_of_tracer = [&](const Instruction& instruction) {
    if (instruction.head.mnemonic != ZYDIS_MNEMONIC_CALL) return false;
    const auto target = instruction.target();
    if (!target || !contains(*target)) return false;
    if (!stub && through_table(decoder, *target, end_) == tracer) stub = target;
    return stub == target;
  };
  const auto close = [&] {
    if (!in_block) return;
    found.back().cost =
        static_cast<std::uint32_t>(std::max<long>(1, std::lround(cycles * units_per_cycle)));
    cycles = 0;
    in_block = false;
  };
  for (std::uintptr_t at = first_; at < end_;) {
    const auto instruction = decoder.at(at, end_);
    if (!instruction) {
      ++at;  // padding, or a table
      continue;
    }
    at = instruction->next;
    if (is_call_of_tracer(*instruction)) {
      close();
      found.push_back({at, 1});
      in_block = true;
      if (at + room_bytes <= end_ && has_room(at)) at += room_bytes;
      continue;
    }
    // What a charge that is used up leads to: call, addition, jump.
    if (instruction->head.mnemonic == ZYDIS_MNEMONIC_CALL && instruction->target() == at) {
      for (auto next = decoder.at(at, end_); next; next = decoder.at(at, end_)) {
        at = next->next;
        if (next->head.mnemonic == ZYDIS_MNEMONIC_JMP) break;
      }
      continue;
    }
    cycles += cost_of(*instruction);
    if (instruction->head.mnemonic != ZYDIS_MNEMONIC_RET) continue;
    close();
    cycles = 0;
  }
  close();
  return found;
}

MachineCode::Reach MachineCode::reach(std::uintptr_t from) const {
  constexpr std::size_t most = 1'000'000;  // instructions of a function
  const Decoder decoder;
  std::set<std::uintptr_t> seen;
  std::vector<std::uintptr_t> open{from};
  Reach found = Reach::straight;
  while (!open.empty()) {
    std::uintptr_t at = open.back();
    open.pop_back();
    JumpTable table;
    while (seen.insert(at).second) {
      if (contains(at) && is_charged(at, end_)) {
        at += charged_bytes;
        continue;
      }
      const auto instruction = contains(at) ? decoder.at(at, end_) : std::nullopt;
      if (!instruction || seen.size() > most) return Reach::returns;
      const auto category = instruction->head.meta.category;
      if (category == ZYDIS_CATEGORY_RET) return Reach::returns;
      at = instruction->next;
      table.look_at(*instruction);
      if (category == ZYDIS_CATEGORY_UNCOND_BR) {
        const auto target = instruction->target();
        if (target) {
          at = *target;
          continue;
        }
        const std::vector<std::uintptr_t> cases = table.targets();
        if (cases.empty()) return Reach::returns;
        open.insert(open.end(), cases.begin(), cases.end());
        found = Reach::loops;
        break;
      } else if (category == ZYDIS_CATEGORY_COND_BR) {
        const auto target = instruction->target();
        if (!target) return Reach::returns;
        open.push_back(*target);
        found = Reach::loops;
      }
    }
  }
  return found;
}

}  // namespace ps
