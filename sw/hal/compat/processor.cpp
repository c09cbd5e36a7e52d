// xscugic.h.
#include <algorithm>

#include <gic_registers.h>
#include <global_timer_registers.h>
#include <hal/hal.h>
#include <sleep.h>
#include <xscugic.h>
#include <xtime_l.h>

namespace {

static_assert(XSCUGIC_MAX_NUM_INTR_INPUTS == gic::id_count, "one entry per interrupt");

constexpr std::uint32_t default_priority = 0xA0;
constexpr std::uint32_t priority_mask = 0xF0;

XScuGic_Config config = {
    XPAR_SCUGIC_0_DEVICE_ID, XPAR_SCUGIC_0_CPU_BASEADDR, XPAR_SCUGIC_0_DIST_BASEADDR, {}};

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
    hal_write32(distributor(instance, gic::ICDIPTR(n)), 0x0101'0101u);
  }
  for (unsigned n = 0; n < gic::bit_registers; ++n) {
    hal_write32(distributor(instance, gic::ICDICER(n)), 0xFFFF'FFFFu);
  }
  hal_write32(distributor(instance, gic::ICDDCR), gic::icddcr::EnableS);
}

void replace_bits(std::uint32_t address, std::uint32_t mask, std::uint32_t value) {
  hal_write32(address, (hal_read32(address) & ~mask) | value);
}

}  // namespace

extern "C" {

XScuGic_Config* XScuGic_LookupConfig(u16 DeviceId) {
  return DeviceId == config.DeviceId ? &config : nullptr;
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
  const unsigned pair = Int_Id % 16 * 2;
  replace_bits(distributor(InstancePtr, gic::ICDICFR(Int_Id / 16)), 3u << pair,
               (Trigger & 3u) << pair);
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

// xtime_l.h and sleep.h.

namespace {

constexpr std::uint32_t at(std::uint32_t offset) {
  return global_timer::base + offset;
}

/// Cycles that one look at the timer may make pass on the virtual platform.
constexpr std::uint64_t longest_step = 1u << 30;

/// On the chip one look follows the other; on the platform each makes all of the time pass.
void wait_counts(u64 counts) {
  XTime now = 0;
  XTime_GetTime(&now);
  const XTime end = now + counts;
  while (now < end) {
    const std::uint64_t cycles = (end - now) * global_timer::cpu_cycles_per_tick;
    hal_poll_until_changed(at(global_timer::COUNTER_LOW), 0,
                           static_cast<std::uint32_t>(std::min(cycles, longest_step)), 1);
    XTime_GetTime(&now);
  }
}

}  // namespace

extern "C" {

void XTime_GetTime(XTime* Xtime_Global) {
  std::uint32_t high = hal_read32(at(global_timer::COUNTER_HIGH));
  for (;;) {
    const std::uint32_t low = hal_read32(at(global_timer::COUNTER_LOW));
    const std::uint32_t again = hal_read32(at(global_timer::COUNTER_HIGH));
    if (again == high) {
      *Xtime_Global = static_cast<XTime>(high) << 32 | low;
      return;
    }
    high = again;
  }
}

void XTime_SetTime(XTime Xtime_Global) {
  const std::uint32_t control = hal_read32(at(global_timer::CONTROL));
  hal_write32(at(global_timer::CONTROL), control & ~global_timer::control::Timer_Enable);
  hal_write32(at(global_timer::COUNTER_LOW), static_cast<std::uint32_t>(Xtime_Global));
  hal_write32(at(global_timer::COUNTER_HIGH), static_cast<std::uint32_t>(Xtime_Global >> 32));
  hal_write32(at(global_timer::CONTROL), control | global_timer::control::Timer_Enable);
}

int usleep(unsigned int useconds) {
  wait_counts(static_cast<u64>(useconds) * COUNTS_PER_SECOND / 1'000'000);
  return 0;
}

unsigned int sleep(unsigned int seconds) {
  wait_counts(static_cast<u64>(seconds) * COUNTS_PER_SECOND);
  return 0;
}

}  // extern "C"
