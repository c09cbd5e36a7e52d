// Global Threshold (thesis 4.3.5, ports of table B.2; `threshold` is an input, as table B.4 drives
// it). Companion of ThresholdCore (core.h).
//
// With one pixel a clock the peaks follow the histogram. It lies in distributed memory, which cannot be
// cleared at once: `counted` says which of its counters hold something of this frame. With several a
// pixel would have to be compared with the peak behind the one beside it: each has histograms of its
// own, and the peaks are searched behind the frame, as otsu_threshold does it.
module global_threshold #(
    parameter int WIDTH = 640,
    parameter int HEIGHT = 480,
    parameter logic [7:0] DEFAULT_THRESHOLD = 8'd127,  // after a system reset
    parameter int PIXELS_PER_CLOCK = 1,  // 1, 2 or 4
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
    // verilator lint_off UNUSEDSIGNAL
    // Neighbours to the right, as many as come on a clock.
    input  logic [ 7:0] pixel_1,
    input  logic [ 7:0] pixel_2,
    input  logic [ 7:0] pixel_3,
    // verilator lint_on UNUSEDSIGNAL
    input  logic [X_BITS-1:0] x,
    input  logic [Y_BITS-1:0] y,
    output logic        binary_ena,
    output logic        binary_out,        // 1 is dark
    output logic        binary_out_1,
    output logic        binary_out_2,
    output logic        binary_out_3,
    output logic [X_BITS-1:0] binary_x,
    output logic [Y_BITS-1:0] binary_y,
    output logic        thresh_out,
    output logic [31:0] thresh_data,       // bit i is pixel 32w + i
    output logic [ 7:0] active_threshold   // for reports
);
  localparam int P = PIXELS_PER_CLOCK;

  wire reset = por || rst;
  logic frame_before;
  wire frame_ended = frame_before && !frame_ena;

  wire [8*P-1:0] pixels_come = (8 * P)'({pixel_3, pixel_2, pixel_1, pixel});
  logic [P-1:0] dark, binary;
  for (genvar lane = 0; lane < P; lane++) begin : g_dark
    assign dark[lane] = pixels_come[8*lane+:8] <= active_threshold;
  end
  logic [31:P] word;  // the newest
  wire [31:0] next_word = {dark, word};
  wire ends_word = x[4:0] == 5'(32 - P);
  assign {binary_out_3, binary_out_2, binary_out_1, binary_out} = 4'(binary);

  always_ff @(posedge clk)
    if (reset) begin
      frame_before <= 1'b0;
      binary_ena   <= 1'b0;
      thresh_out   <= 1'b0;
    end else begin
      frame_before <= frame_ena;
      binary_ena   <= frame_ena;
      thresh_out   <= frame_ena && ends_word;
      if (frame_ena) begin
        binary     <= dark;
        binary_x   <= x;
        binary_y   <= y;
        word       <= next_word[31:P];
        if (ends_word) thresh_data <= next_word;
      end
    end

  logic loads;
  logic [7:0] middle;  // of the peaks
  if (P == 1) begin : g_one
    // One counter a grey level.
    localparam int COUNT_BITS = $clog2(WIDTH * HEIGHT + 1);
    logic [COUNT_BITS-1:0] histogram[0:255];
    logic [255:0] counted;
    wire [COUNT_BITS-1:0] count = (counted[pixel] ? histogram[pixel] : '0) + 1'b1;
    wire clear = reset || frame_ended;

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

    assign loads = frame_ended;
    assign middle = 8'(({1'b0, dark_peak} + {1'b0, bright_peak}) >> 1);
  end else begin : g_several
    localparam int CLOCK_BITS = $clog2(WIDTH * HEIGHT / P);  // of a clock of the frame,
    localparam int COUNT_BITS = $clog2(WIDTH * HEIGHT / P + 1);  // and of a lane's pixels
    logic ended, bank;  // the histograms that count; the others are searched
    logic [CLOCK_BITS-1:0] now;
    always_ff @(posedge clk) begin
      ended <= frame_ended && !reset;
      if (reset) bank <= 1'b0;
      else if (ended) bank <= !bank;
      now <= frame_ena ? now + 1'b1 : '0;
    end

    logic [7:0] searched;
    logic [P*COUNT_BITS-1:0] counted;
    logic [P*CLOCK_BITS-1:0] last;
    for (genvar lane = 0; lane < P; lane++) begin : g_lane
      level_counters #(
          .N(COUNT_BITS),
          .SEVERAL(1)
      ) counters (
          .clk,
          .clear(reset),
          .ended,
          .bank,
          .into(bank != ended),
          .counts(frame_ena),
          .level(pixels_come[8*lane+:8]),
          .searched,
          .counted(counted[lane*COUNT_BITS+:COUNT_BITS])
      );
      last_seen #(
          .BITS(CLOCK_BITS)
      ) seen_last (
          .clk,
          .bank,
          .into(bank != ended),
          .seen(frame_ena),
          .level(pixels_come[8*lane+:8]),
          .now,
          .searched,
          .last(last[lane*CLOCK_BITS+:CLOCK_BITS])
      );
    end

    logic found;
    peak_search #(
        .P(P),
        .N(COUNT_BITS),
        .BITS(CLOCK_BITS)
    ) search (
        .clk,
        .clear(reset),
        .begins(ended),
        .searched,
        .counted,
        .last,
        .found,
        .threshold(middle)
    );

    // What was found waits for the end of a frame that runs. Another one that ends just now began a
    // new search.
    logic waits;
    wire is_found = (found || waits) && !ended && !reset;
    assign loads = is_found && !frame_ena;
    always_ff @(posedge clk) waits <= is_found && frame_ena;
  end

`ifndef SYNTHESIS
  initial active_threshold = DEFAULT_THRESHOLD;  // a simulation may begin behind the system reset
`endif
  always_ff @(posedge clk)
    if (por) active_threshold <= DEFAULT_THRESHOLD;
    else if (!rst && wr_thresh) active_threshold <= threshold;
    else if (!rst && loads) active_threshold <= middle;
endmodule
