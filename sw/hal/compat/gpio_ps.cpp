// xgpiops.h.
#include <hal/hal.h>
#include <ps_gpio_registers.h>
#include <xgpiops.h>

namespace {

constexpr std::uint32_t half = 16;  // pins of a masked register

/// A pin by its bank.
struct Place {
  u8 bank;
  u32 bit;
};

Place place_of(u32 pin) {
  unsigned bank = ps_gpio::bank_count - 1;
  while (ps_gpio::bank_first_pin[bank] > pin) --bank;
  return {static_cast<u8>(bank), pin - ps_gpio::bank_first_pin[bank]};
}

std::uint32_t at(const XGpioPs* gpio, std::uint32_t offset, u8 bank,
                 std::uint32_t stride = ps_gpio::bank_stride) {
  return static_cast<std::uint32_t>(gpio->GpioConfig.BaseAddr) + offset + bank * stride;
}

void change_bit(std::uint32_t address, u32 bit, bool value) {
  const std::uint32_t word = hal_read32(address), mask = 1u << bit;
  hal_write32(address, value ? word | mask : word & ~mask);
}

u32 bit_of(std::uint32_t address, u32 bit) {
  return hal_read32(address) >> bit & 1;
}

/// How the three registers of a kind of interrupt are set.
struct Sense {
  bool edge, high, any;
};
constexpr Sense senses[] = {{true, true, false},
                            {true, false, false},
                            {true, false, true},
                            {false, true, false},
                            {false, false, false}};

}  // namespace

extern "C" {

XGpioPs_Config* XGpioPs_LookupConfig(UINTPTR DeviceId) {
  static XGpioPs_Config config{0, ps_gpio::base, 0x4014, 0xF8F01000};
  return DeviceId == 0 || DeviceId == ps_gpio::base ? &config : nullptr;
}

s32 XGpioPs_CfgInitialize(XGpioPs* InstancePtr, const XGpioPs_Config* ConfigPtr,
                          UINTPTR EffectiveAddr) {
  if (!InstancePtr || !ConfigPtr) return XST_INVALID_PARAM;
  *InstancePtr = {};
  InstancePtr->GpioConfig = *ConfigPtr;
  InstancePtr->GpioConfig.BaseAddr = EffectiveAddr;
  InstancePtr->MaxPinNum = XGPIOPS_DEVICE_MAX_PIN_NUM;
  InstancePtr->MaxBanks = XGPIOPS_MAX_BANKS;
  for (u8 bank = 0; bank < XGPIOPS_MAX_BANKS; ++bank) XGpioPs_IntrDisable(InstancePtr, bank, ~0u);
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
  return XST_SUCCESS;
}

s32 XGpioPs_SelfTest(const XGpioPs* InstancePtr) {
  u32 type = 0, polarity = 0, any = 0;
  constexpr u32 pattern = 0x22;
  XGpioPs_SetIntrType(InstancePtr, 0, pattern, pattern, pattern);
  XGpioPs_GetIntrType(InstancePtr, 0, &type, &polarity, &any);
  XGpioPs_SetIntrType(InstancePtr, 0, ps_gpio::bank_mask[0], 0, 0);
  return type == pattern && polarity == pattern && any == pattern ? XST_SUCCESS : XST_FAILURE;
}

u32 XGpioPs_Read(const XGpioPs* InstancePtr, u8 Bank) {
  return hal_read32(at(InstancePtr, ps_gpio::DATA_0_RO, Bank, ps_gpio::data_stride));
}

void XGpioPs_Write(const XGpioPs* InstancePtr, u8 Bank, u32 Data) {
  hal_write32(at(InstancePtr, ps_gpio::DATA_0, Bank, ps_gpio::data_stride), Data);
}

void XGpioPs_SetDirection(const XGpioPs* InstancePtr, u8 Bank, u32 Direction) {
  hal_write32(at(InstancePtr, ps_gpio::DIRM_0, Bank), Direction);
}

u32 XGpioPs_GetDirection(const XGpioPs* InstancePtr, u8 Bank) {
  return hal_read32(at(InstancePtr, ps_gpio::DIRM_0, Bank));
}

void XGpioPs_SetOutputEnable(const XGpioPs* InstancePtr, u8 Bank, u32 OpEnable) {
  hal_write32(at(InstancePtr, ps_gpio::OEN_0, Bank), OpEnable);
}

u32 XGpioPs_GetOutputEnable(const XGpioPs* InstancePtr, u8 Bank) {
  return hal_read32(at(InstancePtr, ps_gpio::OEN_0, Bank));
}

void XGpioPs_GetBankPin(u8 PinNumber, u8* BankNumber, u8* PinNumberInBank) {
  const Place place = place_of(PinNumber);
  *BankNumber = place.bank;
  *PinNumberInBank = static_cast<u8>(place.bit);
}

u32 XGpioPs_ReadPin(const XGpioPs* InstancePtr, u32 Pin) {
  const Place place = place_of(Pin);
  return XGpioPs_Read(InstancePtr, place.bank) >> place.bit & 1;
}

// The masked registers change one pin without a read.
void XGpioPs_WritePin(const XGpioPs* InstancePtr, u32 Pin, u32 Data) {
  const Place place = place_of(Pin);
  const std::uint32_t offset = ps_gpio::MASK_DATA_0_LSW + (place.bit < half ? 0 : 4);
  const u32 bit = place.bit % half;
  const u32 mask = ~(1u << (bit + half)) & 0xFFFF0000;
  hal_write32(at(InstancePtr, offset, place.bank, ps_gpio::mask_data_stride), mask | (Data & 1)
                                                                                         << bit);
}

void XGpioPs_SetDirectionPin(const XGpioPs* InstancePtr, u32 Pin, u32 Direction) {
  const Place place = place_of(Pin);
  change_bit(at(InstancePtr, ps_gpio::DIRM_0, place.bank), place.bit, Direction != 0);
}

u32 XGpioPs_GetDirectionPin(const XGpioPs* InstancePtr, u32 Pin) {
  const Place place = place_of(Pin);
  return bit_of(at(InstancePtr, ps_gpio::DIRM_0, place.bank), place.bit);
}

void XGpioPs_SetOutputEnablePin(const XGpioPs* InstancePtr, u32 Pin, u32 OpEnable) {
  const Place place = place_of(Pin);
  change_bit(at(InstancePtr, ps_gpio::OEN_0, place.bank), place.bit, OpEnable != 0);
}

u32 XGpioPs_GetOutputEnablePin(const XGpioPs* InstancePtr, u32 Pin) {
  const Place place = place_of(Pin);
  return bit_of(at(InstancePtr, ps_gpio::OEN_0, place.bank), place.bit);
}

void XGpioPs_IntrEnable(const XGpioPs* InstancePtr, u8 Bank, u32 Mask) {
  hal_write32(at(InstancePtr, ps_gpio::INT_EN_0, Bank), Mask);
}

void XGpioPs_IntrDisable(const XGpioPs* InstancePtr, u8 Bank, u32 Mask) {
  hal_write32(at(InstancePtr, ps_gpio::INT_DIS_0, Bank), Mask);
}

u32 XGpioPs_IntrGetEnabled(const XGpioPs* InstancePtr, u8 Bank) {
  return ~hal_read32(at(InstancePtr, ps_gpio::INT_MASK_0, Bank));
}

u32 XGpioPs_IntrGetStatus(const XGpioPs* InstancePtr, u8 Bank) {
  return hal_read32(at(InstancePtr, ps_gpio::INT_STAT_0, Bank));
}

void XGpioPs_IntrClear(const XGpioPs* InstancePtr, u8 Bank, u32 Mask) {
  hal_write32(at(InstancePtr, ps_gpio::INT_STAT_0, Bank), Mask);
}

void XGpioPs_SetIntrType(const XGpioPs* InstancePtr, u8 Bank, u32 IntrType, u32 IntrPolarity,
                         u32 IntrOnAny) {
  hal_write32(at(InstancePtr, ps_gpio::INT_TYPE_0, Bank), IntrType);
  hal_write32(at(InstancePtr, ps_gpio::INT_POLARITY_0, Bank), IntrPolarity);
  hal_write32(at(InstancePtr, ps_gpio::INT_ANY_0, Bank), IntrOnAny);
}

void XGpioPs_GetIntrType(const XGpioPs* InstancePtr, u8 Bank, u32* IntrType, u32* IntrPolarity,
                         u32* IntrOnAny) {
  *IntrType = hal_read32(at(InstancePtr, ps_gpio::INT_TYPE_0, Bank));
  *IntrPolarity = hal_read32(at(InstancePtr, ps_gpio::INT_POLARITY_0, Bank));
  *IntrOnAny = hal_read32(at(InstancePtr, ps_gpio::INT_ANY_0, Bank));
}

void XGpioPs_IntrEnablePin(const XGpioPs* InstancePtr, u32 Pin) {
  const Place place = place_of(Pin);
  XGpioPs_IntrEnable(InstancePtr, place.bank, 1u << place.bit);
}

void XGpioPs_IntrDisablePin(const XGpioPs* InstancePtr, u32 Pin) {
  const Place place = place_of(Pin);
  XGpioPs_IntrDisable(InstancePtr, place.bank, 1u << place.bit);
}

u32 XGpioPs_IntrGetEnabledPin(const XGpioPs* InstancePtr, u32 Pin) {
  const Place place = place_of(Pin);
  return XGpioPs_IntrGetEnabled(InstancePtr, place.bank) >> place.bit & 1;
}

u32 XGpioPs_IntrGetStatusPin(const XGpioPs* InstancePtr, u32 Pin) {
  const Place place = place_of(Pin);
  return XGpioPs_IntrGetStatus(InstancePtr, place.bank) >> place.bit & 1;
}

void XGpioPs_IntrClearPin(const XGpioPs* InstancePtr, u32 Pin) {
  const Place place = place_of(Pin);
  XGpioPs_IntrClear(InstancePtr, place.bank, 1u << place.bit);
}

void XGpioPs_SetIntrTypePin(const XGpioPs* InstancePtr, u32 Pin, u8 IrqType) {
  Xil_AssertVoid(IrqType <= XGPIOPS_IRQ_TYPE_LEVEL_LOW);
  const Place place = place_of(Pin);
  const Sense& sense = senses[IrqType];
  change_bit(at(InstancePtr, ps_gpio::INT_TYPE_0, place.bank), place.bit, sense.edge);
  change_bit(at(InstancePtr, ps_gpio::INT_POLARITY_0, place.bank), place.bit, sense.high);
  change_bit(at(InstancePtr, ps_gpio::INT_ANY_0, place.bank), place.bit, sense.any);
}

u8 XGpioPs_GetIntrTypePin(const XGpioPs* InstancePtr, u32 Pin) {
  const Place place = place_of(Pin);
  const bool high = bit_of(at(InstancePtr, ps_gpio::INT_POLARITY_0, place.bank), place.bit) != 0;
  if (bit_of(at(InstancePtr, ps_gpio::INT_TYPE_0, place.bank), place.bit) == 0)
    return high ? XGPIOPS_IRQ_TYPE_LEVEL_HIGH : XGPIOPS_IRQ_TYPE_LEVEL_LOW;
  if (bit_of(at(InstancePtr, ps_gpio::INT_ANY_0, place.bank), place.bit) != 0)
    return XGPIOPS_IRQ_TYPE_EDGE_BOTH;
  return high ? XGPIOPS_IRQ_TYPE_EDGE_RISING : XGPIOPS_IRQ_TYPE_EDGE_FALLING;
}

void XGpioPs_SetCallbackHandler(XGpioPs* InstancePtr, void* CallBackRef,
                                XGpioPs_Handler FuncPointer) {
  InstancePtr->Handler = FuncPointer;
  InstancePtr->CallBackRef = CallBackRef;
}

void XGpioPs_IntrHandler(const XGpioPs* InstancePtr) {
  for (u8 bank = 0; bank < XGPIOPS_MAX_BANKS; ++bank) {
    const u32 status = XGpioPs_IntrGetStatus(InstancePtr, bank);
    const u32 events = status & XGpioPs_IntrGetEnabled(InstancePtr, bank);
    if (events == 0) continue;
    XGpioPs_IntrClear(InstancePtr, bank, events);
    if (InstancePtr->Handler) InstancePtr->Handler(InstancePtr->CallBackRef, bank, events);
  }
}

void XGpioPs_ResetHw(UINTPTR BaseAddress) {
  constexpr u32 types[] = {XGPIOPS_INTTYPE_BANK0_RESET, XGPIOPS_INTTYPE_BANK1_RESET,
                           XGPIOPS_INTTYPE_BANK2_RESET, XGPIOPS_INTTYPE_BANK3_RESET};
  const auto base = static_cast<u32>(BaseAddress);
  for (u32 bank = 0; bank < ps_gpio::bank_count; ++bank) {
    const u32 registers = base + bank * XGPIOPS_REG_MASK_OFFSET;
    hal_write32(registers + XGPIOPS_INTDIS_OFFSET, ~0u);
    hal_write32(registers + XGPIOPS_INTSTS_OFFSET, ~0u);
    hal_write32(registers + XGPIOPS_DIRM_OFFSET, 0);
    hal_write32(registers + XGPIOPS_OUTEN_OFFSET, 0);
    hal_write32(base + XGPIOPS_DATA_OFFSET + bank * XGPIOPS_DATA_BANK_OFFSET, 0);
    hal_write32(registers + XGPIOPS_INTTYPE_OFFSET, types[bank]);
    hal_write32(registers + XGPIOPS_INTPOL_OFFSET, 0);
    hal_write32(registers + XGPIOPS_INTANY_OFFSET, 0);
  }
}

}  // extern "C"
