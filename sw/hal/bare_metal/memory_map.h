#ifndef MARKERVP_CHIP_MEMORY_MAP_H
#define MARKERVP_CHIP_MEMORY_MAP_H

/*
 * The uses of the parts of DDR. Plain numbers: the linker script, the start-up code and C++ read
 * them. Borders of sections of 1 MiB, the unit of the translation table.
 *
 *   program       code, data, small stacks of the exceptions
 *   stack guard   1 MiB that faults when touched
 *   second stack  of what the second core runs
 *   stack guard   another one
 *   stack         of the program, growing down; both are as large as on the virtual platform
 *   DMA memory    what hal_dma_allocate() hands out; from the same address on as on the platform
 */

#define CHIP_MEGABYTE 0x00100000

/* The lowest megabyte belongs to the on-chip memory (UG585 4.1). */
#define CHIP_DDR_FIRST 0x00100000
/* 512 MiB, as on ZedBoard and PYNQ-Z2. The ZC702 has 1 GiB: 0x40000000. */
#ifndef CHIP_DDR_END
#define CHIP_DDR_END 0x20000000
#endif

#define CHIP_DMA_FIRST 0x10000000
#define CHIP_STACK_END CHIP_DMA_FIRST
#define CHIP_STACK_FIRST 0x0F800000
#define CHIP_STACK_GUARD 0x0F700000
#define CHIP_SECOND_STACK_END CHIP_STACK_GUARD
#define CHIP_SECOND_STACK_FIRST 0x0EF00000
#define CHIP_SECOND_STACK_GUARD 0x0EE00000
#define CHIP_PROGRAM_END CHIP_SECOND_STACK_GUARD

/* Stacks of the exceptions, in bytes. Handlers of interrupts run on the first. */
#define CHIP_IRQ_STACK 0x10000
#define CHIP_FAULT_STACK 0x2000

#endif
