# Commands for gdb on a PS program:
#   gdb -x markervp.gdb --args markervp run --program my_program.so
# or, at a moment of a run that was made:
#   markervp debug out --at 15.2ms
# The program is native code: breakpoints, stepping and variables are as everywhere. These show the hardware, and where the
# program is. They take no simulated time and change nothing.

# Programs are loaded when the run begins.
set breakpoint pending on
set confirm off
# A frame's features are large.
set max-value-size unlimited

define registers
  if $argc == 1
    call (void)((void (*)(const char *))markervp_registers)("$arg0")
  else
    call (void)((void (*)(const char *))markervp_registers)("")
  end
end
document registers
registers DEVICE: all registers of a device as they stand, by the name that `markervp map` gives it.
end

define peek
  printf "0x%08x\n", ((unsigned int (*)(unsigned int))markervp_peek)($arg0)
end
document peek
peek ADDRESS: the word at a bus address, register or memory.
end

define simtime
  call (void)((void (*)(void))markervp_time)()
end
document simtime
simtime: the simulation time, and the annotated function that runs.
end

define program
  select-frame 0
  while !((int (*)(unsigned long))markervp_is_program)((unsigned long)$pc)
    up-silently
  end
  frame
end
document program
program: goes up from where `markervp debug` stopped to the line of the program.
end
