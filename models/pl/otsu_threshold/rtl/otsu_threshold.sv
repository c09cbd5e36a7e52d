// Otsu Threshold, with the ports of Global Threshold. Companion of find_otsu_threshold() (core.h).
//
// Two histograms in turn: one counts, the other one is searched, a level a clock, through a pipeline
// of 14 clocks.
module otsu_threshold #(
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
  localparam int PIXELS = $clog2(WIDTH * HEIGHT + 1);
  localparam int N = PIXELS > 18 ? PIXELS : 18;  // bits of a count of pixels
  localparam int S = N + 8;                      // bits of a sum of levels

  wire reset = por || rst;
  logic frame_before;
  wire frame_ended = frame_before && !frame_ena;

  wire dark = pixel <= active_threshold;
  logic [31:1] word;  // the newest 31
  wire [31:0] next_word = {dark, word};

  always_ff @(posedge clk)
    if (reset) begin
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

  // Pixels, and their sum, are counted one clock behind the port; what the frame had stands one clock
  // behind its end.
  logic ended, counts, bank;  // `bank`: the histogram that counts
  logic [7:0] level;
  logic [N-1:0] n, pixels;
  logic [S-1:0] s, sum;
  always_ff @(posedge clk) begin
    ended  <= frame_ended && !reset;
    counts <= frame_ena && !reset;
    level  <= pixel;
    if (reset || ended) begin
      n <= '0;
      s <= '0;
    end else if (counts) begin
      n <= n + 1'b1;
      s <= s + S'(level);
    end
    if (ended) begin
      pixels <= n;
      sum    <= s;
    end
    if (reset) bank <= 1'b0;
    else if (ended) bank <= !bank;
  end

  // Behind that the other one is searched, from two clocks later on.
  logic [8:0] searched;
  logic [1:0] reads;
  always_ff @(posedge clk) begin
    if (reset) searched <= 9'h100;
    else if (ended) searched <= 9'h1FF;
    else if (searched != 9'h100) searched <= searched + 1'b1;
    reads <= reset || ended ? 2'd0 : {reads[0], !searched[8]};
  end

  logic [N-1:0] counted;
  level_counters #(
      .N(N)
  ) counters (
      .clk,
      .clear(reset),
      .ended,
      .bank,
      .counts,
      .level,
      .searched(searched[7:0]),
      .counted
  );

  logic found;
  logic [7:0] best_threshold;
  otsu_search #(
      .N(N),
      .S(S)
  ) search (
      .clk,
      .clear(reset || ended),
      .reads(reads[1]),
      .counted,
      .pixels,
      .sum,
      .found,
      .threshold(best_threshold)
  );

  // What was found waits for the end of a frame that runs. Another one that ends just now began a new
  // search.
  logic waits;
  wire is_found = (found || waits) && !ended && !reset;
  always_ff @(posedge clk) waits <= is_found && frame_ena;

`ifndef SYNTHESIS
  initial active_threshold = DEFAULT_THRESHOLD;  // a simulation may begin behind the system reset
`endif
  always_ff @(posedge clk)
    if (por) active_threshold <= DEFAULT_THRESHOLD;
    else if (!rst && wr_thresh) active_threshold <= threshold;
    else if (is_found && !frame_ena) active_threshold <= best_threshold;
endmodule
