#include <ps/cpu/pointer_access.h>

#include <Zydis/Zydis.h>
#include <ucontext.h>

#include <cstddef>
#include <cstring>
#include <optional>

namespace ps {

namespace {

/// A general register as an instruction names a part of it.
struct Part {
  unsigned number;  ///< of the whole
  unsigned bytes;
  bool second_byte;  ///< AH, CH, DH, BH
};

std::optional<Part> general(ZydisRegister name) {
  const ZydisRegister whole = ZydisRegisterGetLargestEnclosing(ZYDIS_MACHINE_MODE_LONG_64, name);
  if (whole < ZYDIS_REGISTER_RAX || whole > ZYDIS_REGISTER_R15) return {};
  const bool second = name >= ZYDIS_REGISTER_AH && name <= ZYDIS_REGISTER_BH;
  return Part{static_cast<unsigned>(whole - ZYDIS_REGISTER_RAX),
              ZydisRegisterGetWidth(ZYDIS_MACHINE_MODE_LONG_64, name) / 8u, second};
}

struct Decoded {
  ZydisDecodedInstruction head;
  ZydisDecodedOperand operands[ZYDIS_MAX_OPERAND_COUNT];

  const ZydisDecodedOperand& memory() const {
    return operands[operands[0].type == ZYDIS_OPERAND_TYPE_MEMORY ? 0 : 1];
  }
  const ZydisDecodedOperand& other() const {
    return operands[operands[0].type == ZYDIS_OPERAND_TYPE_MEMORY ? 1 : 0];
  }
};

bool decode_at(std::uint64_t instruction, Decoded& found) {
  ZydisDecoder decoder;
  ZydisDecoderInit(&decoder, ZYDIS_MACHINE_MODE_LONG_64, ZYDIS_STACK_WIDTH_64);
  return ZYAN_SUCCESS(ZydisDecoderDecodeFull(&decoder, reinterpret_cast<const void*>(instruction),
                                             ZYDIS_MAX_INSTRUCTION_LENGTH, &found.head,
                                             found.operands));
}

/// Moves without arithmetic, as compilers make them for volatile variables.
bool is_move(ZydisMnemonic mnemonic) {
  switch (mnemonic) {
    case ZYDIS_MNEMONIC_MOV:
    case ZYDIS_MNEMONIC_MOVZX:
    case ZYDIS_MNEMONIC_MOVSX:
    case ZYDIS_MNEMONIC_MOVSXD:
    case ZYDIS_MNEMONIC_MOVD:
    case ZYDIS_MNEMONIC_MOVQ:
    case ZYDIS_MNEMONIC_MOVSS:
    case ZYDIS_MNEMONIC_MOVSD:
    case ZYDIS_MNEMONIC_MOVUPS:
    case ZYDIS_MNEMONIC_MOVAPS:
    case ZYDIS_MNEMONIC_MOVDQU:
    case ZYDIS_MNEMONIC_MOVDQA:
      return true;
    default:
      return false;
  }
}

unsigned vector_number(ZydisRegister name) {
  return static_cast<unsigned>(name - ZYDIS_REGISTER_XMM0);
}

bool names_vector(ZydisRegister name) {
  return name >= ZYDIS_REGISTER_XMM0 && name <= ZYDIS_REGISTER_XMM15;
}

}  // namespace

const char* PointerAccess::decode(Move& move) const {
  Decoded found;
  if (!decode_at(instruction, found)) return "an instruction that is not known";
  if (!is_move(found.head.mnemonic))
    return "an instruction that computes with it, or copies blocks";
  const ZydisDecodedOperand& memory = found.memory();
  const ZydisDecodedOperand& other = found.other();
  if (memory.type != ZYDIS_OPERAND_TYPE_MEMORY) return "a string instruction";
  move.store = &memory == &found.operands[0];
  move.bytes = memory.size / 8u;
  if (move.bytes > sizeof move.data) return "a vector instruction, as memcpy() does";
  std::memset(move.data, 0, sizeof move.data);
  if (other.type == ZYDIS_OPERAND_TYPE_IMMEDIATE) {
    std::memcpy(move.data, &other.imm.value.u, sizeof other.imm.value.u);
    return nullptr;
  }
  if (names_vector(other.reg.value)) {
    if (move.store) std::memcpy(move.data, vectors[vector_number(other.reg.value)], move.bytes);
    return nullptr;
  }
  const auto part = general(other.reg.value);
  if (!part) return "a register that holds no number";
  const std::uint64_t value = registers[part->number] >> (part->second_byte ? 8 : 0);
  if (move.store) std::memcpy(move.data, &value, sizeof value);
  return nullptr;
}

bool PointerAccess::is_vector() const {
  Decoded found;
  return decode_at(instruction, found) && found.other().type == ZYDIS_OPERAND_TYPE_REGISTER &&
         names_vector(found.other().reg.value);
}

void PointerAccess::complete(const Move& move) {
  Decoded found;
  decode_at(instruction, found);
  instruction += found.head.length;
  if (move.store) return;
  const ZydisRegister name = found.other().reg.value;
  if (names_vector(name)) {
    unsigned char* const vector = vectors[vector_number(name)];
    std::memset(vector, 0, sizeof vectors[0]);
    std::memcpy(vector, move.data, move.bytes);
    return;
  }
  const Part part = *general(name);
  std::uint64_t value = 0;
  std::memcpy(&value, move.data, move.bytes);
  const bool is_signed =
      found.head.mnemonic == ZYDIS_MNEMONIC_MOVSX || found.head.mnemonic == ZYDIS_MNEMONIC_MOVSXD;
  const unsigned bits = 8 * move.bytes;
  if (is_signed && bits < 64 && (value >> (bits - 1) & 1) != 0) value |= ~std::uint64_t{0} << bits;
  // Loads of 4 bytes clear the rest of a register, narrower ones leave it.
  std::uint64_t& whole = registers[part.number];
  if (part.bytes >= 4) {
    whole = part.bytes == 8 ? value : value & 0xFFFFFFFFu;
    return;
  }
  auto* const bytes = reinterpret_cast<unsigned char*>(&whole);
  std::memcpy(bytes + (part.second_byte ? 1 : 0), &value, part.bytes);
}

#if defined(__x86_64__)

namespace {

constexpr int by_number[] = {REG_RAX, REG_RCX, REG_RDX, REG_RBX, REG_RSP, REG_RBP,
                             REG_RSI, REG_RDI, REG_R8,  REG_R9,  REG_R10, REG_R11,
                             REG_R12, REG_R13, REG_R14, REG_R15};
/// Below the stack pointer, used by functions that call none.
constexpr std::uint64_t red_zone = 128;
/// For what resume() takes from below it.
constexpr std::uint64_t room = 16;

}  // namespace

// The state lies on the program's stack, below what it uses. A walk of the stack finds the
// instruction as the caller.
bool PointerAccess::divert(void* context, std::uintptr_t address, void (*make)(PointerAccess&)) {
  auto& machine = static_cast<ucontext_t*>(context)->uc_mcontext;
  const auto stack = static_cast<std::uint64_t>(machine.gregs[REG_RSP]);
  const std::uint64_t place =
      (stack - red_zone - room - sizeof(PointerAccess)) & ~std::uint64_t{63};
  auto& access = *reinterpret_cast<PointerAccess*>(place);
  for (unsigned i = 0; i < 16; ++i)
    access.registers[i] = static_cast<std::uint64_t>(machine.gregs[by_number[i]]);
  access.instruction = static_cast<std::uint64_t>(machine.gregs[REG_RIP]);
  access.flags = static_cast<std::uint64_t>(machine.gregs[REG_EFL]);
  access.address = address;
  std::memcpy(access.vectors, machine.fpregs->_xmm, sizeof access.vectors);
  std::uint64_t* const caller = reinterpret_cast<std::uint64_t*>(place) - 1;
  *caller = access.instruction + 1;
  machine.gregs[REG_RSP] = static_cast<greg_t>(reinterpret_cast<std::uintptr_t>(caller));
  machine.gregs[REG_RDI] = static_cast<greg_t>(place);
  machine.gregs[REG_RIP] = static_cast<greg_t>(reinterpret_cast<std::uintptr_t>(make));
  return true;
}

// What is left to restore when the stack pointer is lies below the red zone: a signal may come at
// any instruction. `ret` passes both.
void PointerAccess::resume() const {
  static_assert(offsetof(PointerAccess, instruction) == 128 &&
                offsetof(PointerAccess, flags) == 136 && offsetof(PointerAccess, vectors) == 144);
  asm volatile(R"(
    movq 32(%0), %%rcx
    movq 128(%0), %%rdx
    movq %%rdx, -136(%%rcx)
    movq 56(%0), %%rdx
    movq %%rdx, -144(%%rcx)
    subq $144, 32(%0)
    movups 144(%0), %%xmm0
    movups 160(%0), %%xmm1
    movups 176(%0), %%xmm2
    movups 192(%0), %%xmm3
    movups 208(%0), %%xmm4
    movups 224(%0), %%xmm5
    movups 240(%0), %%xmm6
    movups 256(%0), %%xmm7
    movups 272(%0), %%xmm8
    movups 288(%0), %%xmm9
    movups 304(%0), %%xmm10
    movups 320(%0), %%xmm11
    movups 336(%0), %%xmm12
    movups 352(%0), %%xmm13
    movups 368(%0), %%xmm14
    movups 384(%0), %%xmm15
    pushq 136(%0)
    popfq
    movq 0(%0), %%rax
    movq 8(%0), %%rcx
    movq 16(%0), %%rdx
    movq 24(%0), %%rbx
    movq 40(%0), %%rbp
    movq 48(%0), %%rsi
    movq 64(%0), %%r8
    movq 72(%0), %%r9
    movq 80(%0), %%r10
    movq 88(%0), %%r11
    movq 96(%0), %%r12
    movq 104(%0), %%r13
    movq 112(%0), %%r14
    movq 120(%0), %%r15
    movq 32(%0), %%rsp
    popq %%rdi
    ret $128
  )"
               :
               : "D"(this)
               : "memory");
  __builtin_unreachable();
}

#else

bool PointerAccess::divert(void*, std::uintptr_t, void (*)(PointerAccess&)) {
  return false;
}
void PointerAccess::resume() const {
  __builtin_trap();
}

#endif

}  // namespace ps
