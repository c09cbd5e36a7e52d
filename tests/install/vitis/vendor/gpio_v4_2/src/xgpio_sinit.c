#include "xgpio.h"
#include "xparameters.h"

extern XGpio_Config XGpio_ConfigTable[];

XGpio_Config* XGpio_LookupConfig(u16 DeviceId) {
  int Index;

  for (Index = 0; Index < XPAR_XGPIO_NUM_INSTANCES; Index++) {
    if (XGpio_ConfigTable[Index].DeviceId == DeviceId) return &XGpio_ConfigTable[Index];
  }
  return NULL;
}

int XGpio_Initialize(XGpio* InstancePtr, u16 DeviceId) {
  XGpio_Config* ConfigPtr = XGpio_LookupConfig(DeviceId);

  if (ConfigPtr == NULL) return XST_DEVICE_NOT_FOUND;
  InstancePtr->BaseAddress = ConfigPtr->BaseAddress;
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
  InstancePtr->Writes = 0;
  return XST_SUCCESS;
}
