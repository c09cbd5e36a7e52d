#!/bin/sh
# Questions to a waveform of Icarus Verilog: which transfers are in it, and which rule is broken?
markervp trace transactions stream.vcd
echo
markervp trace check stream.checks stream.vcd
[ $? -eq 1 ] # the check that fails
