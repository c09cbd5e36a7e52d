// Two registers, each of which samples the other, on a clock of its own.
module two_clocks (
    input logic a_clk,
    input logic b_clk,
    output logic [7:0] a,
    output logic [7:0] b
);
  initial begin
    a = '0;
    b = '0;
  end
  always_ff @(posedge a_clk) a <= b + 8'd1;
  always_ff @(posedge b_clk) b <= a + 8'd1;
endmodule
