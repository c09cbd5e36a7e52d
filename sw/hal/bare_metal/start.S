// Exception vectors and what happens before the first line of C++ (Cortex-A9: ARM architecture v7-A).
  .syntax unified
  .arm

  .equ mode_fiq, 0x11
  .equ mode_irq, 0x12
  .equ mode_svc, 0x13
  .equ mode_abort, 0x17
  .equ mode_undefined, 0x1B
  .equ mode_system, 0x1F

  // Kinds of faults, the order of Fault in faults.cpp.
  .equ fault_undefined, 0
  .equ fault_prefetch, 1
  .equ fault_data, 2
  .equ fault_fiq, 3

  .section .chip_vectors, "ax"
  .balign 32
chip_vectors:
  b chip_start
  b undefined_instruction
  b supervisor_call
  b prefetch_abort
  b data_abort
  b .                     // reserved
  b interrupt
  b fast_interrupt

  // Whatever ran before: caches, translation and branch prediction off, low vectors, ARM exceptions.
  .macro quiet_core
  mrc p15, 0, r0, c1, c0, 0   // SCTLR
  bic r0, r0, #0x0005         // C, M
  bic r0, r0, #0x3800         // V, I, Z
  bic r0, r0, #0x40000000     // TE
  mcr p15, 0, r0, c1, c0, 0
  isb
  mov r0, #0
  mcr p15, 0, r0, c8, c7, 0   // TLBIALL
  mcr p15, 0, r0, c7, c5, 0   // ICIALLU
  mcr p15, 0, r0, c7, c5, 6   // BPIALL
  bl invalidate_l1_data
  dsb
  isb
  ldr r0, =chip_vectors
  mcr p15, 0, r0, c12, c0, 0  // VBAR
  .endm

  .macro set_stacks irq, fault, program
  ldr r0, =\irq
  ldr r1, =\fault
  cps #mode_irq
  mov sp, r0
  cps #mode_fiq
  mov sp, r1
  cps #mode_undefined
  mov sp, r1
  cps #mode_abort
  mov sp, r1
  cps #mode_svc
  mov sp, r1
  cps #mode_system
  ldr sp, =\program
  .endm

  // VFP and NEON: access, on, round to nearest, no flush to zero, no default NaN.
  .macro enable_vfp
  mrc p15, 0, r0, c1, c0, 2   // CPACR
  orr r0, r0, #(0xF << 20)
  mcr p15, 0, r0, c1, c0, 2
  isb
  mov r0, #0x40000000
  vmsr fpexc, r0
  mov r0, #0
  vmsr fpscr, r0
  .endm

  .text
  .global chip_start
  .type chip_start, %function
chip_start:
  cpsid aif
  mrc p15, 0, r0, c0, c0, 5   // MPIDR
  ands r0, r0, #3
  bne park
  quiet_core
  set_stacks chip_irq_stack_end, chip_fault_stack_end, chip_stack_end
  enable_vfp

  ldr r0, =chip_bss_begin
  ldr r1, =chip_bss_end
  mov r2, #0
  mov r3, #0
  b 2f
1:
  stmia r0!, {r2, r3}
2:
  cmp r0, r1
  blo 1b

  bl chip_enable_memory
  cpsie a
  bl chip_main
  b .

// The second core, where a loader started both: waits as the boot ROM lets it (UG585 6.1.10), for
// the entry that hal_cpu_start() writes.
park:
  ldr r1, =0xFFFFFFF0
  ldr r2, =chip_second_start
1:
  wfe
  ldr r0, [r1]
  cmp r0, r2
  bne 1b

  .global chip_second_start
  .type chip_second_start, %function
chip_second_start:
  cpsid aif
  quiet_core
  set_stacks chip_second_irq_stack_end, chip_second_fault_stack_end, chip_second_stack_end
  enable_vfp
  bl chip_join_memory
  cpsie a
  bl chip_second_main
2:
  wfe
  b 2b

// 32 KiB in 4 ways of 256 lines of 32 bytes. Nothing is written back: the loader did that.
invalidate_l1_data:
  mov r0, #0
1:
  mov r1, #0
2:
  orr r2, r0, r1
  mcr p15, 0, r2, c7, c6, 2   // DCISW
  add r1, r1, #(1 << 5)
  cmp r1, #(256 << 5)
  blo 2b
  adds r0, r0, #(1 << 30)
  bcc 1b
  bx lr

// An interrupt's handler is C++: what such a function may change is kept, VFP and NEON included.
interrupt:
  sub lr, lr, #4
  push {r0-r3, ip, lr}
  vmrs r0, fpscr
  vpush {d0-d7}
  vpush {d16-d31}
  push {r0, r1}
  bl chip_interrupt
  pop {r0, r1}
  vpop {d16-d31}
  vpop {d0-d7}
  vmsr fpscr, r0
  clrex
  ldm sp!, {r0-r3, ip, pc}^

// Only a debugger's semihosting is called so; without one the call does nothing.
supervisor_call:
  movs pc, lr

// The others never return: chip_fault(kind, pc, status, return address of what was interrupted).
undefined_instruction:
  mov r0, #fault_undefined
  sub r1, lr, #4
  b fault
prefetch_abort:
  mov r0, #fault_prefetch
  sub r1, lr, #4
  b fault
data_abort:
  mov r0, #fault_data
  sub r1, lr, #8
  b fault
fast_interrupt:
  mov r0, #fault_fiq
  sub r1, lr, #4
fault:
  mrs r2, spsr
  mrs r4, cpsr
  cps #mode_system
  mov r3, lr
  msr cpsr_c, r4
  b chip_fault
