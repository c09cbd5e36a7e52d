#ifndef XADCPS_H
#define XADCPS_H

/* The XADC through the processing system. */

#include <xadcps_hw.h>
#include <xil_assert.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XADCPS_CH_TEMP 0x0U
#define XADCPS_CH_VCCINT 0x1U
#define XADCPS_CH_VCCAUX 0x2U
#define XADCPS_CH_VPVN 0x3U
#define XADCPS_CH_VREFP 0x4U
#define XADCPS_CH_VREFN 0x5U
#define XADCPS_CH_VBRAM 0x6U
#define XADCPS_CH_SUPPLY_CALIB 0x07U
#define XADCPS_CH_ADC_CALIB 0x08U
#define XADCPS_CH_GAINERR_CALIB 0x09U
#define XADCPS_CH_VCCPINT 0x0DU
#define XADCPS_CH_VCCPAUX 0x0EU
#define XADCPS_CH_VCCPDRO 0x0FU
#define XADCPS_CH_AUX_MIN 16U
#define XADCPS_CH_AUX_MAX 31U

#define XADCPS_CALIB_SUPPLY_COEFF 0U
#define XADCPS_CALIB_ADC_COEFF 1U
#define XADCPS_CALIB_GAIN_ERROR_COEFF 2U

#define XADCPS_MAX_TEMP 0U
#define XADCPS_MAX_VCCINT 1U
#define XADCPS_MAX_VCCAUX 2U
#define XADCPS_MAX_VBRAM 3U
#define XADCPS_MIN_TEMP 4U
#define XADCPS_MIN_VCCINT 5U
#define XADCPS_MIN_VCCAUX 6U
#define XADCPS_MIN_VBRAM 7U
#define XADCPS_MAX_VCCPINT 8U
#define XADCPS_MAX_VCCPAUX 9U
#define XADCPS_MAX_VCCPDRO 0xAU
#define XADCPS_MIN_VCCPINT 0xCU
#define XADCPS_MIN_VCCPAUX 0xDU
#define XADCPS_MIN_VCCPDRO 0xEU

#define XADCPS_ATR_TEMP_UPPER 0U
#define XADCPS_ATR_VCCINT_UPPER 1U
#define XADCPS_ATR_VCCAUX_UPPER 2U
#define XADCPS_ATR_OT_UPPER 3U
#define XADCPS_ATR_TEMP_LOWER 4U
#define XADCPS_ATR_VCCINT_LOWER 5U
#define XADCPS_ATR_VCCAUX_LOWER 6U
#define XADCPS_ATR_OT_LOWER 7U
#define XADCPS_ATR_VBRAM_UPPER_ 8U
#define XADCPS_ATR_VCCPINT_UPPER 9U
#define XADCPS_ATR_VCCPAUX_UPPER 0xAU
#define XADCPS_ATR_VCCPDRO_UPPER 0xBU
#define XADCPS_ATR_VBRAM_LOWER 0xCU
#define XADCPS_ATR_VCCPINT_LOWER 0xDU
#define XADCPS_ATR_VCCPAUX_LOWER 0xEU
#define XADCPS_ATR_VCCPDRO_LOWER 0xFU

#define XADCPS_AVG_0_SAMPLES 0U
#define XADCPS_AVG_16_SAMPLES 1U
#define XADCPS_AVG_64_SAMPLES 2U
#define XADCPS_AVG_256_SAMPLES 3U

#define XADCPS_PD_MODE_NONE 0U
#define XADCPS_PD_MODE_ADCB 1U
#define XADCPS_PD_MODE_XADC 2U
#define XADCPS_SEQ_MODE_SAFE 0U
#define XADCPS_SEQ_MODE_ONEPASS 1U
#define XADCPS_SEQ_MODE_CONTINPASS 2U
#define XADCPS_SEQ_MODE_SINGCHAN 3U
#define XADCPS_SEQ_MODE_SIMUL_SAMPLING 4U
#define XADCPS_SEQ_MODE_INDEPENDENT 8U

typedef struct {
  u16 DeviceId;
  u32 BaseAddress;
} XAdcPs_Config;

typedef struct {
  XAdcPs_Config Config;
  u32 IsReady;
} XAdcPs;

/** Number 0 or the base address; else NULL. */
XAdcPs_Config* XAdcPs_LookupConfig(UINTPTR DeviceId);
int XAdcPs_CfgInitialize(XAdcPs* InstancePtr, XAdcPs_Config* ConfigPtr, u32 EffectiveAddr);
int XAdcPs_SelfTest(XAdcPs* InstancePtr);
void XAdcPs_Reset(XAdcPs* InstancePtr);
void XAdcPs_SetConfigRegister(XAdcPs* InstancePtr, u32 Data);
u32 XAdcPs_GetConfigRegister(XAdcPs* InstancePtr);
u32 XAdcPs_GetMiscStatus(XAdcPs* InstancePtr);
void XAdcPs_SetMiscCtrlRegister(XAdcPs* InstancePtr, u32 Data);
u32 XAdcPs_GetMiscCtrlRegister(XAdcPs* InstancePtr);

/** A register of the XADC itself, by way of the FIFOs. */
void XAdcPs_WriteInternalReg(XAdcPs* InstancePtr, u32 RegOffset, u32 Data);
u32 XAdcPs_ReadInternalReg(XAdcPs* InstancePtr, u32 RegOffset);

/** 16 bits, of which the upper 12 are the conversion. */
u16 XAdcPs_GetAdcData(XAdcPs* InstancePtr, u8 Channel);
u16 XAdcPs_GetCalibCoefficient(XAdcPs* InstancePtr, u8 CoeffType);
u16 XAdcPs_GetMinMaxMeasurement(XAdcPs* InstancePtr, u8 MeasurementType);

void XAdcPs_SetAvg(XAdcPs* InstancePtr, u8 Average);
u8 XAdcPs_GetAvg(XAdcPs* InstancePtr);
/** XST_FAILURE outside of XADCPS_SEQ_MODE_SINGCHAN. */
int XAdcPs_SetSingleChParams(XAdcPs* InstancePtr, u8 Channel, int IncreaseAcqCycles,
                             int IsEventMode, int IsDifferentialMode);
void XAdcPs_SetCalibEnables(XAdcPs* InstancePtr, u16 Calibration);
u16 XAdcPs_GetCalibEnables(XAdcPs* InstancePtr);
void XAdcPs_SetAdcClkDivisor(XAdcPs* InstancePtr, u8 Divisor);
u8 XAdcPs_GetAdcClkDivisor(XAdcPs* InstancePtr);

/** `MuxMode` 1: an outer multiplexer is at `Channel`. */
void XAdcPs_SetMuxMode(XAdcPs* InstancePtr, int MuxMode, u8 Channel);
/** `Mode`: XADCPS_PD_MODE_… */
void XAdcPs_SetPowerdownMode(XAdcPs* InstancePtr, u32 Mode);
/** As the vendor's: the rest of the register, shifted. */
u32 XAdcPs_GetPowerdownMode(XAdcPs* InstancePtr);
/** 1: a conversion begins with an event. */
void XAdcPs_SetSequencerEvent(XAdcPs* InstancePtr, int IsEventMode);
int XAdcPs_GetSamplingMode(XAdcPs* InstancePtr);
/** The threshold of an over-temperature is that of XADCPS_ATR_OT_UPPER. */
void XAdcPs_EnableUserOverTemp(XAdcPs* InstancePtr);
void XAdcPs_DisableUserOverTemp(XAdcPs* InstancePtr);

void XAdcPs_SetSequencerMode(XAdcPs* InstancePtr, u8 SequencerMode);
u8 XAdcPs_GetSequencerMode(XAdcPs* InstancePtr);
/** These four: XST_FAILURE while the sequencer runs. */
int XAdcPs_SetSeqChEnables(XAdcPs* InstancePtr, u32 ChEnableMask);
int XAdcPs_SetSeqAvgEnables(XAdcPs* InstancePtr, u32 AvgEnableChMask);
int XAdcPs_SetSeqInputMode(XAdcPs* InstancePtr, u32 InputModeChMask);
int XAdcPs_SetSeqAcqTime(XAdcPs* InstancePtr, u32 AcqCyclesChMask);
u32 XAdcPs_GetSeqChEnables(XAdcPs* InstancePtr);
u32 XAdcPs_GetSeqAvgEnables(XAdcPs* InstancePtr);
u32 XAdcPs_GetSeqInputMode(XAdcPs* InstancePtr);
u32 XAdcPs_GetSeqAcqTime(XAdcPs* InstancePtr);

/** Bits XADCPS_CFR1_ALM_…_MASK and XADCPS_CFR1_OT_MASK: 1 is an alarm that may come. */
void XAdcPs_SetAlarmEnables(XAdcPs* InstancePtr, u16 AlmEnableMask);
u16 XAdcPs_GetAlarmEnables(XAdcPs* InstancePtr);
void XAdcPs_SetAlarmThreshold(XAdcPs* InstancePtr, u8 AlarmThrReg, u16 Value);
u16 XAdcPs_GetAlarmThreshold(XAdcPs* InstancePtr, u8 AlarmThrReg);

void XAdcPs_IntrEnable(XAdcPs* InstancePtr, u32 Mask);
void XAdcPs_IntrDisable(XAdcPs* InstancePtr, u32 Mask);
u32 XAdcPs_IntrGetEnabled(XAdcPs* InstancePtr);
u32 XAdcPs_IntrGetStatus(XAdcPs* InstancePtr);
void XAdcPs_IntrClear(XAdcPs* InstancePtr, u32 Mask);

/** UG480's transfer functions of the temperature and the supplies. */
#define XAdcPs_RawToTemperature(AdcData) (((float)(AdcData) / 65536.0f) / 0.00198421639f - 273.15f)
#define XAdcPs_RawToVoltage(AdcData) ((float)(AdcData)*3.0f / 65536.0f)
#define XAdcPs_TemperatureToRaw(Temperature) \
  ((int)(((Temperature) + 273.15f) * 65536.0f * 0.00198421639f))
#define XAdcPs_VoltageToRaw(Voltage) ((int)((Voltage)*65536.0f / 3.0f))

#ifdef __cplusplus
}
#endif

#endif
