// The runs of dark pixels and their labels, several pixels a clock. Companion of GroupLabellingCore
// (group_core.h).
//
// A clock's pixels are captured in one clock, the runs that end in them known behind the next, compared
// with those above in the third, taken in the fourth, and labelled in the fifth.
module group_labeller #(
    parameter int WIDTH = 640,
    parameter int HEIGHT = 480,
    parameter int BITS = 9,   // of a label
    parameter int P = 4,      // pixels a clock, 2 or 4
    parameter int FIFO_DEPTH = 64,
    parameter int X_BITS = 10,
    parameter int Y_BITS = 9
) (
    input  logic              clk,
    input  logic              ena,
    input  logic              rst,
    input  logic [     P-1:0] pixels,      // 1 is dark
    input  logic [X_BITS-1:0] x,
    input  logic [Y_BITS-1:0] y,
    output logic              busy,        // a frame, or what follows it
    // A run ended without label, and takes the next one.
    output logic              is_new,
    input  logic [  BITS-1:0] next_label,
    input  logic              label_free,
    output logic [      31:0] label_overflow,
    // What its extremes do: label_extremes.sv.
    output logic              written,
    output logic [  BITS-1:0] written_label,
    output logic [X_BITS-1:0] run_first,
    output logic [X_BITS-1:0] run_last,
    output logic [Y_BITS-1:0] run_row,
    output logic              clear,
    output logic              load,
    output logic [  BITS-1:0] held,
    output logic              holds,
    output logic              joins,
    output logic [  BITS-1:0] touched,
    // A label that is done with, of a complete component or not.
    output logic              done,
    output logic              done_blob,
    output logic [  BITS-1:0] done_label
);
  localparam int COLUMN = $clog2(WIDTH + 1);
  localparam int RUNS = 2 * (WIDTH / 4 + 2);  // places in the ring of runs
  localparam int PLACE = $clog2(RUNS);
  // Rows that end while what is in the FIFO has its turn, each run of it twice, behind that of a row.
  localparam int ROW = WIDTH / P;
  localparam int ENDS = (2 * FIFO_DEPTH + WIDTH / 2 + 1 + ROW) / (ROW - 1) + 1;

  wire [2:0] come;
  wire [3*COLUMN-1:0] come_first, come_behind;
  wire row_ends, frame_ends;
  group_runs #(
      .WIDTH(WIDTH),
      .HEIGHT(HEIGHT),
      .P(P),
      .X_BITS(X_BITS),
      .Y_BITS(Y_BITS),
      .COLUMN(COLUMN)
  ) pixels_of_clock (
      .clk,
      .rst,
      .ena,
      .pixels,
      .x,
      .y,
      .ends(come),
      .first(come_first),
      .behind(come_behind),
      .row_ends,
      .frame_ends
  );

  wire take, waits, is_end, is_frame_end, next_waits, next_is_end;
  wire [COLUMN-1:0] front_first, front_behind, next_first, next_behind;
  wire [COLUMN-1:0] lost;  // pixels
  wire [1:0] lost_more;
  run_fifo #(
      .DEPTH(FIFO_DEPTH),
      .ENDS(ENDS),
      .COLUMN(COLUMN)
  ) fifo (
      .clk,
      .rst,
      .come,
      .first(come_first),
      .behind(come_behind),
      .row_ends,
      .frame_ends,
      .take,
      .waits,
      .is_end,
      .is_frame_end,
      .front_first,
      .front_behind,
      .next_waits,
      .next_is_end,
      .next_first,
      .next_behind,
      .lost,
      .lost_more
  );

  // What happens to the present run and the one above, in this order; at most one of both ends.
  wire takes_above, touches, passes, finishes, frame_is_over;
  // verilator lint_off UNUSEDSIGNAL
  // The column behind a row may have a bit more than those in it.
  wire [COLUMN-1:0] first, behind;
  // verilator lint_on UNUSEDSIGNAL
  wire [COLUMN-1:0] length;
  wire [Y_BITS-1:0] row;
  run_merge #(
      .RUNS(RUNS),
      .PLACE(PLACE),
      .COLUMN(COLUMN),
      .Y_BITS(Y_BITS)
  ) merge (
      .clk,
      .rst,
      .waits,
      .is_end,
      .is_frame_end,
      .first(front_first),
      .behind(front_behind),
      .next_waits,
      .next_is_end,
      .next_first,
      .next_behind,
      .take,
      .takes_above,
      .touches,
      .passes,
      .finishes,
      .run_first(first),
      .run_behind(behind),
      .run_length(length),
      .run_row(row),
      .frame_is_over
  );
  always_ff @(posedge clk) busy <= !rst && (ena || (busy && !frame_is_over));

  // The run above. One that has another one of its component to its left finds it on top of the stack of
  // open components.
  logic [BITS-1:0] above_label, open_label;
  logic above_valid, above_seen, above_left, above_right, above_met, open_seen;
  wire [BITS-1:0] stored_label;
  wire stored_valid, stored_left, stored_right;
  assign touched = !takes_above ? above_label : stored_left ? open_label : stored_label;
  wire touched_valid = takes_above ? stored_left || stored_valid : above_valid;
  wire touched_seen = takes_above ? stored_left && open_seen : above_seen;
  wire left = takes_above ? stored_left : above_left;
  wire right = takes_above ? stored_right : above_right;

  // The present run. It may have a label where the run above is looked at for the first time, only.
  logic [BITS-1:0] label;
  logic labelled, linked;
  wire adopts = touches && touched_valid && !labelled;
  wire other_open = stored_left && open_label != label;
  wire other_next = !stored_left && stored_valid && stored_label != label;
  wire meets = touches && takes_above && labelled;
  // One that has runs in this row lies around the present one, and is the open one.
  wire joins_outer = meets && other_open && open_seen;
  wire joins_inner = meets && (other_next || (other_open && !open_seen));
  assign joins = joins_outer || joins_inner;

  // The run that ended: its label, a new one if it has none, none if none is free.
  wire [BITS-1:0] final_label = labelled && !joins_outer ? label : adopts || joins_outer ? touched : next_label;
  wire is_valid = labelled || adopts || label_free;
  wire is_linked = adopts ? touched_seen : labelled && (linked || joins_outer);
  assign is_new = finishes && !labelled && !adopts;
  // What comes late decides last.
  wire loses = is_new && !label_free;
  logic [15:0] overflow, overflow_above;  // lower half, upper half
  logic [15:0] next_above;                // that plus 1; the lower half carries once in many clocks
  wire [16:0] without_run = 17'(overflow) + 17'(lost) + 17'(lost_more);
  wire [16:0] with_run = 17'(overflow) + 17'(length) + 17'(lost) + 17'(lost_more);
  wire carries = loses ? with_run[16] : without_run[16];
  assign label_overflow = {overflow_above, overflow};

  always_ff @(posedge clk) begin
    if (adopts || joins_outer) label <= touched;
    if (rst || finishes) labelled <= 1'b0;
    else if (adopts) labelled <= 1'b1;
    if (adopts) linked <= touched_seen;
    else if (joins_outer) linked <= 1'b1;
    above_label <= joins_inner ? label : touched;
    above_valid <= touched_valid;
    above_seen  <= touched_seen || adopts || joins_inner;
    above_left  <= left;
    above_right <= right;
    above_met   <= (!takes_above && above_met) || (touches && finishes);
    next_above <= overflow_above + 16'd1;
    if (rst) {overflow_above, overflow} <= '0;
    else begin
      overflow <= loses ? with_run[15:0] : without_run[15:0];
      if (carries) overflow_above <= next_above;
    end
  end

  group_ring #(
      .RUNS (RUNS),
      .PLACE(PLACE),
      .BITS (BITS)
  ) ring (
      .clk,
      .rst,
      .finishes,
      .label(final_label),
      .valid(is_valid),
      .linked(is_linked),
      .behind_last(!takes_above && above_met && !labelled),
      .behind_outer(!labelled || (joins_outer && !linked)),
      .joins_linked(joins_outer && linked),
      .outer(open_label),
      .inner(label),
      .take(takes_above),
      .stored_label,
      .stored_valid,
      .stored_left,
      .stored_right
  );

  // Components that are open in the row above; the top is a register.
  wire passed = passes && touched_valid;
  wire open_replace = passed && right && left;
  wire open_push = passed && right && !left;
  wire open_pop = passed && !right && left;
  wire complete = passed && !right && !touched_seen && !adopts && !joins_inner;
  logic [BITS:0] stack[0:(1<<(PLACE-1))-1];
  logic [PLACE-2:0] depth, under;  // under = depth - 1
  always_ff @(posedge clk) begin
    if (open_push) stack[depth] <= {open_seen, open_label};
    if (open_push || open_replace)
      {open_seen, open_label} <= {touched_seen || adopts || joins_inner, joins_inner ? label : touched};
    else if (open_pop) {open_seen, open_label} <= stack[under];
    if (rst) {depth, under} <= {(PLACE - 1)'(0), ~(PLACE - 1)'(0)};
    else if (open_push) {depth, under} <= {depth + 1'b1, depth};
    else if (open_pop) {depth, under} <= {under, under - 1'b1};
  end
  assign done = complete || joins;
  assign done_blob = complete;
  assign done_label = joins_outer ? label : touched;

  // A run joins its component's extremes a clock behind those of the runs that it touched.
  always_ff @(posedge clk) begin
    written       <= finishes && is_valid && !rst;
    written_label <= final_label;
    run_first     <= X_BITS'(first);
    run_last      <= X_BITS'(behind) - 1'b1;
    run_row       <= row;
    if (finishes) {holds, held} <= {is_valid, final_label};
    else if (adopts || joins_outer) {holds, held} <= {1'b1, touched};
  end
  assign clear = is_new;
  assign load = adopts;
endmodule
