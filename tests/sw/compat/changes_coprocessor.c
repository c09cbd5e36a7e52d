/* What the compiler refuses: a register of the coprocessor that changes how the processor works. */
#include <xpseudo_asm.h>

u32 caches(void) {
  return mfcp(XREG_CP15_SYS_CONTROL);
}
