/* An input that changes interrupts. */
#include "xgpio.h"
#include "xil_exception.h"
#include "xil_printf.h"
#include "xparameters.h"
#include "xscugic.h"

#define GPIO_CHANNEL1 1
#define INTC_GPIO_INTERRUPT_ID XPAR_FABRIC_GPIO_0_VEC_ID
#define INTR_DELAY 0x00FFFFFF

int GpioIntrExample(XScuGic* IntcInstancePtr, XGpio* InstancePtr, u16 DeviceId, u16 IntrId,
                    u16 IntrMask, u32* DataRead);
int GpioSetupIntrSystem(XScuGic* IntcInstancePtr, XGpio* InstancePtr, u16 DeviceId, u16 IntrId,
                        u16 IntrMask);
void GpioDisableIntr(XScuGic* IntcInstancePtr, XGpio* InstancePtr, u16 IntrId, u16 IntrMask);
void GpioHandler(void* CallBackRef);

XGpio Gpio;
XScuGic Intc;
static u16 GlobalIntrMask;
static volatile u32 IntrFlag;

int main(void) {
  int Status;
  u32 DataRead;

  print(" Press button to Generate Interrupt\r\n");
  Status = GpioIntrExample(&Intc, &Gpio, XPAR_GPIO_0_DEVICE_ID, INTC_GPIO_INTERRUPT_ID,
                           XGPIO_IR_CH2_MASK, &DataRead);
  if (Status == XST_SUCCESS) {
    if (DataRead == 0)
      print("No button pressed. \r\n");
    else
      print("Successfully ran Gpio Interrupt Tapp Example\r\n");
  } else {
    print("Gpio Interrupt Tapp Example Failed.\r\n");
    return XST_FAILURE;
  }
  return DataRead == 0 ? XST_FAILURE : XST_SUCCESS;
}

int GpioIntrExample(XScuGic* IntcInstancePtr, XGpio* InstancePtr, u16 DeviceId, u16 IntrId,
                    u16 IntrMask, u32* DataRead) {
  int Status;
  u32 delay;

  Status = XGpio_Initialize(InstancePtr, DeviceId);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  Status = GpioSetupIntrSystem(IntcInstancePtr, InstancePtr, DeviceId, IntrId, IntrMask);
  if (Status != XST_SUCCESS) return XST_FAILURE;

  /* Here a person would press a button. */
  XGpio_SetDataDirection(InstancePtr, GPIO_CHANNEL1, 0);
  XGpio_DiscreteWrite(InstancePtr, GPIO_CHANNEL1, 0x10);

  IntrFlag = 0;
  delay = 0;
  while (!IntrFlag && (delay < INTR_DELAY)) {
    delay++;
  }
  GpioDisableIntr(IntcInstancePtr, InstancePtr, IntrId, IntrMask);
  *DataRead = IntrFlag;
  return Status;
}

int GpioSetupIntrSystem(XScuGic* IntcInstancePtr, XGpio* InstancePtr, u16 DeviceId, u16 IntrId,
                        u16 IntrMask) {
  XScuGic_Config* IntcConfig;
  int Result;
  (void)DeviceId;

  GlobalIntrMask = IntrMask;
  IntcConfig = XScuGic_LookupConfig(XPAR_SCUGIC_SINGLE_DEVICE_ID);
  if (NULL == IntcConfig) return XST_FAILURE;
  Result = XScuGic_CfgInitialize(IntcInstancePtr, IntcConfig, IntcConfig->CpuBaseAddress);
  if (Result != XST_SUCCESS) return XST_FAILURE;
  XScuGic_SetPriorityTriggerType(IntcInstancePtr, IntrId, 0xA0, 0x3);
  Result = XScuGic_Connect(IntcInstancePtr, IntrId, (Xil_ExceptionHandler)GpioHandler, InstancePtr);
  if (Result != XST_SUCCESS) return Result;
  XScuGic_Enable(IntcInstancePtr, IntrId);

  XGpio_InterruptEnable(InstancePtr, IntrMask);
  XGpio_InterruptGlobalEnable(InstancePtr);

  Xil_ExceptionInit();
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_INT, (Xil_ExceptionHandler)XScuGic_InterruptHandler,
                               IntcInstancePtr);
  Xil_ExceptionEnable();
  return XST_SUCCESS;
}

void GpioHandler(void* CallbackRef) {
  XGpio* GpioPtr = (XGpio*)CallbackRef;

  IntrFlag = 1;
  XGpio_InterruptClear(GpioPtr, GlobalIntrMask);
}

void GpioDisableIntr(XScuGic* IntcInstancePtr, XGpio* InstancePtr, u16 IntrId, u16 IntrMask) {
  XGpio_InterruptDisable(InstancePtr, IntrMask);
  XScuGic_Disable(IntcInstancePtr, IntrId);
}
