// Shift register of 32 bits with a tap and an end (UG953).
module SRLC32E #(parameter [31:0] INIT = 0, parameter IS_CLK_INVERTED = 1'b0)(
  output Q, output Q31, input [4:0] A, input CE, input CLK, input D
);
  wire clock = CLK ^ IS_CLK_INVERTED;
  reg [31:0] bits = INIT;
  always @(posedge clock) if (CE) bits <= {bits[30:0], D};
  assign Q = bits[A];
  assign Q31 = bits[31];
endmodule
