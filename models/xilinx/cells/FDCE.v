// Flip-flop with enable and asynchronous clear (UG953).
module FDCE #(
  parameter [0:0] INIT = 1'b0, parameter IS_C_INVERTED = 1'b0, parameter IS_D_INVERTED = 1'b0,
  parameter IS_CLR_INVERTED = 1'b0
)(output reg Q, input C, input CE, input D, input CLR);
  wire clock = C ^ IS_C_INVERTED;
  wire start = CLR ^ IS_CLR_INVERTED;
  initial Q = INIT;
  always @(posedge clock or posedge start)
    if (start) Q <= 1'b0;
    else if (CE) Q <= D ^ IS_D_INVERTED;
endmodule
