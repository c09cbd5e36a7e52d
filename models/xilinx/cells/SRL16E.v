// Shift register of 16 bits with a tap (UG953).
module SRL16E #(parameter [15:0] INIT = 0, parameter IS_CLK_INVERTED = 1'b0)(
  output Q, input A0, input A1, input A2, input A3, input CE, input CLK, input D
);
  wire clock = CLK ^ IS_CLK_INVERTED;
  reg [15:0] bits = INIT;
  always @(posedge clock) if (CE) bits <= {bits[14:0], D};
  assign Q = bits[{A3, A2, A1, A0}];
endmodule
