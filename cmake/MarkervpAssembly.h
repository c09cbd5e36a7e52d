/* Room behind each call of the tracer, in which the platform puts instructions that charge the
 * block, see CodeCharge: the distance of what they jump to where the charge is used up, in a no-op.
 * That returns into the block, as if it had been called there. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
__asm__(
    ".macro call target:vararg\n"
    "  callq \\target\n"
    ".ifc \\target, __sanitizer_cov_trace_pc@PLT\n"
    "  .byte 0x0F, 0x1F, 0x80\n"
    "  .long .Lmarkervp_spent\\@ - .Lmarkervp_block\\@\n"
    "  .byte 0x0F, 0x1F, 0x44, 0, 0\n"
    ".Lmarkervp_block\\@:\n"
    "  .subsection 1\n"
    ".Lmarkervp_spent\\@:\n"
    "  callq .Lmarkervp_here\\@\n"
    ".Lmarkervp_here\\@:\n"
    "  addq $.Lmarkervp_block\\@ - .Lmarkervp_here\\@, (%rsp)\n"
    "  jmp markervp_spent\n"
    "  .subsection 0\n"
    ".endif\n"
    ".endm\n");
#endif

/* Instructions of the Cortex-A9 that programs write as assembly, `__asm__("sev")`: macros of the
 * host's assembler that call what the HAL has for them. markervp_add_program has each source of a
 * program include it. */
#if defined(__x86_64__)
__asm__(
    ".macro markervp_instruction name\n"
    "  leaq -128(%rsp), %rsp\n" /* a leaf function's variables may lie there */
    "  call markervp_\\name\n"
    "  leaq 128(%rsp), %rsp\n"
    ".endm\n"
    ".macro sev\n markervp_instruction sev\n.endm\n"
    ".macro wfe\n markervp_instruction wfe\n.endm\n"
    ".macro wfi\n markervp_instruction wfi\n.endm\n"
    ".macro dsb option:vararg\n markervp_instruction barrier\n.endm\n"
    ".macro dmb option:vararg\n markervp_instruction barrier\n.endm\n"
    ".macro isb option:vararg\n.endm\n"
    ".macro cpsie flags\n.ifnc \\flags, f\n markervp_instruction cpsie\n.endif\n.endm\n"
    ".macro cpsid flags\n.ifnc \\flags, f\n markervp_instruction cpsid\n.endif\n.endm\n"
    ".irp name, mrc, mcr, mrs, msr\n"
    ".macro \\name operands:vararg\n"
    "  .error \"the processor's own registers (\\name) are not modelled: leave the access out in "
    "this build, or "
    "use Xil_DCache..., Xil_SetTlbAttributes() or Xil_ExceptionEnable()\"\n"
    ".endm\n"
    ".endr\n");
#endif
