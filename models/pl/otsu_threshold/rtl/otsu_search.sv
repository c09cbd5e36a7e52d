// The search for Otsu's threshold, one level a clock. A level is one of the 256 splits: n0 pixels of
// sum s0 are not above it. The logarithm of the variance between both classes is
// 2 log2 d - log2 q with d = n0 s - n s0 and q = n0 (n - n0).
module otsu_search #(
    parameter int N = 19,  // bits of a count of pixels, 18 to 24
    parameter int S = 27   // bits of a sum of levels
) (
    input  logic         clk,
    input  logic         clear,     // no search is under way
    input  logic         reads,     // of a level, from 0 on in each clock
    input  logic [N-1:0] counted,
    input  logic [N-1:0] pixels,
    input  logic [S-1:0] sum,
    output logic         found,     // in this clock, 12 behind the one of level 255
    output logic [  7:0] threshold
);
  // What is in which stage: its level was read; it splits the pixels into two classes.
  localparam int STAGES = 11;
  logic [STAGES:1] passes;
  logic [STAGES:3] splits;
  // What goes through them is cleared a clock later, before the first level comes: in one clock it would
  // be too many loads.
  logic cleared;
  always_ff @(posedge clk) cleared <= clear;

  // Sums of counts and of levels, which are counts times level.
  logic [7:0] weight;
  logic [N-1:0] n0, n0_of_s0, n1;
  logic [S-1:0] weighted, s0;
  always_ff @(posedge clk) begin
    weight   <= cleared ? '0 : weight + 8'(reads);
    weighted <= counted * S'(weight);
    n0       <= cleared ? '0 : n0 + (reads ? counted : '0);
    s0       <= cleared ? '0 : s0 + (passes[1] ? weighted : '0);
    n0_of_s0 <= n0;
    n1       <= pixels - n0;
  end

  // Products, of factors as wide as the multipliers of the chip; then sums of their parts.
  localparam int LOW = 17;
  localparam int D = N + S, Q = 2 * N;
  logic [N+LOW-1:0] n0_sum_low, n_s0_low, q_low;
  logic [D-LOW-1:0] n0_sum_high, n_s0_high;
  logic [Q-LOW-1:0] q_high;
  logic [D-LOW-1:0] d_high;
  logic [N+LOW:0] d_low;
  logic [Q-1:0] q_sum, q;
  logic [D-1:0] d;
  always_ff @(posedge clk) begin
    n0_sum_low  <= n0_of_s0 * (N + LOW)'(sum[LOW-1:0]);
    n0_sum_high <= n0_of_s0 * (D - LOW)'(sum[S-1:LOW]);
    n_s0_low    <= pixels * (N + LOW)'(s0[LOW-1:0]);
    n_s0_high   <= pixels * (D - LOW)'(s0[S-1:LOW]);
    q_low       <= n0_of_s0 * (N + LOW)'(n1[LOW-1:0]);
    q_high      <= n0_of_s0 * (Q - LOW)'(n1[N-1:LOW]);
    d_low       <= {1'b0, n0_sum_low} - {1'b0, n_s0_low};
    d_high      <= n0_sum_high - n_s0_high;
    q_sum       <= Q'(q_low) + {q_high, LOW'(0)};
    d           <= {d_high, LOW'(0)} + D'($signed(d_low));
    q           <= q_sum;
  end

  logic [19:0] log_d, log_q;
  coarse_log2 #(.BITS(D)) of_d (.clk, .value(d), .log(log_d));
  coarse_log2 #(.BITS(Q)) of_q (.clk, .value(q), .log(log_q));

  // The greatest variance so far, and the first and last of the neighbouring levels that have it.
  logic [20:0] variance, best;
  logic [7:0] split, first, last, behind_last;
  logic any;
  wire better = splits[STAGES] && (!any || variance > best);
  wire as_good = splits[STAGES] && any && variance == best && split == behind_last;
  always_ff @(posedge clk) begin
    passes   <= clear ? '0 : {passes[STAGES-1:1], reads};
    splits   <= clear ? '0 : {splits[STAGES-1:3], passes[2] && n0_of_s0 != '0 && n1 != '0};
    variance <= {log_d, 1'b0} - {1'b0, log_q};
    if (cleared) split <= 8'd0;
    else if (passes[STAGES]) split <= split + 1'b1;
    if (better) begin
      best  <= variance;
      first <= split;
    end
    if (better || as_good) begin
      last        <= split;
      behind_last <= split + 1'b1;
    end
    if (cleared) any <= 1'b0;
    else if (better) any <= 1'b1;
  end
  logic ends;
  always_ff @(posedge clk) ends <= !clear && passes[STAGES] && split == 8'd255;
  assign found = ends && any;
  assign threshold = 8'(({1'b0, first} + {1'b0, last}) >> 1);
endmodule
