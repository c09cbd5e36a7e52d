// Corner Detection as the thesis builds it (4.3.4): eight line FIFOs, a 9x9 window, nine FAST units,
// non-maximum suppression in two clocks.
/* verilator lint_off WIDTH */
module line_buffer(input logic clk, ena, rst, input logic [7:0] din, output logic [7:0] dout);
  // FIFO, write depth 1024, opens once 631 entries are stored
  logic [7:0] mem [0:1023]; logic [9:0] wp, rp; logic [9:0] cnt;
  wire open = (cnt == 10'd631);
  assign dout = open ? mem[rp] : 8'd0;
  always_ff @(posedge clk) if (rst) begin wp<=0; rp<=0; cnt<=0; end
    else if (ena) begin mem[wp] <= din; wp <= wp + 1; if (open) rp <= rp + 1; else cnt <= cnt + 1; end
endmodule

module corner_detection #(parameter T=30)(input logic clk, ena, rst, input logic [7:0] pixel, input logic [9:0] x, input logic [8:0] y,
    output logic corner_out, output logic [31:0] corner_data);
  logic [7:0] w [0:8][0:8]; logic [7:0] lo [0:7];
  genvar i,r,k;
  generate for (i=0;i<8;i++) begin : g_lb
    line_buffer lb(.clk(clk), .ena(ena), .rst(rst), .din(w[i+1][0]), .dout(lo[i]));
  end endgenerate
  always_ff @(posedge clk) if (ena) begin
    for (int a=0;a<9;a++) for (int b=0;b<8;b++) w[a][b] <= w[a][b+1];
    for (int a=0;a<8;a++) w[a][8] <= lo[a];
    w[8][8] <= pixel;
  end
  // coordinates pipeline (window, fast1, fast2, nms1)
  logic [9:0] wx,x1,x2,x3; logic [8:0] wy,y1,y2,y3; logic v0,v1,v2,v3;
  wire wnin = (wx >= 10'd8) && (wy >= 9'd8);
  always_ff @(posedge clk) if (rst) begin v0<=0; v1<=0; v2<=0; v3<=0; end else begin
    v0 <= ena; wx <= x; wy <= y;
    v1 <= v0 & wnin; x1 <= wx - 10'd4; y1 <= wy - 9'd4;
    v2 <= v1; x2 <= x1; y2 <= y1;  v3 <= v2; x3 <= x2; y3 <= y2;
  end
  logic ct [0:8]; logic [11:0] st [0:8]; logic [1:0] dr [0:8];
  generate for (r=0;r<3;r++) for (k=0;k<3;k++) begin : g_fast
    logic [7:0] circ [0:15];
    assign circ[0]=w[r+0][k+3]; assign circ[1]=w[r+0][k+4]; assign circ[2]=w[r+1][k+5]; assign circ[3]=w[r+2][k+6];
    assign circ[4]=w[r+3][k+6]; assign circ[5]=w[r+4][k+6]; assign circ[6]=w[r+5][k+5]; assign circ[7]=w[r+6][k+4];
    assign circ[8]=w[r+6][k+3]; assign circ[9]=w[r+6][k+2]; assign circ[10]=w[r+5][k+1]; assign circ[11]=w[r+4][k+0];
    assign circ[12]=w[r+3][k+0]; assign circ[13]=w[r+2][k+0]; assign circ[14]=w[r+1][k+1]; assign circ[15]=w[r+0][k+2];
    fast_module #(.T(T)) fm(.clk(clk), .ena(1'b1), .poi(w[r+3][k+3]), .circle(circ), .contiguous(ct[r*3+k]), .strength(st[r*3+k]), .dir(dr[r*3+k]));
  end endgenerate
  // NMS: 2 clocks
  logic [11:0] rs [0:2]; logic [1:0] ri [0:2]; logic [1:0] dC;
  always_ff @(posedge clk) begin
    for (int a=0;a<3;a++) begin
      logic [11:0] s0,s1,s2; s0 = ct[a*3]?st[a*3]:0; s1 = ct[a*3+1]?st[a*3+1]:0; s2 = ct[a*3+2]?st[a*3+2]:0;
      if (s0>=s1 && s0>=s2) begin rs[a]<=s0; ri[a]<=0; end else if (s1>=s2) begin rs[a]<=s1; ri[a]<=1; end else begin rs[a]<=s2; ri[a]<=2; end
    end
    dC <= dr[4];
  end
  always_ff @(posedge clk) if (rst) corner_out <= 0; else begin
    corner_out <= v3 && rs[1]!=0 && ri[1]==1 && rs[1] > rs[0] && rs[1] >= rs[2];
    corner_data <= {1'b1, rs[1][11:2], dC, y3, x3};
  end
endmodule
