// The feature extraction: one pixel per pixel clock, clk100 the system clock.
// por: the system reset, sets the threshold to 127. rst: the control packet's, leaves it.
/* verilator lint_off WIDTH */
module top #(parameter FULL=1)(input logic clk, clk100, por, rst, ena, wr_thresh, input logic [7:0] threshold_in, input logic [1:0] ready, input logic tready,
   output logic corner_out, output logic [31:0] corner_data, output logic thresh_out, output logic [31:0] thresh_data, output logic blob_out, output logic [31:0] blob_start, blob_end,
   output logic [7:0] threshold, output logic frame_ena, busy, output logic [31:0] feature, output logic tvalid, tlast, output logic [31:0] tdata);
  logic [7:0] pixel; logic [9:0] px; logic [8:0] py; logic be,bo; logic [9:0] bx; logic [8:0] by; logic bidle;
  sensor_input s(.clk, .rst, .ena, .frame_ena, .pixel, .pixel_x(px), .pixel_y(py));
  corner_detection cd(.clk, .ena(frame_ena), .rst, .pixel, .x(px), .y(py), .corner_out, .corner_data);
  global_threshold gt(.clk, .por, .rst, .frame_ena, .wr_thresh, .threshold_in, .pixel, .x(px), .y(py), .threshold, .binary_ena(be), .binary_out(bo), .binary_x(bx), .binary_y(by), .thresh_out, .thresh_data);
  blob_detection bd(.clk, .ena(be), .rst, .pixel(bo), .x(bx), .y(by), .blob_out, .blob_start, .blob_end, .idle(bidle));
  // frame-done tracking (latency covered by 8-bit drain counter)
  logic [3:0] dr; logic started; assign busy = started && (dr!=0 || !bidle || frame_ena);
  logic ctg, btg, ttg; logic [31:0] cdq, bsq, beq, tdq;
  always_ff @(posedge clk) if (rst) begin dr<=15; started<=0; ctg<=0; btg<=0; ttg<=0; end else begin
    if (frame_ena) begin dr<=15; started<=1; end else if (dr!=0 && started) dr<=dr-1;
    if (corner_out) begin ctg<=~ctg; cdq<=corner_data; end if (blob_out) begin btg<=~btg; bsq<=blob_start; beq<=blob_end; end if (thresh_out) begin ttg<=~ttg; tdq<=thresh_data; end
  end
  generate if (FULL) begin
    feature_packaging fp(.clk(clk100), .ena(1'b1), .rst, .ready, .corner_in(ctg), .corner_data(cdq), .blob_in(btg), .blob_start(bsq), .blob_end(beq), .done(started & !busy & !frame_ena), .feature);
    axi_threshold_bridge tb(.clk(clk100), .ena(1'b1), .rst, .thresh_in(ttg), .thresh_data(tdq), .tvalid, .tlast, .tdata, .tready);
  end else begin assign feature=0; assign tvalid=0; assign tlast=0; assign tdata=0; end endgenerate
endmodule
