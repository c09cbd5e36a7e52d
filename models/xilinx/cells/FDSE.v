// Flip-flop with enable and synchronous set (UG953).
module FDSE #(
  parameter [0:0] INIT = 1'b1, parameter IS_C_INVERTED = 1'b0, parameter IS_D_INVERTED = 1'b0,
  parameter IS_S_INVERTED = 1'b0
)(output reg Q, input C, input CE, input D, input S);
  wire clock = C ^ IS_C_INVERTED;
  wire start = S ^ IS_S_INVERTED;
  initial Q = INIT;
  always @(posedge clock)
    if (start) Q <= 1'b1;
    else if (CE) Q <= D ^ IS_D_INVERTED;
endmodule
