/* The page, as a file in the program's read-only data. */
  .section .rodata
  .global markervp_page_begin
  .hidden markervp_page_begin
  .global markervp_page_end
  .hidden markervp_page_end
markervp_page_begin:
  .incbin MARKERVP_PAGE_TEMPLATE
markervp_page_end:
  .byte 0
  .section .note.GNU-stack, "", %progbits
