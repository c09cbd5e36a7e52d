/* No xil_io.h: C takes the functions for ones of int. */
void write_undeclared(unsigned address, unsigned value) {
  Xil_Out32(address, value);
}

unsigned read_undeclared(unsigned address) {
  return Xil_In32(address);
}
