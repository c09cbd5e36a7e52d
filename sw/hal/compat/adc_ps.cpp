// xadcps.h.
#include <hal/hal.h>
#include <ps_xadc_registers.h>
#include <xadcps.h>

namespace {

u32 read(const XAdcPs* adc, u32 offset) {
  return XAdcPs_ReadReg(adc->Config.BaseAddress, offset);
}

void write(const XAdcPs* adc, u32 offset, u32 word) {
  XAdcPs_WriteReg(adc->Config.BaseAddress, offset, word);
}

void command(const XAdcPs* adc, u32 word) {
  write(adc, XADCPS_CMDFIFO_OFFSET, word);
  read(adc, XADCPS_RDFIFO_OFFSET);  // the answer to the command before
}

void change(XAdcPs* adc, u32 offset, u32 clear, u32 set) {
  XAdcPs_WriteInternalReg(adc, offset, (XAdcPs_ReadInternalReg(adc, offset) & ~clear) | set);
}

/// The sequencer's masks lie in two registers: on-chip sensors, then the auxiliary inputs.
u32 masks(XAdcPs* adc, u32 offset) {
  return XAdcPs_ReadInternalReg(adc, offset) | XAdcPs_ReadInternalReg(adc, offset + 1)
                                                   << XADCPS_SEQ_CH_AUX_SHIFT;
}

int set_masks(XAdcPs* adc, u32 offset, u32 channels, u32 internal) {
  if (XAdcPs_GetSequencerMode(adc) != XADCPS_SEQ_MODE_SAFE) return XST_FAILURE;
  XAdcPs_WriteInternalReg(adc, offset, channels & internal);
  XAdcPs_WriteInternalReg(adc, offset + 1, channels >> XADCPS_SEQ_CH_AUX_SHIFT);
  return XST_SUCCESS;
}

constexpr u32 sensors = 0x7FE0, calibration = XADCPS_SEQ_CH_CALIB, dedicated = XADCPS_SEQ_CH_VPVN;

}  // namespace

extern "C" {

XAdcPs_Config* XAdcPs_LookupConfig(UINTPTR DeviceId) {
  static XAdcPs_Config config{0, ps_xadc::base};
  return DeviceId == 0 || DeviceId == ps_xadc::base ? &config : nullptr;
}

int XAdcPs_CfgInitialize(XAdcPs* InstancePtr, XAdcPs_Config* ConfigPtr, u32 EffectiveAddr) {
  Xil_AssertNonvoid(InstancePtr && ConfigPtr);
  InstancePtr->Config = *ConfigPtr;
  InstancePtr->Config.BaseAddress = EffectiveAddr;
  constexpr u32 unlock = 0x757BDF0D;
  write(InstancePtr, ps_xadc::UNLOCK, unlock);
  write(InstancePtr, XADCPS_CFG_OFFSET,
        read(InstancePtr, XADCPS_CFG_OFFSET) | XADCPS_CFG_ENABLE_MASK | XADCPS_CFG_CFIFOTH_MASK |
            XADCPS_CFG_DFIFOTH_MASK);
  write(InstancePtr, XADCPS_MCTL_OFFSET, 0);  // out of reset
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
  return XST_SUCCESS;
}

int XAdcPs_SelfTest(XAdcPs* InstancePtr) {
  constexpr u16 pattern = 0x55;
  XAdcPs_Reset(InstancePtr);
  XAdcPs_SetAlarmThreshold(InstancePtr, XADCPS_ATR_VCCINT_UPPER, pattern);
  const u16 kept = XAdcPs_GetAlarmThreshold(InstancePtr, XADCPS_ATR_VCCINT_UPPER);
  XAdcPs_Reset(InstancePtr);
  return kept == pattern ? XST_SUCCESS : XST_FAILURE;
}

void XAdcPs_Reset(XAdcPs* InstancePtr) {
  write(InstancePtr, XADCPS_MCTL_OFFSET, XADCPS_MCTL_RESET_MASK);
  write(InstancePtr, XADCPS_MCTL_OFFSET, 0);
}

void XAdcPs_SetConfigRegister(XAdcPs* InstancePtr, u32 Data) {
  write(InstancePtr, XADCPS_CFG_OFFSET, Data);
}

u32 XAdcPs_GetConfigRegister(XAdcPs* InstancePtr) {
  return read(InstancePtr, XADCPS_CFG_OFFSET);
}

u32 XAdcPs_GetMiscStatus(XAdcPs* InstancePtr) {
  return read(InstancePtr, XADCPS_MSTS_OFFSET);
}

void XAdcPs_SetMiscCtrlRegister(XAdcPs* InstancePtr, u32 Data) {
  write(InstancePtr, XADCPS_MCTL_OFFSET, Data);
}

u32 XAdcPs_GetMiscCtrlRegister(XAdcPs* InstancePtr) {
  return read(InstancePtr, XADCPS_MCTL_OFFSET);
}

void XAdcPs_WriteInternalReg(XAdcPs* InstancePtr, u32 RegOffset, u32 Data) {
  command(InstancePtr, XAdcPs_FormatWriteData(RegOffset, Data, TRUE));
}

// The answer comes with the next command.
u32 XAdcPs_ReadInternalReg(XAdcPs* InstancePtr, u32 RegOffset) {
  command(InstancePtr, XAdcPs_FormatWriteData(RegOffset, 0, FALSE));
  write(InstancePtr, XADCPS_CMDFIFO_OFFSET, 0);
  return read(InstancePtr, XADCPS_RDFIFO_OFFSET);
}

u16 XAdcPs_GetAdcData(XAdcPs* InstancePtr, u8 Channel) {
  Xil_AssertNonvoid(Channel <= XADCPS_CH_VBRAM ||
                    (Channel >= XADCPS_CH_VCCPINT && Channel <= XADCPS_CH_AUX_MAX));
  return static_cast<u16>(XAdcPs_ReadInternalReg(InstancePtr, XADCPS_TEMP_OFFSET + Channel));
}

u16 XAdcPs_GetCalibCoefficient(XAdcPs* InstancePtr, u8 CoeffType) {
  Xil_AssertNonvoid(CoeffType <= XADCPS_CALIB_GAIN_ERROR_COEFF);
  return static_cast<u16>(
      XAdcPs_ReadInternalReg(InstancePtr, XADCPS_ADC_A_SUPPLY_CALIB_OFFSET + CoeffType));
}

u16 XAdcPs_GetMinMaxMeasurement(XAdcPs* InstancePtr, u8 MeasurementType) {
  Xil_AssertNonvoid(MeasurementType <= XADCPS_MIN_VCCPDRO);
  return static_cast<u16>(
      XAdcPs_ReadInternalReg(InstancePtr, XADCPS_MAX_TEMP_OFFSET + MeasurementType));
}

void XAdcPs_SetMuxMode(XAdcPs* InstancePtr, int MuxMode, u8 Channel) {
  const u32 set = XADCPS_CFR0_MUX_MASK | (Channel & XADCPS_CFR0_CHANNEL_MASK);
  change(InstancePtr, XADCPS_CFR0_OFFSET, XADCPS_CFR0_MUX_MASK, MuxMode == 1 ? set : 0);
}

void XAdcPs_SetPowerdownMode(XAdcPs* InstancePtr, u32 Mode) {
  change(InstancePtr, XADCPS_CFR2_OFFSET, XADCPS_CFR2_PD_MASK, Mode << XADCPS_CFR2_PD_SHIFT);
}

u32 XAdcPs_GetPowerdownMode(XAdcPs* InstancePtr) {
  return (XAdcPs_ReadInternalReg(InstancePtr, XADCPS_CFR2_OFFSET) & ~XADCPS_CFR2_PD_MASK) >>
         XADCPS_CFR2_PD_SHIFT;
}

void XAdcPs_SetSequencerEvent(XAdcPs* InstancePtr, int IsEventMode) {
  change(InstancePtr, XADCPS_CFR0_OFFSET, XADCPS_CFR0_EC_MASK,
         IsEventMode == 1 ? XADCPS_CFR0_EC_MASK : 0);
}

int XAdcPs_GetSamplingMode(XAdcPs* InstancePtr) {
  return (XAdcPs_ReadInternalReg(InstancePtr, XADCPS_CFR0_OFFSET) & XADCPS_CFR0_EC_MASK) != 0;
}

void XAdcPs_EnableUserOverTemp(XAdcPs* InstancePtr) {
  change(InstancePtr, XADCPS_ATR_OT_UPPER_OFFSET, XADCPS_ATR_OT_UPPER_ENB_MASK,
         XADCPS_ATR_OT_UPPER_ENB_VAL);
}

void XAdcPs_DisableUserOverTemp(XAdcPs* InstancePtr) {
  change(InstancePtr, XADCPS_ATR_OT_UPPER_OFFSET, XADCPS_ATR_OT_UPPER_ENB_MASK, 0);
}

void XAdcPs_SetAvg(XAdcPs* InstancePtr, u8 Average) {
  Xil_AssertVoid(Average <= XADCPS_AVG_256_SAMPLES);
  change(InstancePtr, XADCPS_CFR0_OFFSET, XADCPS_CFR0_AVG_VALID_MASK,
         u32{Average} << XADCPS_CFR0_AVG_SHIFT);
}

u8 XAdcPs_GetAvg(XAdcPs* InstancePtr) {
  const u32 word = XAdcPs_ReadInternalReg(InstancePtr, XADCPS_CFR0_OFFSET);
  return static_cast<u8>((word & XADCPS_CFR0_AVG_VALID_MASK) >> XADCPS_CFR0_AVG_SHIFT);
}

int XAdcPs_SetSingleChParams(XAdcPs* InstancePtr, u8 Channel, int IncreaseAcqCycles,
                             int IsEventMode, int IsDifferentialMode) {
  if (XAdcPs_GetSequencerMode(InstancePtr) != XADCPS_SEQ_MODE_SINGCHAN) return XST_FAILURE;
  Xil_AssertNonvoid(Channel <= XADCPS_CH_VBRAM || Channel == XADCPS_CH_ADC_CALIB ||
                    (Channel >= XADCPS_CH_VCCPINT && Channel <= XADCPS_CH_AUX_MAX));
  const bool outer = Channel == XADCPS_CH_VPVN || Channel >= XADCPS_CH_AUX_MIN;
  if ((IncreaseAcqCycles || IsDifferentialMode) && !outer) return XST_FAILURE;
  u32 word = Channel & XADCPS_CFR0_CHANNEL_MASK;
  if (IncreaseAcqCycles) word |= XADCPS_CFR0_ACQ_MASK;
  if (IsEventMode) word |= XADCPS_CFR0_EC_MASK;
  if (IsDifferentialMode) word |= XADCPS_CFR0_DU_MASK;
  change(InstancePtr, XADCPS_CFR0_OFFSET, ~XADCPS_CFR0_AVG_VALID_MASK, word);
  return XST_SUCCESS;
}

void XAdcPs_SetCalibEnables(XAdcPs* InstancePtr, u16 Calibration) {
  change(InstancePtr, XADCPS_CFR1_OFFSET, XADCPS_CFR1_CAL_VALID_MASK,
         Calibration & XADCPS_CFR1_CAL_VALID_MASK);
}

u16 XAdcPs_GetCalibEnables(XAdcPs* InstancePtr) {
  return static_cast<u16>(XAdcPs_ReadInternalReg(InstancePtr, XADCPS_CFR1_OFFSET) &
                          XADCPS_CFR1_CAL_VALID_MASK);
}

void XAdcPs_SetAdcClkDivisor(XAdcPs* InstancePtr, u8 Divisor) {
  Xil_AssertVoid(Divisor >= XADCPS_CFR2_CD_MIN);
  change(InstancePtr, XADCPS_CFR2_OFFSET, XADCPS_CFR2_CD_VALID_MASK,
         u32{Divisor} << XADCPS_CFR2_CD_SHIFT);
}

u8 XAdcPs_GetAdcClkDivisor(XAdcPs* InstancePtr) {
  const u32 word = XAdcPs_ReadInternalReg(InstancePtr, XADCPS_CFR2_OFFSET);
  return static_cast<u8>(word >> XADCPS_CFR2_CD_SHIFT);
}

void XAdcPs_SetSequencerMode(XAdcPs* InstancePtr, u8 SequencerMode) {
  Xil_AssertVoid(SequencerMode <= XADCPS_SEQ_MODE_SIMUL_SAMPLING ||
                 SequencerMode == XADCPS_SEQ_MODE_INDEPENDENT);
  change(InstancePtr, XADCPS_CFR1_OFFSET, XADCPS_CFR1_SEQ_VALID_MASK,
         u32{SequencerMode} << XADCPS_CFR1_SEQ_SHIFT);
}

u8 XAdcPs_GetSequencerMode(XAdcPs* InstancePtr) {
  const u32 word = XAdcPs_ReadInternalReg(InstancePtr, XADCPS_CFR1_OFFSET);
  return static_cast<u8>((word & XADCPS_CFR1_SEQ_VALID_MASK) >> XADCPS_CFR1_SEQ_SHIFT);
}

int XAdcPs_SetSeqChEnables(XAdcPs* InstancePtr, u32 ChEnableMask) {
  return set_masks(InstancePtr, XADCPS_SEQ00_OFFSET, ChEnableMask, sensors | calibration);
}

int XAdcPs_SetSeqAvgEnables(XAdcPs* InstancePtr, u32 AvgEnableChMask) {
  return set_masks(InstancePtr, XADCPS_SEQ02_OFFSET, AvgEnableChMask, sensors);
}

int XAdcPs_SetSeqInputMode(XAdcPs* InstancePtr, u32 InputModeChMask) {
  return set_masks(InstancePtr, XADCPS_SEQ04_OFFSET, InputModeChMask, dedicated);
}

int XAdcPs_SetSeqAcqTime(XAdcPs* InstancePtr, u32 AcqCyclesChMask) {
  return set_masks(InstancePtr, XADCPS_SEQ06_OFFSET, AcqCyclesChMask, dedicated);
}

u32 XAdcPs_GetSeqChEnables(XAdcPs* InstancePtr) {
  return masks(InstancePtr, XADCPS_SEQ00_OFFSET);
}

u32 XAdcPs_GetSeqAvgEnables(XAdcPs* InstancePtr) {
  return masks(InstancePtr, XADCPS_SEQ02_OFFSET);
}

u32 XAdcPs_GetSeqInputMode(XAdcPs* InstancePtr) {
  return masks(InstancePtr, XADCPS_SEQ04_OFFSET);
}

u32 XAdcPs_GetSeqAcqTime(XAdcPs* InstancePtr) {
  return masks(InstancePtr, XADCPS_SEQ06_OFFSET);
}

// In the XADC a 1 switches an alarm off.
void XAdcPs_SetAlarmEnables(XAdcPs* InstancePtr, u16 AlmEnableMask) {
  change(InstancePtr, XADCPS_CFR1_OFFSET, XADCPS_CFR1_ALM_ALL_MASK,
         ~u32{AlmEnableMask} & XADCPS_CFR1_ALM_ALL_MASK);
}

u16 XAdcPs_GetAlarmEnables(XAdcPs* InstancePtr) {
  return static_cast<u16>(~XAdcPs_ReadInternalReg(InstancePtr, XADCPS_CFR1_OFFSET) &
                          XADCPS_CFR1_ALM_ALL_MASK);
}

void XAdcPs_SetAlarmThreshold(XAdcPs* InstancePtr, u8 AlarmThrReg, u16 Value) {
  Xil_AssertVoid(AlarmThrReg <= XADCPS_ATR_VCCPDRO_LOWER);
  XAdcPs_WriteInternalReg(InstancePtr, XADCPS_ATR_TEMP_UPPER_OFFSET + AlarmThrReg, Value);
}

u16 XAdcPs_GetAlarmThreshold(XAdcPs* InstancePtr, u8 AlarmThrReg) {
  Xil_AssertNonvoid(AlarmThrReg <= XADCPS_ATR_VCCPDRO_LOWER);
  return static_cast<u16>(
      XAdcPs_ReadInternalReg(InstancePtr, XADCPS_ATR_TEMP_UPPER_OFFSET + AlarmThrReg));
}

void XAdcPs_IntrEnable(XAdcPs* InstancePtr, u32 Mask) {
  write(InstancePtr, XADCPS_INT_MASK_OFFSET,
        read(InstancePtr, XADCPS_INT_MASK_OFFSET) & ~(Mask & XADCPS_INTX_ALL_MASK));
}

void XAdcPs_IntrDisable(XAdcPs* InstancePtr, u32 Mask) {
  write(InstancePtr, XADCPS_INT_MASK_OFFSET,
        read(InstancePtr, XADCPS_INT_MASK_OFFSET) | (Mask & XADCPS_INTX_ALL_MASK));
}

u32 XAdcPs_IntrGetEnabled(XAdcPs* InstancePtr) {
  return ~read(InstancePtr, XADCPS_INT_MASK_OFFSET) & XADCPS_INTX_ALL_MASK;
}

u32 XAdcPs_IntrGetStatus(XAdcPs* InstancePtr) {
  return read(InstancePtr, XADCPS_INT_STS_OFFSET) & XADCPS_INTX_ALL_MASK;
}

void XAdcPs_IntrClear(XAdcPs* InstancePtr, u32 Mask) {
  write(InstancePtr, XADCPS_INT_STS_OFFSET, Mask);
}

}  // extern "C"
