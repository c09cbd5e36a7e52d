// Accesses by address for code that calls them without xil_io.h, as drivers of Vivado's template
// for an IP with interrupts do: C then takes them for functions of int. With the vendor's tools
// such a driver lies in a library, from which nothing takes it.
#include <xil_io.h>

// Addresses have 32 bits: an undeclared function gets nothing wider for sure.
extern "C" {
u32 markervp_undeclared_in32(u32 address) asm("Xil_In32");
void markervp_undeclared_out32(u32 address, u32 value) asm("Xil_Out32");

u32 markervp_undeclared_in32(u32 address) {
  return Xil_In32(address);
}

void markervp_undeclared_out32(u32 address, u32 value) {
  Xil_Out32(address, value);
}
}
