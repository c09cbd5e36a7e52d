// The threshold between the peaks of a frame of which several pixels came on a clock: Peaks (core.h),
// a level a clock behind the frame.
//
// A peak is the level that reached the greatest count of its half first, so that with the last of its
// pixels: of levels with the same count it is the one that came last the longest ago. Levels are
// searched from the middle outwards: the outermost level is the peak of a half without a pixel.
module peak_search #(
    parameter int P = 2,      // pixels a clock, 2 or 4
    parameter int N = 18,     // bits of a count of clocks
    parameter int BITS = 18   // of a clock's number
) (
    input  logic          clk,
    input  logic          clear,      // no search is under way
    input  logic          begins,     // with the next clock
    output logic [   7:0] searched,   // level
    input  logic [P*N-1:0] counted,   // of it, two clocks later, by each pixel of a clock
    input  logic [P*BITS-1:0] last,
    output logic          found,
    output logic [   7:0] threshold
);
  localparam int TOTAL = N + 2;
  localparam int TIME = BITS + 3;  // any; clock; pixel of it

  function automatic logic [7:0] outwards(input logic [7:0] step);
    outwards = {step[7], step[6:0] ^ {7{!step[7]}}};
  endfunction

  logic [8:0] step;
  logic [5:1] passes;
  always_ff @(posedge clk) begin
    if (begins) step <= '0;
    else if (clear) step <= 9'h100;
    else if (!step[8]) step <= step + 1'b1;
    passes <= clear || begins ? '0 : {passes[4:1], !step[8]};
  end
  assign searched = outwards(step[7:0]);

  // Counts are added up, and the latest clock found, in pairs.
  logic [4*N-1:0] counts;
  logic [4*BITS-1:0] clocks;
  assign counts = (4 * N)'(counted);
  assign clocks = (4 * BITS)'(last);
  logic [3:0] any;
  logic [4*BITS-1:0] seen;
  logic [TOTAL-1:0] sum_low, sum_high, total_early, total;
  logic [TIME-1:0] latest_low, latest_high, latest;
  wire [TIME-1:0] time_0 = any[0] ? {1'b1, seen[0+:BITS], 2'd0} : '0;
  wire [TIME-1:0] time_1 = any[1] ? {1'b1, seen[BITS+:BITS], 2'd1} : '0;
  wire [TIME-1:0] time_2 = any[2] ? {1'b1, seen[2*BITS+:BITS], 2'd2} : '0;
  wire [TIME-1:0] time_3 = any[3] ? {1'b1, seen[3*BITS+:BITS], 2'd3} : '0;
  always_ff @(posedge clk) begin
    for (int i = 0; i < 4; i++) any[i] <= counts[i*N+:N] != '0;
    seen        <= clocks;
    sum_low     <= TOTAL'(counts[0+:N]) + TOTAL'(counts[N+:N]);
    sum_high    <= TOTAL'(counts[2*N+:N]) + TOTAL'(counts[3*N+:N]);
    total_early <= sum_low + sum_high;
    latest_low  <= time_1 > time_0 ? time_1 : time_0;
    latest_high <= time_3 > time_2 ? time_3 : time_2;
    total       <= total_early;
    latest      <= latest_high > latest_low ? latest_high : latest_low;
  end

  // No two levels have the same count and the same latest pixel, but those without any.
  logic [7:0] at, dark_peak, peak;
  logic [TOTAL+TIME-1:0] best;
  wire [TOTAL+TIME-1:0] rank = {total, ~latest};
  wire first = at[6:0] == '0;
  always_ff @(posedge clk)
    if (clear || begins) at <= '0;
    else if (passes[5]) begin
      at <= at + 1'b1;
      if (first || rank >= best) begin
        best <= rank;
        peak <= outwards(at);
      end
      if (first) dark_peak <= peak;  // the last time it is that
    end
  always_ff @(posedge clk) found <= !clear && !begins && passes[5] && at == 8'd255;
  assign threshold = 8'(({1'b0, dark_peak} + {1'b0, peak}) >> 1);
endmodule
