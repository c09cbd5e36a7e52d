// Otsu Threshold, with the ports of Global Threshold. Companion of find_otsu_threshold() (core.h).
//
// Two histograms in turn: one counts, the other one is searched, a level a clock, through a pipeline
// of 14 clocks. Each pixel of a clock has histograms of its own. Their sum takes a register more; so the
// search begins a clock earlier, and counters take pixels from the port, where there are several.
module otsu_threshold #(
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
  localparam int PIXELS = $clog2(WIDTH * HEIGHT + 1);
  localparam int N = PIXELS > 18 ? PIXELS : 18;  // bits of a count of pixels
  localparam int S = N + 8;                      // bits of a sum of levels

  wire reset = por || rst;
  logic frame_before;
  wire frame_ended = frame_before && !frame_ena;

  wire [8*PIXELS_PER_CLOCK-1:0] pixels_come = (8 * PIXELS_PER_CLOCK)'({pixel_3, pixel_2, pixel_1, pixel});
  logic [PIXELS_PER_CLOCK-1:0] dark, binary;
  for (genvar lane = 0; lane < PIXELS_PER_CLOCK; lane++) begin : g_dark
    assign dark[lane] = pixels_come[8*lane+:8] <= active_threshold;
  end
  logic [31:PIXELS_PER_CLOCK] word;  // the newest
  wire [31:0] next_word = {dark, word};
  wire ends_word = x[4:0] == 5'(32 - PIXELS_PER_CLOCK);
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
        word       <= next_word[31:PIXELS_PER_CLOCK];
        if (ends_word) thresh_data <= next_word;
      end
    end

  // Pixels and their sum are counted one clock behind the port; the totals of a frame are valid one
  // clock after its end.
  localparam int SEVERAL = PIXELS_PER_CLOCK > 1 ? 1 : 0;
  localparam int LEVELS = 7 + $clog2(2 * PIXELS_PER_CLOCK);  // bits of the sum of a clock's levels
  logic ended, counts, bank;  // `bank`: the histogram that counts
  logic [LEVELS-1:0] level, levels_come;
  logic [N-1:0] n, pixels;
  logic [S-1:0] s, sum;
  always_comb begin
    levels_come = '0;
    for (int i = 0; i < PIXELS_PER_CLOCK; i++) levels_come = levels_come + LEVELS'(pixels_come[8*i+:8]);
  end
  always_ff @(posedge clk) begin
    ended  <= frame_ended && !reset;
    counts <= frame_ena && !reset;
    level  <= levels_come;
    if (reset || ended) begin
      n <= '0;
      s <= '0;
    end else if (counts) begin
      n <= n + N'(PIXELS_PER_CLOCK);
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
  logic [SEVERAL+1:0] reads;
  always_ff @(posedge clk) begin
    if (reset) searched <= 9'h100;
    else if (ended) searched <= SEVERAL != 0 ? 9'h000 : 9'h1FF;
    else if (searched != 9'h100) searched <= searched + 1'b1;
    reads <= reset || ended ? '0 : {reads[SEVERAL:0], !searched[8]};
  end

  logic [PIXELS_PER_CLOCK*N-1:0] counted_by;
  for (genvar lane = 0; lane < PIXELS_PER_CLOCK; lane++) begin : g_lane
    level_counters #(
        .N(N),
        .SEVERAL(SEVERAL)
    ) counters (
        .clk,
        .clear(reset),
        .ended,
        .bank,
        .into(SEVERAL != 0 ? bank != ended : bank),
        .counts(SEVERAL != 0 ? frame_ena : counts),
        .level(SEVERAL != 0 ? pixels_come[8*lane+:8] : level[7:0]),
        .searched(searched[7:0]),
        .counted(counted_by[lane*N+:N])
    );
  end
  logic [N-1:0] counted;
  if (SEVERAL != 0) begin : g_sum
    logic [N-1:0] all, not_all;  // inverted, or Yosys takes the sum into a multiplier, and away from here
    always_comb begin
      all = '0;
      for (int i = 0; i < PIXELS_PER_CLOCK; i++) all = all + counted_by[i*N+:N];
    end
    always_ff @(posedge clk) not_all <= ~all;
    assign counted = ~not_all;
  end else begin : g_one
    assign counted = counted_by;
  end

  logic found;
  logic [7:0] best_threshold;
  otsu_search #(
      .N(N),
      .S(S)
  ) search (
      .clk,
      .clear(reset || ended),
      .reads(reads[SEVERAL+1]),
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
