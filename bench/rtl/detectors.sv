// Sensor Input, Global Threshold and Blob Detection (thesis 4.3.2, 4.3.5, 4.3.6), pixel clock.
/* verilator lint_off WIDTH */
module sensor_input(input logic clk, rst, ena, output logic frame_ena, output logic [7:0] pixel, output logic [9:0] pixel_x, output logic [8:0] pixel_y);
  logic [7:0] bram [0:307199] /*verilator public_flat_rw*/;
  logic [18:0] a; logic [9:0] cx; logic [8:0] cy; logic run, ena_d;
  always_ff @(posedge clk) if (rst) begin frame_ena<=0; run<=0; ena_d<=0; a<=0; cx<=0; cy<=0; end else begin
    ena_d <= ena; if (ena & !ena_d & !run) begin run<=1; a<=0; cx<=0; cy<=0; end
    frame_ena <= run;
    if (run) begin pixel <= bram[a]; pixel_x<=cx; pixel_y<=cy; a<=a+1;
      if (cx==639) begin cx<=0; cy<=cy+1; if (cy==479) run<=0; end else cx<=cx+1; end
  end
endmodule

module global_threshold(input logic clk, por, rst, frame_ena, wr_thresh, input logic [7:0] threshold_in, pixel, input logic [9:0] x, input logic [8:0] y,
    output logic [7:0] threshold, output logic binary_ena, binary_out, output logic [9:0] binary_x, output logic [8:0] binary_y, output logic thresh_out, output logic [31:0] thresh_data);
  logic [18:0] hist [0:255]; logic [18:0] p1c,p2c; logic [7:0] p1,p2; logic fe_d;
  logic [31:0] sh; wire b = pixel <= threshold; logic [18:0] hn; wire [31:0] shn = {b, sh[31:1]};
  // hist/hn are private to this process: blocking assignment is race free
  always @(posedge clk) if (por || rst) begin if (por) threshold <= 8'd127; binary_ena<=0; thresh_out<=0; p1c<=0; p2c<=0; p1<=0; p2<=8'd255; fe_d<=0; for (int i=0;i<256;i++) hist[i] = 0; end
  else begin
    fe_d <= frame_ena; binary_ena <= frame_ena; thresh_out <= 0;
    if (frame_ena) begin
      binary_out <= b; binary_x <= x; binary_y <= y; sh <= shn;
      if (x[4:0]==5'd31) begin thresh_out <= 1; thresh_data <= shn; end
      hn = hist[pixel] + 1; hist[pixel] = hn;
      if (!pixel[7]) begin if (hn > p1c) begin p1c <= hn; p1 <= pixel; end end
      else if (hn > p2c) begin p2c <= hn; p2 <= pixel; end
    end else if (fe_d) begin threshold <= ({1'b0,p1}+{1'b0,p2})>>1; p1c<=0; p2c<=0; p1<=0; p2<=8'd255; for (int i=0;i<256;i++) hist[i] = 0; end
    if (wr_thresh) threshold <= threshold_in;
  end
endmodule

module blob_detection #(parameter NL=128)(input logic clk, ena, rst, input logic pixel, input logic [9:0] x, input logic [8:0] y,
    output logic blob_out, output logic [31:0] blob_start, blob_end, output logic idle);
  localparam LB=$clog2(NL);
  typedef logic [LB-1:0] lab_t;
  logic act [0:NL-1]; logic [9:0] sx [0:NL-1]; logic [9:0] ex [0:NL-1]; logic [8:0] sy [0:NL-1]; logic [8:0] ey [0:NL-1];
  lab_t lbuf [0:639]; lab_t up [0:4]; lab_t lf [0:1];       // up[0]=x-2 .. up[4]=x+2 (row above), lf[0]=x-1, lf[1]=x-2
  lab_t fifo [0:NL-1]; lab_t fr, fw; logic [LB:0] fcnt; lab_t nxt; logic ena_d, flush; logic [10:0] num;
  logic ret_v; logic [9:0] rsx, rex; logic [8:0] rsy, rey;
  // candidates
  lab_t cand [0:6]; logic [10:0] wd [0:6];
  always_comb begin
    cand[0] = (x>=1) ? lf[0] : 0; cand[1] = (x>=2) ? lf[1] : 0;
    cand[2] = (y!=0 && x>=2) ? up[0] : 0; cand[3] = (y!=0 && x>=1) ? up[1] : 0; cand[4] = (y!=0) ? up[2] : 0;
    cand[5] = (y!=0 && x<639) ? up[3] : 0; cand[6] = (y!=0 && x<638) ? up[4] : 0;
    for (int i=0;i<7;i++) wd[i] = (cand[i]!=0) ? 11'(ex[cand[i]] - sx[cand[i]]) + 11'd1 : 11'd0;
  end
  lab_t bl; logic [10:0] bw; logic newb;
  always_comb begin bl=0; bw=0; for (int i=0;i<7;i++) if (wd[i] > bw) begin bw = wd[i]; bl = cand[i]; end
    newb = ena & pixel & (bl==0); end
  lab_t lab; assign lab = (ena & pixel) ? ((bl==0) ? nxt : bl) : 0;
  // deactivation (parallel compare on all labels, lowest index first)
  logic dv; lab_t di;
  always_comb begin dv=0; di=0;
    for (int i=NL-1;i>=1;i--) if (act[i] && (flush || (ena && (y > ey[i]+10'd1 || (y == ey[i]+10'd1 && {1'b0,x} > ex[i]+11'd2))))) begin dv=1; di=lab_t'(i); end
  end
  wire [9:0] xn3 = (x>=10'd637) ? x-10'd637 : x+10'd3;
  assign idle = !flush && !ena && !ret_v;
  wire pop = fcnt!=0 && ((newb && nxt!=0) || nxt==0);
  always_ff @(posedge clk) if (rst) begin
    for (int i=0;i<NL;i++) begin act[i]<=0; fifo[i] <= lab_t'(i+2); end
    fr<=0; fw<=lab_t'(NL-2); fcnt<=NL-2; nxt<=1; ena_d<=0; flush<=0; num<=0; ret_v<=0; blob_out<=0;
    for (int i=0;i<5;i++) up[i]<=0; lf[0]<=0; lf[1]<=0;
  end else begin
    ena_d <= ena;
    if (ena) begin
      up[0]<=up[1]; up[1]<=up[2]; up[2]<=up[3]; up[3]<=up[4]; up[4]<=lbuf[xn3];
      lbuf[x] <= lab; lf[0]<=lab; lf[1]<=lf[0];
      if (lab!=0) begin
        if (newb) begin act[lab]<=1; sx[lab]<=x; ex[lab]<=x; sy[lab]<=y; ey[lab]<=y; end
        else begin if (x<sx[lab]) sx[lab]<=x; if (x>ex[lab]) ex[lab]<=x; ey[lab]<=y; end
      end
    end
    if (newb && nxt!=0 || nxt==0) nxt <= (fcnt!=0) ? fifo[fr] : 0;
    if (pop) fr <= (fr==NL-1)?0:fr+1;
    if (dv) begin act[di]<=0; fifo[fw]<=di; fw<=(fw==NL-1)?0:fw+1; rsx<=sx[di]; rsy<=sy[di]; rex<=ex[di]; rey<=ey[di]; end
    fcnt <= fcnt + (dv?1:0) - (pop?1:0);
    ret_v <= dv;
    if (ena_d & !ena) flush <= 1; else if (flush & !dv) flush <= 0;
    if (ena & !ena_d) num <= 0;
    // blob filter
    blob_out <= ret_v && (rex-rsx >= 24) && (rey-rsy >= 24);
    if (ret_v && (rex-rsx >= 24) && (rey-rsy >= 24)) begin
      blob_start <= {2'b01, num, rsy, rsx}; blob_end <= {2'b00, num, rey, rex}; num <= num+1; end
  end
endmodule
