// Feature Packaging and the AXI Threshold Bridge (thesis 4.4), system clock. Words come from the pixel
// clock as toggles.
/* verilator lint_off WIDTH */
module feature_packaging(input logic clk, ena, rst, input logic [1:0] ready, input logic corner_in, input logic [31:0] corner_data,
    input logic blob_in, input logic [31:0] blob_start, blob_end, input logic done, output logic [31:0] feature);
  // corner_in / blob_in are toggles (synchronous 50->100 MHz crossing)
  logic [31:0] cf [0:127]; logic [6:0] cw, cr; logic [31:0] bf [0:127]; logic [6:0] bw_, br; logic ct, bt; logic [1:0] rd_d; logic want, ended;
  wire [6:0] cn = cw-cr, bn = bw_-br;
  always_ff @(posedge clk) if (rst) begin cw<=0; cr<=0; bw_<=0; br<=0; ct<=0; bt<=0; rd_d<=0; want<=1; ended<=0; feature<=0; end else begin
    ct <= corner_in; bt <= blob_in; rd_d <= ready;
    if (ct != corner_in && cn < 100) begin cf[cw] <= corner_data; cw <= cw+1; end
    if (bt != blob_in && bn < 99) begin bf[bw_] <= blob_start; bf[7'(bw_+1)] <= blob_end; bw_ <= bw_+2; end
    if (want) begin
      if (cn!=0) begin feature <= cf[cr]; cr<=cr+1; want<=0; end
      else if (bn!=0) begin feature <= bf[br]; br<=br+1; want<=0; end
      else if (done && !ended && ct==corner_in && bt==blob_in) begin feature <= 32'hFFFFFFFF; ended<=1; want<=0; end
    end
    if (rd_d != ready) want <= 1;
    if (!done) ended <= 0;
  end
endmodule

module axi_threshold_bridge(input logic clk, ena, rst, thresh_in, input logic [31:0] thresh_data, output logic tvalid, tlast, output logic [31:0] tdata, input logic tready);
  logic [31:0] f [0:63]; logic [6:0] wp, rp; logic tg; logic [4:0] bc; wire full = (wp - rp) == 7'd64;
  always_ff @(posedge clk) if (rst) begin wp<=0; rp<=0; tg<=0; bc<=0; tvalid<=0; tlast<=0; end else begin
    tg <= thresh_in; if (tg != thresh_in && !full) begin f[wp[5:0]] <= thresh_data; wp<=wp+1; end
    if (!tvalid || tready) begin tvalid <= wp!=rp; tdata <= f[rp[5:0]]; tlast <= (wp!=rp) && bc==31; if (wp!=rp) begin rp<=rp+1; bc<=bc+1; end end
  end
endmodule
