#ifndef XPSEUDO_ASM_GCC_H
#define XPSEUDO_ASM_GCC_H

/* The vendor has a file for each compiler, which some programs name. */

#include <xpseudo_asm.h>

#endif
