/* A program that writes to a card. */
#include "ff.h"

int main(void) {
  FATFS Card;
  return f_mount(&Card, "0:/", 1);
}
