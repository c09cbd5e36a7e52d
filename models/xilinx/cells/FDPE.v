// Flip-flop with enable and asynchronous preset (UG953).
module FDPE #(
  parameter [0:0] INIT = 1'b1, parameter IS_C_INVERTED = 1'b0, parameter IS_D_INVERTED = 1'b0,
  parameter IS_PRE_INVERTED = 1'b0
)(output reg Q, input C, input CE, input D, input PRE);
  wire clock = C ^ IS_C_INVERTED;
  wire start = PRE ^ IS_PRE_INVERTED;
  initial Q = INIT;
  always @(posedge clock or posedge start)
    if (start) Q <= 1'b1;
    else if (CE) Q <= D ^ IS_D_INVERTED;
endmodule
