/* The program of markervp.Overlay: the processor rests, and Python makes its accesses. It ends when
 * a test raises an interrupt of the processor, which nothing here enables. */
#include <hal/hal.h>

static int run(void) {
  hal_wait_for_interrupt();
  return 0;
}

const hal_program hal_program_info = {HAL_ABI, "notebook", &run, 0, 0, 0, 0, 0, 0};
