// Whether two words are the same: three bits of both to a LUT, and a carry through these. Synthesis
// gives `==` as many levels of LUT as the slowest path of a design leaves room for: with this the paths
// from labels do not depend on what else is slow.
module same_bits #(
    parameter int BITS = 9
) (
    input  logic [BITS-1:0] a,
    input  logic [BITS-1:0] b,
    output logic            same
);
  localparam int THREES = (BITS + 2) / 3;
  wire [3*THREES-1:0] differing = (3 * THREES)'(a) ^ (3 * THREES)'(b);
  wire [THREES-1:0] alike;
  for (genvar i = 0; i < THREES; i++) begin : g_three
    assign alike[i] = differing[3*i+:3] == 3'd0;
  end
  // verilator lint_off UNUSEDSIGNAL
  wire [THREES:0] sum = {1'b0, alike} + 1'b1;  // only its carry is wanted
  // verilator lint_on UNUSEDSIGNAL
  assign same = sum[THREES];
endmodule
