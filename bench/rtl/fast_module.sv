// One FAST unit: threshold, then {contiguity, strength, direction} (thesis 4.3.4.3). Two clocks.
/* verilator lint_off WIDTH */
module fast_module #(parameter T=30)(input logic clk, ena, input logic [7:0] poi, input logic [7:0] circle [0:15],
    output logic contiguous, output logic [11:0] strength, output logic [1:0] dir);
  logic [15:0] bright; wire [8:0] lim = poi + T;
  genvar n;
  generate for (n=0;n<16;n++) begin : g
    logic [7:0] d; logic b; wire gt = {1'b0,circle[n]} > lim;
    always_ff @(posedge clk) begin b <= gt; d <= gt ? 8'(circle[n]-lim) : 8'd0; end
    assign bright[n] = b;
  end endgenerate
  // 9-run by doubling on the wrapped vector
  wire [31:0] bb = {bright,bright}; wire [31:0] r2 = bb & (bb>>1); wire [31:0] r4 = r2 & (r2>>2); wire [31:0] r8 = r4 & (r4>>4); wire [31:0] r9 = r8 & (bb>>8);
  logic [2:0] nN,nE,nS,nW; logic [1:0] d; logic [2:0] m;
  function automatic logic [2:0] br5(input logic [4:0] b); br5 = 3'(b[0])+3'(b[1])+3'(b[2])+3'(b[3])+3'(b[4]); endfunction
  always_comb begin
    nN = br5({bright[14],bright[15],bright[2:0]}); nS = br5(bright[10:6]); nE = br5(bright[6:2]); nW = br5(bright[14:10]);
    d = 0; m = nN; if (nS > m) begin m = nS; d = 1; end if (nE > m) begin m = nE; d = 2; end if (nW > m) begin m = nW; d = 3; end
  end
  wire [11:0] sum = 12'(g[0].d)+12'(g[1].d)+12'(g[2].d)+12'(g[3].d)+12'(g[4].d)+12'(g[5].d)+12'(g[6].d)+12'(g[7].d)+12'(g[8].d)+12'(g[9].d)+12'(g[10].d)+12'(g[11].d)+12'(g[12].d)+12'(g[13].d)+12'(g[14].d)+12'(g[15].d);
  always_ff @(posedge clk) begin contiguous <= |r9[15:0]; strength <= sum; dir <= d; end
endmodule
