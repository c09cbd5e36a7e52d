// The golden frames as files, for every back end of the HAL. CMake says in which folder they are.
  .section .rodata
#define GOLDEN(name, file)       \
  .global golden_##name##_begin; \
  .hidden golden_##name##_begin; \
  golden_##name##_begin:         \
  .incbin file;                  \
  .global golden_##name##_end;   \
  .hidden golden_##name##_end;   \
  golden_##name##_end:

  GOLDEN(demo, "demo.words")
  GOLDEN(roll30, "roll30.words")
  GOLDEN(squares15, "squares15.words")

#if defined(__linux__) && defined(__ELF__)
  .section .note.GNU-stack, "", %progbits
#endif
