// The image that the build puts into the ELF (MARKERVP_CHIP_IMAGE), a file as it is.
  .section .rodata.chip_image, "a"
  .balign 32
  .global chip_image_begin
chip_image_begin:
#ifdef CHIP_IMAGE
  .incbin CHIP_IMAGE
#endif
  .global chip_image_end
chip_image_end:
