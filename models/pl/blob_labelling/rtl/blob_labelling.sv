// Blob Labelling: each connected component of dark pixels once, with its outermost pixels in eight
// directions. Companion of LabellingCore (core.h), which says how it works.
//
// A pixel is captured in one clock (`step`), what starts and ends with it is known in the next, and
// decided upon in the third. The memories of the rows' runs follow one clock later, the extremes three.
module blob_labelling #(
    parameter int WIDTH = 640,
    parameter int HEIGHT = 480,
    parameter int LABELS = 512,       // 0, which means none, included
    parameter int MINIMUM_SIDE = 10,  // smallest side (last - first) of a blob that is shown
    parameter int X_BITS = WIDTH > 1024 ? $clog2(WIDTH) : 10,
    parameter int Y_BITS = HEIGHT > 512 ? $clog2(HEIGHT) : 9
) (
    input  logic              clk,
    input  logic              ena,
    input  logic              rst,
    input  logic              pixel,          // 1 is dark
    input  logic [X_BITS-1:0] x,
    input  logic [Y_BITS-1:0] y,
    output logic              blob_out,
    output logic [      31:0] extreme_0,      // y and x of 16 bits each; see blob_stream.h
    output logic [      31:0] extreme_1,
    output logic [      31:0] extreme_2,
    output logic [      31:0] extreme_3,
    output logic [      31:0] extreme_4,
    output logic [      31:0] extreme_5,
    output logic [      31:0] extreme_6,
    output logic [      31:0] extreme_7,
    output logic              idle,           // no frame, and every blob was shown
    output logic [      31:0] label_overflow  // dark pixels of runs that found no free label
);
  localparam int BITS = $clog2(LABELS);
  localparam int COLUMN = $clog2(WIDTH);
  localparam int PLACE = $clog2(WIDTH / 2 + 4);  // of a run in the ring of runs
  localparam int KEYS = 8 * (((X_BITS > Y_BITS) ? X_BITS : Y_BITS) * 2 + 1);
  localparam logic [X_BITS-1:0] LAST = X_BITS'(WIDTH - 1);
  localparam logic [Y_BITS-1:0] BOTTOM = Y_BITS'(HEIGHT - 1);

  // The captured pixel. Behind a frame come a bright row and one pixel more.
  logic step, dark, first_column, last_column, below, final_pixel, busy;
  logic [X_BITS-1:0] column;
  logic [Y_BITS-1:0] row;
  logic [X_BITS:0] flush;
  wire flushing = flush != '0;
  wire [X_BITS-1:0] next_column = !flushing ? x : last_column ? '0 : column + 1'b1;

  logic line[0:WIDTH-1];
  logic line_above;
  always_ff @(posedge clk) begin
    if (step) line[COLUMN'(column)] <= dark;
    line_above <= line[COLUMN'(next_column)];
  end

  always_ff @(posedge clk) begin
    if (flushing || ena) begin
      dark         <= !flushing && pixel;
      column       <= next_column;
      first_column <= next_column == '0;
      last_column  <= next_column == LAST;
      below        <= flushing ? flush != (X_BITS + 1)'(1) : y != '0;
      final_pixel  <= flush == (X_BITS + 1)'(1);
      if (!flushing) row <= y;
    end
    if (rst) begin
      step  <= 1'b0;
      flush <= '0;
      busy  <= 1'b0;
    end else begin
      step <= flushing || ena;
      if (flushing) flush <= flush - 1'b1;
      else if (ena && x == LAST && y == BOTTOM) flush <= (X_BITS + 1)'(WIDTH + 1);
      if (!flushing && ena) busy <= 1'b1;
      else if (ends_frame && !step) busy <= 1'b0;
    end
  end

  // What starts and ends in this row and in the row above, in the next clock.
  logic last_dark, last_above, last_ended;
  wire dark_before = !first_column && last_dark;
  wire above_before = !first_column && last_above;
  wire above = below && line_above;
  wire start = dark && !dark_before;
  wire above_start = above && !above_before;
  logic starts, above_starts, touches, passes, finishes, seen_dark, decides, ends_frame;
  logic [X_BITS-1:0] place_x;
  logic [Y_BITS-1:0] place_y;

  always_ff @(posedge clk) begin
    if (step) begin
      place_x   <= column;
      place_y   <= row;
      seen_dark <= dark;
    end
    if (rst) begin
      last_dark    <= 1'b0;
      last_above   <= 1'b0;
      last_ended   <= 1'b0;
      starts       <= 1'b0;
      above_starts <= 1'b0;
      touches      <= 1'b0;
      passes       <= 1'b0;
      finishes     <= 1'b0;
      decides      <= 1'b0;
      ends_frame   <= 1'b0;
    end else begin
      starts       <= step && start;
      above_starts <= step && above_start;
      touches      <= step && (start ? above || above_before : dark_before && above_start);
      passes       <= step && (first_column ? last_above : above_before && !above);
      finishes     <= step && last_ended;
      decides      <= step;
      ends_frame   <= step && final_pixel;
      if (step) begin
        last_dark  <= dark;
        last_above <= above;
        last_ended <= (dark_before && !dark) || (dark && last_column);
      end
    end
  end

  // The run above: the present one or the one before, and the next one. A run that has another one of
  // its component to its left finds it on top of the stack of open components. Labels are compared
  // before it is known which one counts.
  logic [BITS-1:0] above_label, next_above_label, open_label;
  logic above_valid, above_seen, above_left, above_right, open_seen;
  logic next_above_valid, next_above_left, next_above_right, joins_valid, joins_left, joins_same;
  logic [PLACE-1:0] above_place, read;
  wire [BITS-1:0] new_label = next_above_left ? open_label : next_above_label;
  wire new_valid = next_above_left || next_above_valid;
  wire new_seen = next_above_left && open_seen;
  wire [BITS-1:0] touched = above_starts ? new_label : above_label;
  wire touched_valid = above_starts ? new_valid : above_valid;
  wire touched_seen = above_starts ? new_seen : above_seen;

  // The run of this row; `held`: whose extremes are at hand, if `holds`.
  logic [BITS-1:0] label, next_label, held;
  logic labelled, linked, holds;
  wire adopts = touches && touched_valid && (starts || !labelled);
  // A component is joined where its run starts, and never in the clock in which a run ends.
  wire same = joins_left ? open_label == label : joins_same;
  wire joins = touches && !starts && labelled && (joins_left || joins_valid) && !same;
  wire joins_outer = joins && joins_left && open_seen;
  wire joins_inner = joins && !(joins_left && open_seen);

  always_ff @(posedge clk) begin
    if (adopts || joins_outer) label <= touched;
    if (adopts) labelled <= 1'b1;
    else if (starts) labelled <= 1'b0;
    if (adopts) linked <= touched_seen;
    else if (joins_outer) linked <= 1'b1;
    if (above_starts) begin
      above_label <= joins_inner ? label : new_label;
      above_valid <= new_valid;
      above_left  <= next_above_left;
      above_place <= read;
    end
    if (above_starts) above_seen <= new_seen || adopts || joins_inner;
    else if (adopts) above_seen <= 1'b1;
  end

  // The run that ended: its label, a new one if it has none, none if none is free.
  wire is_new = finishes && !labelled;
  wire [BITS-1:0] final_label = labelled ? label : next_label;
  wire is_linked = labelled && linked;
  wire is_valid = labelled || next_label != '0;
  wire written = finishes && is_valid;
  logic [X_BITS-1:0] run_first, run_last, run_length;
  logic [Y_BITS-1:0] run_row;
  always_ff @(posedge clk) begin
    if (starts) run_first <= place_x;
    if (decides && seen_dark) begin
      run_last   <= place_x;
      run_row    <= place_y;
      run_length <= starts ? X_BITS'(1) : run_length + 1'b1;
    end
    if (adopts || joins_outer) held <= touched;
    else if (written) held <= final_label;
    if (adopts) holds <= 1'b1;
    else if (starts) holds <= 1'b0;
    else if (written) holds <= 1'b1;
    if (rst) label_overflow <= '0;
    else if (is_new && !written) label_overflow <= label_overflow + 32'(run_length);
  end

  // Components that are open in the row above; the top is a register.
  wire right, open_push, open_pop, open_replace;
  wire passed_seen = above_seen || (adopts && !above_starts);
  wire passed = passes && above_valid;
  assign open_replace = passed && right && above_left;
  assign open_push = passed && right && !above_left;
  assign open_pop = passed && !right && above_left;
  wire complete = passed && !right && !passed_seen;

  logic [BITS:0] stack[0:(1<<(PLACE-1))-1];
  logic [PLACE-2:0] depth;
  wire [PLACE-2:0] under = depth - 1'b1;
  always_ff @(posedge clk) begin
    if (open_push) stack[depth] <= {open_seen, open_label};
    if (open_push || open_replace) {open_seen, open_label} <= {passed_seen, above_label};
    else if (open_pop) {open_seen, open_label} <= stack[under];
    if (rst) depth <= '0;
    else if (open_push) depth <= depth + 1'b1;
    else if (open_pop) depth <= under;
  end

  run_ring #(
      .PLACE(PLACE),
      .BITS (BITS)
  ) ring (
      .clk,
      .rst,
      .finishes,
      .label(final_label),
      .valid(is_valid),
      .linked(is_linked),
      .joins_linked(joins_outer && linked),
      .outer(touched),
      .inner(label),
      .take(above_starts),
      .held_place(above_place),
      .held_right(above_right),
      .read,
      .next_label(next_above_label),
      .next_valid(next_above_valid),
      .joins_valid,
      .joins_left,
      .joins_same,
      .next_left(next_above_left),
      .next_right(next_above_right),
      .right
  );
  always_ff @(posedge clk) above_right <= above_starts ? next_above_right : right;

  // Labels that are done with leave one after the other; those of complete components with them.
  wire leaves;
  wire [BITS-1:0] leaving;
  wire take_out;
  wire [BITS-1:0] out_label;
  wire [KEYS-1:0] out_keys;

  free_labels #(
      .LABELS(LABELS)
  ) free (
      .clk,
      .rst,
      .take(is_new),
      .give_back(leaves),
      .returned(leaving),
      .next(next_label)
  );

  label_extremes #(
      .X_BITS(X_BITS),
      .Y_BITS(Y_BITS),
      .BITS  (BITS),
      .KEYS  (KEYS)
  ) extremes (
      .clk,
      .write(written),
      .write_label(final_label),
      .first(run_first),
      .last(run_last),
      .row(run_row),
      .clear(starts && !adopts),
      .load(adopts),
      .held(written ? final_label : held),
      .holds(written || holds),
      .join_(joins),
      .other(touched),
      .read(take_out),
      .read_label(out_label),
      .read_keys(out_keys)
  );

  wire waiting;
  leaving_blobs #(
      .X_BITS(X_BITS),
      .Y_BITS(Y_BITS),
      .BITS(BITS),
      .KEYS(KEYS),
      .MINIMUM_SIDE(MINIMUM_SIDE)
  ) out (
      .clk,
      .rst,
      .push(complete || joins),
      .push_blob(complete),
      .push_label(complete ? above_label : joins_outer ? label : touched),
      .take(take_out),
      .take_label(out_label),
      .taken_keys(out_keys),
      .leaves,
      .leaving,
      .waiting,
      .blob_out,
      .extreme_0,
      .extreme_1,
      .extreme_2,
      .extreme_3,
      .extreme_4,
      .extreme_5,
      .extreme_6,
      .extreme_7
  );
  assign idle = !(busy || waiting || blob_out);
endmodule
