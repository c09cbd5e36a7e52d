// Corner Detection with the same outputs, clock for clock, from one FAST unit: a 7x7 window, and two
// line buffers of results where the thesis computes each of them nine times.
/* verilator lint_off WIDTH */
module corner_detection #(parameter T=30)(input logic clk, ena, rst, input logic [7:0] pixel, input logic [9:0] x, input logic [8:0] y,
    output logic corner_out, output logic [31:0] corner_data);
  // 7x7 window, 6 line buffers, one FAST unit, 2 result line buffers
  logic [7:0] w [0:6][0:6]; logic [7:0] lb [0:5][0:639]; logic [14:0] rl [0:1][0:639];
  always @(posedge clk) if (ena) begin
    for (int a=0;a<7;a++) for (int b=0;b<6;b++) w[a][b] <= w[a][b+1];
    w[6][6] <= pixel; w[5][6] <= lb[5][x]; w[4][6] <= lb[4][x]; w[3][6] <= lb[3][x]; w[2][6] <= lb[2][x]; w[1][6] <= lb[1][x]; w[0][6] <= lb[0][x];
    lb[0][x] <= lb[1][x]; lb[1][x] <= lb[2][x]; lb[2][x] <= lb[3][x]; lb[3][x] <= lb[4][x]; lb[4][x] <= lb[5][x]; lb[5][x] <= pixel;
  end
  logic [9:0] wx,x1,x2,x3; logic [8:0] wy,y1,y2,y3; logic v0,v1,v2,v3,e0,e1,e2;
  wire wnin = (wx >= 10'd8) && (wy >= 9'd8);
  always_ff @(posedge clk) if (rst) begin v0<=0; v1<=0; v2<=0; v3<=0; e0<=0; e1<=0; e2<=0; end else begin
    v0 <= ena; wx <= x; wy <= y; e0<=ena; e1<=e0; e2<=e1;
    v1 <= v0 & wnin; x1 <= wx - 10'd4; y1 <= wy - 9'd4;
    v2 <= v1; x2 <= x1; y2 <= y1;  v3 <= v2; x3 <= x2; y3 <= y2;
  end
  logic ctn; logic [11:0] stn; logic [1:0] drn; logic [7:0] circ [0:15];
  assign circ[0]=w[0][3]; assign circ[1]=w[0][4]; assign circ[2]=w[1][5]; assign circ[3]=w[2][6]; assign circ[4]=w[3][6]; assign circ[5]=w[4][6]; assign circ[6]=w[5][5]; assign circ[7]=w[6][4];
  assign circ[8]=w[6][3]; assign circ[9]=w[6][2]; assign circ[10]=w[5][1]; assign circ[11]=w[4][0]; assign circ[12]=w[3][0]; assign circ[13]=w[2][0]; assign circ[14]=w[1][1]; assign circ[15]=w[0][2];
  fast_module #(.T(T)) fm(.clk(clk), .ena(1'b1), .poi(w[3][3]), .circle(circ), .contiguous(ctn), .strength(stn), .dir(drn));
  wire [11:0] sn = ctn ? stn : 12'd0;
  // result window: column 2 = newest (combinational from FAST output registers), columns 0,1 registered
  logic [11:0] q00,q01,q10,q11,q20,q21; logic [1:0] d11; logic [1:0] d1n;
  logic [9:0] rx; wire [14:0] u1 = rl[1][rx], u0 = rl[0][rx];
  wire [11:0] n0 = u0[11:0], n1 = u1[11:0];
  always @(posedge clk) if (rst) rx<=0; else if (e2) begin
    rx <= (rx==639)?0:rx+1; rl[0][rx] <= u1; rl[1][rx] <= {1'b0,drn,sn};
    q00<=q01; q01<=n0; q10<=q11; q11<=n1; q20<=q21; q21<=sn; d11<=u1[13:12];
  end
  logic [11:0] rs0,rs1,rs2; logic ri1; logic [1:0] dC;
  always_ff @(posedge clk) begin
    rs0 <= (q00>=q01 && q00>=n0) ? q00 : (q01>=n0) ? q01 : n0;
    ri1 <= (q11>q10) && (q11>=n1); rs1 <= q11;
    rs2 <= (q20>=q21 && q20>=sn) ? q20 : (q21>=sn) ? q21 : sn; dC <= d11;
  end
  always_ff @(posedge clk) if (rst) corner_out <= 0; else begin
    corner_out <= v3 && rs1!=0 && ri1 && rs1 > rs0 && rs1 >= rs2;
    corner_data <= {1'b1, rs1[11:2], dC, y3, x3};
  end
endmodule
