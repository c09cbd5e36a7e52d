#include <ps/cpu/load_emulation.h>

#include <ucontext.h>

#include <cstring>

#if defined(__x86_64__)
#include <Zydis/Zydis.h>
#endif

namespace ps {

#if defined(__x86_64__)

namespace {

/// Where the context has a general register, whichever part of it is named; null for other
/// registers.
greg_t* place_of(ucontext_t& context, ZydisRegister named) {
  // As Zydis counts them, from RAX on.
  static constexpr int places[] = {REG_RAX, REG_RCX, REG_RDX, REG_RBX, REG_RSP, REG_RBP,
                                   REG_RSI, REG_RDI, REG_R8,  REG_R9,  REG_R10, REG_R11,
                                   REG_R12, REG_R13, REG_R14, REG_R15};
  const ZydisRegister whole = ZydisRegisterGetLargestEnclosing(ZYDIS_MACHINE_MODE_LONG_64, named);
  if (whole < ZYDIS_REGISTER_RAX || whole > ZYDIS_REGISTER_R15) return nullptr;
  return &context.uc_mcontext.gregs[places[whole - ZYDIS_REGISTER_RAX]];
}

bool is_plain_load(const ZydisDecodedInstruction& head, const ZydisDecodedOperand& to,
                   const ZydisDecodedOperand& from) {
  if (head.operand_count_visible != 2 || to.type != ZYDIS_OPERAND_TYPE_REGISTER ||
      from.type != ZYDIS_OPERAND_TYPE_MEMORY || to.size < 32)
    return false;
  return (head.mnemonic == ZYDIS_MNEMONIC_MOV && from.size == to.size) ||
         (head.mnemonic == ZYDIS_MNEMONIC_MOVZX && from.size < 32);
}

/// Whether the operand lies at `address`. A load that begins in the page before does not.
bool is_at(std::uintptr_t address, ucontext_t& context, const ZydisDecodedOperandMem& memory) {
  if (memory.segment != ZYDIS_REGISTER_DS && memory.segment != ZYDIS_REGISTER_SS) return false;
  auto sum = static_cast<std::uintptr_t>(memory.disp.value);
  if (memory.base != ZYDIS_REGISTER_NONE) {
    const greg_t* const base = place_of(context, memory.base);
    if (!base) return false;
    sum += static_cast<std::uintptr_t>(*base);
  }
  if (memory.index != ZYDIS_REGISTER_NONE) {
    const greg_t* const index = place_of(context, memory.index);
    if (!index) return false;
    sum += static_cast<std::uintptr_t>(*index) * memory.scale;
  }
  return sum == address;
}

}  // namespace

bool emulate_load(void* context, std::uintptr_t address, const unsigned char* source,
                  std::size_t most) {
  auto& state = *static_cast<ucontext_t*>(context);
  greg_t& next = state.uc_mcontext.gregs[REG_RIP];
  ZydisDecoder decoder;
  ZydisDecoderInit(&decoder, ZYDIS_MACHINE_MODE_LONG_64, ZYDIS_STACK_WIDTH_64);
  ZydisDecodedInstruction head;
  ZydisDecodedOperand operands[ZYDIS_MAX_OPERAND_COUNT];
  if (!ZYAN_SUCCESS(ZydisDecoderDecodeFull(&decoder, reinterpret_cast<const void*>(next),
                                           ZYDIS_MAX_INSTRUCTION_LENGTH, &head, operands)))
    return false;
  if (!is_plain_load(head, operands[0], operands[1])) return false;
  const std::size_t bytes = operands[1].size / 8;
  greg_t* const target = place_of(state, operands[0].reg.value);
  if (!target || bytes > most || !is_at(address, state, operands[1].mem)) return false;
  // What the load does not fill of the register becomes 0.
  std::uint64_t value = 0;
  std::memcpy(&value, source, bytes);
  *target = static_cast<greg_t>(value);
  next += head.length;
  return true;
}

#else

bool emulate_load(void*, std::uintptr_t, const unsigned char*, std::size_t) {
  return false;
}

#endif

}  // namespace ps
