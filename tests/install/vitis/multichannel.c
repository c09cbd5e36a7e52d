/* A transfer of another stream: what the platform's engine has not. */
#include "xaxidma.h"

int main(void) {
  XAxiDma_Bd Bd = {0};
  XAxiDma_BdSetTDest(&Bd, 1);
  return 0;
}
