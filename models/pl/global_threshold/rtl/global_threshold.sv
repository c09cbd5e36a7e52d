// Global Threshold (thesis 4.3.5, ports of table B.2; `threshold` is an input, as table B.4 drives
// it). Companion of ThresholdCore (core.h).
//
// The histogram lies in distributed memory, which cannot be cleared at once: `counted` says which of
// its counters hold something of this frame.
module global_threshold #(
    parameter int WIDTH = 640,
    parameter int HEIGHT = 480,
    parameter logic [7:0] DEFAULT_THRESHOLD = 8'd127,  // after a system reset
    parameter int X_BITS = WIDTH > 1024 ? $clog2(WIDTH) : 10,
    parameter int Y_BITS = HEIGHT > 512 ? $clog2(HEIGHT) : 9
) (
    input  logic        clk,
    input  logic        por,               // system reset
    input  logic        rst,               // the threshold survives it
    input  logic        frame_ena,
    input  logic        wr_thresh,         // a level: loads `threshold` on every clock
    input  logic [ 7:0] threshold,
    input  logic [ 7:0] pixel,
    input  logic [X_BITS-1:0] x,
    input  logic [Y_BITS-1:0] y,
    output logic        binary_ena,
    output logic        binary_out,        // 1 is dark
    output logic [X_BITS-1:0] binary_x,
    output logic [Y_BITS-1:0] binary_y,
    output logic        thresh_out,
    output logic [31:0] thresh_data,       // bit i is pixel 32w + i
    output logic [ 7:0] active_threshold   // for reports
);
  localparam int COUNT_BITS = $clog2(WIDTH * HEIGHT + 1);

  logic frame_before;
  wire frame_ended = frame_before && !frame_ena;

  wire dark = pixel <= active_threshold;
  logic [31:1] word;  // the newest 31
  wire [31:0] next_word = {dark, word};

  always_ff @(posedge clk)
    if (por || rst) begin
      frame_before <= 1'b0;
      binary_ena   <= 1'b0;
      thresh_out   <= 1'b0;
    end else begin
      frame_before <= frame_ena;
      binary_ena   <= frame_ena;
      thresh_out   <= frame_ena && x[4:0] == 5'd31;
      if (frame_ena) begin
        binary_out <= dark;
        binary_x   <= x;
        binary_y   <= y;
        word       <= next_word[31:1];
        if (x[4:0] == 5'd31) thresh_data <= next_word;
      end
    end

  // One counter a grey level.
  logic [COUNT_BITS-1:0] histogram[0:255];
  logic [255:0] counted;
  wire [COUNT_BITS-1:0] count = (counted[pixel] ? histogram[pixel] : '0) + 1'b1;
  wire clear = por || rst || frame_ended;

  always_ff @(posedge clk) if (frame_ena) histogram[pixel] <= count;

  always_ff @(posedge clk)
    if (clear) counted <= '0;
    else if (frame_ena) counted[pixel] <= 1'b1;

  // The most frequent level of each half, replaced by a strictly greater count only.
  logic [COUNT_BITS-1:0] dark_count, bright_count;
  logic [7:0] dark_peak, bright_peak;
  always_ff @(posedge clk)
    if (clear) begin
      dark_count   <= '0;
      bright_count <= '0;
      dark_peak    <= 8'd0;
      bright_peak  <= 8'd255;
    end else if (frame_ena) begin
      if (!pixel[7] && count > dark_count) begin
        dark_count <= count;
        dark_peak  <= pixel;
      end
      if (pixel[7] && count > bright_count) begin
        bright_count <= count;
        bright_peak  <= pixel;
      end
    end

`ifndef SYNTHESIS
  initial active_threshold = DEFAULT_THRESHOLD;  // a simulation may begin behind the system reset
`endif
  wire [7:0] middle = 8'(({1'b0, dark_peak} + {1'b0, bright_peak}) >> 1);
  always_ff @(posedge clk)
    if (por) active_threshold <= DEFAULT_THRESHOLD;
    else if (!rst && wr_thresh) active_threshold <= threshold;
    else if (!rst && frame_ended) active_threshold <= middle;
endmodule
