// xscugic.h.
#include <gic_registers.h>
#include <hal/hal.h>
#include <xscugic.h>

namespace {

static_assert(XSCUGIC_MAX_NUM_INTR_INPUTS == gic::id_count, "one entry per interrupt");

constexpr std::uint32_t default_priority = 0xA0;
constexpr std::uint32_t priority_mask = 0xF0;

XScuGic_Config config = {
    XPAR_SCUGIC_0_DEVICE_ID, XPAR_SCUGIC_0_CPU_BASEADDR, XPAR_SCUGIC_0_DIST_BASEADDR, {}};

/// What functions use that have no instance.
XScuGic without_instance = {&config, XIL_COMPONENT_IS_READY, 0};

u32 own_cpu = 0;

std::uint32_t cpu_interface(const XScuGic* instance, std::uint32_t offset) {
  return static_cast<std::uint32_t>(instance->Config->CpuBaseAddress) + offset;
}

std::uint32_t distributor(const XScuGic* instance, std::uint32_t offset) {
  return static_cast<std::uint32_t>(instance->Config->DistBaseAddress) + offset;
}

void initialise_distributor(const XScuGic* instance) {
  hal_write32(distributor(instance, gic::ICDDCR), 0);
  for (unsigned n = gic::first_spi / 16; n < gic::sense_registers; ++n) {
    hal_write32(distributor(instance, gic::ICDICFR(n)), 0);
  }
  for (unsigned n = 0; n < gic::byte_registers; ++n) {
    hal_write32(distributor(instance, gic::ICDIPR(n)), default_priority * 0x0101'0101u);
  }
  for (unsigned n = gic::first_spi / 4; n < gic::byte_registers; ++n) {
    hal_write32(distributor(instance, gic::ICDIPTR(n)), 0x0101'0101u << own_cpu);
  }
  for (unsigned n = 0; n < gic::bit_registers; ++n) {
    hal_write32(distributor(instance, gic::ICDICER(n)), 0xFFFF'FFFFu);
  }
  hal_write32(distributor(instance, gic::ICDDCR), gic::icddcr::EnableS);
}

void replace_bits(std::uint32_t address, std::uint32_t mask, std::uint32_t value) {
  hal_write32(address, (hal_read32(address) & ~mask) | value);
}

/// The register with an interrupt's target CPUs, and the bit in it of one of them.
std::uint32_t target_of(UINTPTR distributor_base, u32 id) {
  return static_cast<std::uint32_t>(distributor_base) + gic::ICDIPTR(id / 4);
}
std::uint32_t bit_of(u8 cpu, u32 id) {
  return 1u << cpu << id % 4 * 8;
}

}  // namespace

extern "C" {

XScuGic_Config* XScuGic_LookupConfig(UINTPTR DeviceId) {
  return DeviceId == config.DeviceId || DeviceId == config.DistBaseAddress ? &config : nullptr;
}

XScuGic_Config* XScuGic_LookupConfigBaseAddr(UINTPTR BaseAddress) {
  return BaseAddress == config.DistBaseAddress ? &config : nullptr;
}

s32 XScuGic_CfgInitialize(XScuGic* InstancePtr, XScuGic_Config* ConfigPtr, UINTPTR) {
  if (InstancePtr == nullptr || ConfigPtr == nullptr) return XST_INVALID_PARAM;
  InstancePtr->Config = ConfigPtr;
  InstancePtr->UnhandledInterrupts = 0;
  for (XScuGic_VectorTableEntry& entry : ConfigPtr->HandlerTable) entry = {nullptr, nullptr};
  initialise_distributor(InstancePtr);
  hal_write32(cpu_interface(InstancePtr, gic::ICCPMR), priority_mask);
  hal_write32(cpu_interface(InstancePtr, gic::ICCICR),
              gic::iccicr::EnableS | gic::iccicr::EnableNS | gic::iccicr::AckCtl);
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
  return XST_SUCCESS;
}

s32 XScuGic_Connect(XScuGic* InstancePtr, u32 Int_Id, Xil_InterruptHandler Handler,
                    void* CallBackRef) {
  if (Int_Id >= gic::id_count || Handler == nullptr) return XST_INVALID_PARAM;
  InstancePtr->Config->HandlerTable[Int_Id] = {Handler, CallBackRef};
  return XST_SUCCESS;
}

void XScuGic_Disconnect(XScuGic* InstancePtr, u32 Int_Id) {
  if (Int_Id >= gic::id_count) return;
  XScuGic_Disable(InstancePtr, Int_Id);
  InstancePtr->Config->HandlerTable[Int_Id] = {nullptr, nullptr};
}

void XScuGic_Enable(XScuGic* InstancePtr, u32 Int_Id) {
  if (Int_Id >= gic::id_count) return;
  hal_write32(distributor(InstancePtr, gic::ICDISER(Int_Id / 32)), 1u << Int_Id % 32);
}

void XScuGic_Disable(XScuGic* InstancePtr, u32 Int_Id) {
  if (Int_Id >= gic::id_count) return;
  hal_write32(distributor(InstancePtr, gic::ICDICER(Int_Id / 32)), 1u << Int_Id % 32);
}

void XScuGic_SetPriorityTriggerType(XScuGic* InstancePtr, u32 Int_Id, u8 Priority, u8 Trigger) {
  if (Int_Id >= gic::id_count) return;
  const unsigned byte = Int_Id % 4 * 8;
  replace_bits(distributor(InstancePtr, gic::ICDIPR(Int_Id / 4)), 0xFFu << byte,
               (Priority & gic::priority_mask) << byte);
  // Of a CPU's own interrupts the sense is fixed: it is not written where it is right already.
  const std::uint32_t senses = distributor(InstancePtr, gic::ICDICFR(Int_Id / 16));
  const unsigned pair = Int_Id % 16 * 2;
  const bool fixed = Int_Id < gic::first_spi;
  if (fixed && (hal_read32(senses) >> pair & 3u) == (Trigger & 3u)) return;
  replace_bits(senses, 3u << pair, (Trigger & 3u) << pair);
}

void XScuGic_GetPriorityTriggerType(XScuGic* InstancePtr, u32 Int_Id, u8* Priority, u8* Trigger) {
  if (Int_Id >= gic::id_count) return;
  const std::uint32_t priorities = hal_read32(distributor(InstancePtr, gic::ICDIPR(Int_Id / 4)));
  const std::uint32_t senses = hal_read32(distributor(InstancePtr, gic::ICDICFR(Int_Id / 16)));
  *Priority = static_cast<u8>(priorities >> Int_Id % 4 * 8);
  *Trigger = static_cast<u8>(senses >> Int_Id % 16 * 2 & 3u);
}

void XScuGic_InterruptMaptoCpu(XScuGic* InstancePtr, u8 Cpu_Id, u32 Int_Id) {
  XScuGic_InterruptMapFromCpuByDistAddr(InstancePtr->Config->DistBaseAddress, Cpu_Id, Int_Id);
}

void XScuGic_InterruptUnmapFromCpu(XScuGic* InstancePtr, u8 Cpu_Id, u32 Int_Id) {
  XScuGic_InterruptUnmapFromCpuByDistAddr(InstancePtr->Config->DistBaseAddress, Cpu_Id, Int_Id);
}

void XScuGic_UnmapAllInterruptsFromCpu(XScuGic* InstancePtr, u8 Cpu_Id) {
  XScuGic_UnmapAllInterruptsFromCpuByDistAddr(InstancePtr->Config->DistBaseAddress, Cpu_Id);
}

void XScuGic_InterruptMapFromCpuByDistAddr(UINTPTR DistBaseAddress, u8 Cpu_Id, u32 Int_Id) {
  if (Int_Id < gic::id_count)
    replace_bits(target_of(DistBaseAddress, Int_Id), 0, bit_of(Cpu_Id, Int_Id));
}

void XScuGic_InterruptUnmapFromCpuByDistAddr(UINTPTR DistBaseAddress, u8 Cpu_Id, u32 Int_Id) {
  if (Int_Id < gic::id_count)
    replace_bits(target_of(DistBaseAddress, Int_Id), bit_of(Cpu_Id, Int_Id), 0);
}

void XScuGic_UnmapAllInterruptsFromCpuByDistAddr(UINTPTR DistBaseAddress, u8 Cpu_Id) {
  for (u32 id = gic::first_spi; id < gic::id_count; id += 4) {
    replace_bits(target_of(DistBaseAddress, id), 0x0101'0101u << Cpu_Id, 0);
  }
}

void XScuGic_SetCpuID(u32 CpuCoreId) {
  Xil_AssertVoid(CpuCoreId <= 1U);
  own_cpu = CpuCoreId;
}

u32 XScuGic_GetCpuID(void) {
  return own_cpu;
}

s32 XScuGic_SoftwareIntr(XScuGic* InstancePtr, u32 Int_Id, u32 Cpu_Identifier) {
  if (Int_Id >= gic::sgi_count) return XST_INVALID_PARAM;
  hal_write32(
      distributor(InstancePtr, gic::ICDSGIR),
      (Cpu_Identifier << gic::icdsgir::CPUTargetList_shift & gic::icdsgir::CPUTargetList) | Int_Id);
  return XST_SUCCESS;
}

s32 XScuGic_SelfTest(XScuGic* InstancePtr) {
  constexpr std::uint32_t prime_cell[] = {0x0D, 0xF0, 0x05, 0xB1};  // CoreLink identification
  for (unsigned i = 0; i < 4; ++i) {
    if ((hal_read32(distributor(InstancePtr, gic::ICCIDR(i))) & 0xFF) != prime_cell[i]) {
      return XST_FAILURE;
    }
  }
  return XST_SUCCESS;
}

void XScuGic_Stop(XScuGic* InstancePtr) {
  for (unsigned n = 0; n < gic::bit_registers; ++n) {
    hal_write32(distributor(InstancePtr, gic::ICDICER(n)), 0xFFFF'FFFFu);
  }
  hal_write32(distributor(InstancePtr, gic::ICDDCR), 0);
  hal_write32(cpu_interface(InstancePtr, gic::ICCICR), 0);
}

s32 XScuGic_DeviceInitialize(u32 DeviceId) {
  return XScuGic_CfgInitialize(&without_instance, XScuGic_LookupConfig(DeviceId), 0);
}

void XScuGic_DeviceInterruptHandler(void* DeviceId) {
  without_instance.Config = XScuGic_LookupConfig(reinterpret_cast<UINTPTR>(DeviceId));
  if (without_instance.Config != nullptr) XScuGic_InterruptHandler(&without_instance);
}

void XScuGic_RegisterHandler(UINTPTR BaseAddress, s32 InterruptID, Xil_InterruptHandler Handler,
                             void* CallBackRef) {
  const bool exists = InterruptID >= 0 && static_cast<u32>(InterruptID) < gic::id_count;
  if (exists && BaseAddress == config.CpuBaseAddress) {
    config.HandlerTable[InterruptID] = {Handler, CallBackRef};
  }
}

void XScuGic_SetPriTrigTypeByDistAddr(UINTPTR DistBaseAddress, u32 Int_Id, u8 Priority,
                                      u8 Trigger) {
  without_instance.Config = &config;
  if (DistBaseAddress == config.DistBaseAddress) {
    XScuGic_SetPriorityTriggerType(&without_instance, Int_Id, Priority, Trigger);
  }
}

void XScuGic_GetPriTrigTypeByDistAddr(UINTPTR DistBaseAddress, u32 Int_Id, u8* Priority,
                                      u8* Trigger) {
  without_instance.Config = &config;
  if (DistBaseAddress == config.DistBaseAddress) {
    XScuGic_GetPriorityTriggerType(&without_instance, Int_Id, Priority, Trigger);
  }
}

void XScuGic_InterruptHandler(XScuGic* InstancePtr) {
  const std::uint32_t acknowledged = hal_read32(cpu_interface(InstancePtr, gic::ICCIAR));
  const std::uint32_t id = acknowledged & gic::icciar::ACKINTID;
  if (id >= gic::id_count) return;  // spurious: there is nothing to end
  const XScuGic_VectorTableEntry& entry = InstancePtr->Config->HandlerTable[id];
  if (entry.Handler != nullptr) {
    entry.Handler(entry.CallBackRef);
  } else {
    ++InstancePtr->UnhandledInterrupts;
  }
  hal_write32(cpu_interface(InstancePtr, gic::ICCEOIR), acknowledged);
}

}  // extern "C"
