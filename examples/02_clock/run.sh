#!/bin/sh
# The same image at two pixel clocks, and what the change did.
set -e
markervp run demo --quiet --output out/50 > /dev/null
markervp run demo --quiet --output out/40 --set "ps.fclk_clk1.frequency=40 MHz" > /dev/null
markervp compare out/50 out/40 > changes.txt
grep -E "^(configuration|metric|ps\.fclk_clk1\.frequency|summary|verdict.*margin|timing.*blob)" changes.txt
