/* The drivers of I2C, SPI and XADC against an EEPROM, a flash and a temperature; returns the step
 * that failed. */
#include <sleep.h>
#include <string.h>
#include <xadcps.h>
#include <xiicps.h>
#include <xil_exception.h>
#include <xil_printf.h>
#include <xscugic.h>
#include <xspips.h>

enum { EEPROM = 0x50, NOTHING = 0x51, FLASH = 1, COUNT = 300 };

static XIicPs Iic;
static XSpiPs Spi;
static XAdcPs Adc;
static XScuGic Gic;
static volatile u32 IicEvents, SpiEvent;
static u8 Sent[COUNT + 4], Received[COUNT + 4];

static void IicTold(void* Reference, u32 Event) {
  (void)Reference;
  IicEvents |= Event;
}
static void SpiTold(const void* Reference, u32 Event, u32 Bytes) {
  (void)Reference, (void)Bytes;
  SpiEvent = Event;
}

static int Connect(void) {
  XScuGic_Config* Config = XScuGic_LookupConfig(XPAR_SCUGIC_SINGLE_DEVICE_ID);
  if (XScuGic_CfgInitialize(&Gic, Config, Config->CpuBaseAddress) != XST_SUCCESS) return 1;
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_INT, (Xil_ExceptionHandler)XScuGic_InterruptHandler,
                               &Gic);
  XScuGic_Connect(&Gic, XPAR_XIICPS_0_INTR, (Xil_InterruptHandler)XIicPs_MasterInterruptHandler,
                  &Iic);
  XScuGic_Connect(&Gic, XPAR_XSPIPS_1_INTR, (Xil_InterruptHandler)XSpiPs_InterruptHandler, &Spi);
  XScuGic_Enable(&Gic, XPAR_XIICPS_0_INTR);
  XScuGic_Enable(&Gic, XPAR_XSPIPS_1_INTR);
  Xil_ExceptionEnable();
  return 0;
}

static int Wrong(int Offset, int Count) {
  for (int i = 0; i < Count; i++) {
    if (Received[Offset + i] != (u8)i) return 1; /* an EEPROM of 256 bytes begins again */
  }
  return 0;
}

static int Write(u8 At) { /* a page of 16 bytes, behind its address */
  Sent[0] = At;
  for (int i = 0; i < 16; i++) Sent[i + 1] = (u8)(At + i);
  return XIicPs_MasterSendPolled(&Iic, Sent, 17, EEPROM);
}

static int Polled(void) {
  XIicPs_Config* Config = XIicPs_LookupConfig(XPAR_XIICPS_0_DEVICE_ID);
  if (XIicPs_CfgInitialize(&Iic, Config, Config->BaseAddress) != XST_SUCCESS) return 10;
  if (XIicPs_SelfTest(&Iic) != XST_SUCCESS || XIicPs_SetSClk(&Iic, 400000) != XST_SUCCESS)
    return 11;
  if (XIicPs_GetSClk(&Iic) != XPAR_XIICPS_0_I2C_CLK_FREQ_HZ / 22 / 13) return 12; /* of 384.6 kHz */
  if (XIicPs_MasterSendPolled(&Iic, Sent, 1, NOTHING) != XST_FAILURE || XIicPs_BusIsBusy(&Iic))
    return 13;
  for (int At = 0; At < 256; At += 16) {
    if (Write((u8)At) != XST_SUCCESS) return 14;
  }
  Sent[0] = 0;
  XIicPs_SetOptions(&Iic, XIICPS_REP_START_OPTION);
  if (XIicPs_MasterSendPolled(&Iic, Sent, 1, EEPROM) != XST_SUCCESS || !XIicPs_BusIsBusy(&Iic))
    return 15;
  XIicPs_ClearOptions(&Iic, XIICPS_REP_START_OPTION);
  if (XIicPs_MasterRecvPolled(&Iic, Received, COUNT, EEPROM) != XST_SUCCESS) return 16;
  return Wrong(0, COUNT) ? 17 : 0;
}

static int Wait(u32 Event) {
  while (IicEvents == 0) usleep(10);
  const int As = IicEvents == Event;
  IicEvents = 0;
  return As;
}

static int ByInterrupt(void) {
  XIicPs_SetStatusHandler(&Iic, &Iic, IicTold);
  XIicPs_MasterSend(&Iic, Sent, 1, NOTHING);
  if (!Wait(XIICPS_EVENT_NACK | XIICPS_EVENT_ERROR)) return 20;
  for (int i = 0; i < 41; i++) Sent[i] = (u8)(i == 0 ? 0xF0 : 0xF0 + (i - 1) % 16);
  XIicPs_MasterSend(&Iic, Sent, 41, EEPROM); /* more than the FIFO holds; the page begins again */
  if (!Wait(XIICPS_EVENT_COMPLETE_SEND)) return 21;
  Sent[0] = 0;
  XIicPs_MasterSend(&Iic, Sent, 1, EEPROM);
  if (!Wait(XIICPS_EVENT_COMPLETE_SEND)) return 22;
  memset(Received, 0xEE, sizeof Received);
  XIicPs_MasterRecv(&Iic, Received, COUNT, EEPROM);
  if (!Wait(XIICPS_EVENT_COMPLETE_RECV)) return 23;
  return Wrong(0, COUNT) ? 24 : 0;
}

static int Flash(void) {
  XSpiPs_Config* Config = XSpiPs_LookupConfig(XPAR_XSPIPS_1_DEVICE_ID);
  if (XSpiPs_CfgInitialize(&Spi, Config, Config->BaseAddress) != XST_SUCCESS) return 30;
  if (XSpiPs_SelfTest(&Spi) != XST_SUCCESS) return 31;
  XSpiPs_SetOptions(&Spi, XSPIPS_MASTER_OPTION | XSPIPS_FORCE_SSELECT_OPTION);
  XSpiPs_SetClkPrescaler(&Spi, XSPIPS_CLK_PRESCALE_8);
  XSpiPs_SetSlaveSelect(&Spi, FLASH);
  if (XSpiPs_GetSlaveSelect(&Spi) != FLASH || XSpiPs_GetClkPrescaler(&Spi) != XSPIPS_CLK_PRESCALE_8)
    return 32;
  u8 Identity[4] = {0x9F, 0, 0, 0};
  if (XSpiPs_PolledTransfer(&Spi, Identity, Identity, 4) != XST_SUCCESS) return 33;
  if (Identity[1] != 0xEF || Identity[2] != 0x40 || Identity[3] != 0x16) return 34;
  u8 Enable = 0x06;
  if (XSpiPs_PolledTransfer(&Spi, &Enable, NULL, 1) != XST_SUCCESS) return 35;
  memset(Sent, 0, sizeof Sent);
  Sent[0] = 0x02; /* a page at address 0, longer than the FIFO */
  for (int i = 0; i < 256; i++) Sent[4 + i] = (u8)i;
  if (XSpiPs_PolledTransfer(&Spi, Sent, NULL, 4 + 256) != XST_SUCCESS) return 35;
  u8 Status[2];
  do {
    Status[0] = 0x05;
    XSpiPs_PolledTransfer(&Spi, Status, Status, 2);
  } while ((Status[1] & 1) != 0);
  memset(Sent, 0, sizeof Sent);
  Sent[0] = 0x03; /* read, address 0 */
  if (XSpiPs_PolledTransfer(&Spi, Sent, Received, COUNT + 4) != XST_SUCCESS || Wrong(4, 256))
    return 36;
  memset(Received, 0, sizeof Received);
  XSpiPs_SetStatusHandler(&Spi, &Spi, SpiTold);
  if (XSpiPs_Transfer(&Spi, Sent, Received, COUNT + 4) != XST_SUCCESS) return 37;
  if (XSpiPs_Transfer(&Spi, Sent, Received, 1) != XST_DEVICE_BUSY) return 38;
  while (SpiEvent == 0) usleep(10);
  return SpiEvent != XST_SPI_TRANSFER_DONE || Wrong(4, 256) ? 39 : 0;
}

static int Converter(void) {
  XAdcPs_Config* Config = XAdcPs_LookupConfig(XPAR_XADCPS_0_DEVICE_ID);
  if (XAdcPs_CfgInitialize(&Adc, Config, Config->BaseAddress) != XST_SUCCESS) return 40;
  if (XAdcPs_SelfTest(&Adc) != XST_SUCCESS) return 41;
  XAdcPs_SetSequencerMode(&Adc, XADCPS_SEQ_MODE_SAFE);
  XAdcPs_SetAvg(&Adc, XADCPS_AVG_16_SAMPLES);
  if (XAdcPs_SetSeqChEnables(&Adc, XADCPS_SEQ_CH_TEMP | XADCPS_SEQ_CH_AUX00) != XST_SUCCESS)
    return 42;
  if (XAdcPs_GetSeqChEnables(&Adc) != (XADCPS_SEQ_CH_TEMP | XADCPS_SEQ_CH_AUX00)) return 43;
  XAdcPs_SetSequencerMode(&Adc, XADCPS_SEQ_MODE_CONTINPASS);
  if (XAdcPs_SetSeqChEnables(&Adc, 0) != XST_FAILURE) return 44;
  if (XAdcPs_GetAvg(&Adc) != XADCPS_AVG_16_SAMPLES) return 45;
  usleep(100);
  const float Celsius = XAdcPs_RawToTemperature(XAdcPs_GetAdcData(&Adc, XADCPS_CH_TEMP));
  return Celsius < 50.5f || Celsius > 51.5f ? 46 : 0;
}

int main(void) {
  int (*const Steps[])(void) = {Connect, Polled, ByInterrupt, Flash, Converter};
  for (unsigned n = 0; n < sizeof Steps / sizeof Steps[0]; n++) {
    const int Failed = Steps[n]();
    if (Failed != 0) {
      xil_printf("step %d\r\n", Failed);
      return Failed;
    }
  }
  xil_printf("all there\r\n");
  return XST_SUCCESS;
}
