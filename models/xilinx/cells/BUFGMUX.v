// Clock multiplexer (UG953). It switches at once: the chip's waits for both clocks.
module BUFGMUX #(parameter CLK_SEL_TYPE = "SYNC")(output O, input I0, input I1, input S);
  assign O = S ? I1 : I0;
endmodule
