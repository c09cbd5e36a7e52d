// The runs of dark pixels and their labels, a pixel a clock. Companion of LabellingCore (core.h).
//
// A pixel is captured in one clock (`step`), what starts and ends with it is known in the next, and
// decided upon in the third. The memories of the rows' runs follow one clock later, the extremes three.
module pixel_labeller #(
    parameter int WIDTH = 640,
    parameter int HEIGHT = 480,
    parameter int BITS = 9,  // of a label
    parameter int X_BITS = 10,
    parameter int Y_BITS = 9
) (
    input  logic              clk,
    input  logic              ena,
    input  logic              rst,
    input  logic              pixel,       // 1 is dark
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
  localparam int COLUMN = $clog2(WIDTH);
  localparam int RUNS = 2 * (WIDTH / 4 + 2);  // places in the ring of runs
  localparam int PLACE = $clog2(RUNS);
  localparam logic [X_BITS-1:0] LAST = X_BITS'(WIDTH - 1);
  localparam logic [Y_BITS-1:0] BOTTOM = Y_BITS'(HEIGHT - 1);

  // The captured pixel. Behind a frame come a bright row and one pixel more.
  logic step, dark, first_column, last_column, below, final_pixel;
  logic [X_BITS-1:0] column;
  logic [Y_BITS-1:0] row;
  logic flushing;
  logic [X_BITS:0] flush;  // clocks of it that are left
  wire last_flush = flush == (X_BITS + 1)'(1);
  logic [X_BITS-1:0] flush_column;
  wire [X_BITS-1:0] next_column = flushing ? flush_column : x;

  (* ram_style = "block" *) logic line[0:WIDTH-1];
  logic line_above;
  always_ff @(posedge clk) begin
    if (step) line[COLUMN'(column)] <= dark;
    line_above <= line[COLUMN'(next_column)];
  end

  always_ff @(posedge clk) begin
    flush_column <= flushing && flush_column != LAST ? flush_column + 1'b1 : '0;
    if (flushing || ena) begin
      dark         <= !flushing && pixel;
      column       <= next_column;
      first_column <= next_column == '0;
      last_column  <= next_column == LAST;
      below        <= flushing ? !last_flush : y != '0;
      final_pixel  <= flushing && last_flush;
      if (!flushing) row <= y;
    end
    if (rst) begin
      step     <= 1'b0;
      flushing <= 1'b0;
      flush    <= '0;
      busy     <= 1'b0;
    end else begin
      step <= flushing || ena;
      if (flushing) begin
        flush <= flush - 1'b1;
        if (last_flush) flushing <= 1'b0;
      end else if (ena && x == LAST && y == BOTTOM) begin
        flush <= (X_BITS + 1)'(WIDTH + 1);
        flushing <= 1'b1;
      end
      if (!flushing && ena) busy <= 1'b1;
      else if (ends_frame && !step) busy <= 1'b0;
    end
  end

  // What starts and ends in this row and in the row above, in the next clock.
  logic last_dark, last_above, last_ended, row_dark;
  wire dark_before = !first_column && last_dark;
  wire above_before = !first_column && last_above;
  wire above = below && line_above;
  wire start = dark && !dark_before;
  wire above_start = above && !above_before;
  logic starts, above_starts, starts_below, meets, passes, finishes, spans, seen_dark, decides;
  logic ends_frame, at_first, behind_first;
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
      row_dark     <= 1'b0;
      starts       <= 1'b0;
      above_starts <= 1'b0;
      starts_below <= 1'b0;
      meets        <= 1'b0;
      passes       <= 1'b0;
      finishes     <= 1'b0;
      spans        <= 1'b0;
      decides      <= 1'b0;
      ends_frame   <= 1'b0;
      at_first     <= 1'b0;
      behind_first <= 1'b0;
    end else begin
      starts       <= step && start;
      above_starts <= step && above_start;
      starts_below <= step && start && (above || above_before);  // touches a run above
      meets        <= step && dark_before && above_start;        // a run touches one that starts now
      passes       <= step && (first_column ? last_above : above_before && !above);
      finishes     <= step && last_ended;
      spans        <= step && last_ended && row_dark;            // it is the only one of its row
      decides      <= step;
      ends_frame   <= step && final_pixel;
      at_first     <= step && first_column;
      behind_first <= at_first;
      if (step) begin
        last_dark  <= dark;
        last_above <= above;
        last_ended <= (dark_before && !dark) || (dark && last_column);
        row_dark   <= first_column ? dark : row_dark && (dark || last_column);
      end
    end
  end

  // The run above: the present one or the one before, and the next one. A run that has another one of
  // its component to its left finds it on top of the stack of open components. A run that spans a row, but
  // for its last pixel, may be taken from the row above in the clock in which it ends.
  logic [BITS-1:0] above_label, stored_label, open_label, final_label;
  logic above_valid, above_seen, above_left, above_right, open_seen;
  logic stored_valid, stored_left, is_valid, is_linked;
  wire next_left = spans ? is_linked : stored_left;
  wire new_valid = next_left || (spans ? is_valid : stored_valid);
  wire [BITS-1:0] new_label = next_left ? open_label : spans ? final_label : stored_label;
  wire new_seen = next_left && open_seen;
  assign touched = above_starts ? new_label : above_label;
  wire touched_valid = above_starts ? new_valid : above_valid;
  wire touched_seen = above_starts ? new_seen : above_seen;

  // The run of this row; `last_held`: whose extremes are at hand, if `last_holds`.
  logic [BITS-1:0] label, not_label, last_held;  // inverted, for the address of a memory: label has loads enough
  logic labelled, linked, last_holds;
  wire adopts = (starts_below && touched_valid) || (meets && new_valid && !labelled);
  // Components are joined where the run of one starts, and never in the clock in which a run ends. One
  // that has runs in this row lies around the present one, and is the open one.
  wire is_open;  // the present component is the open one
  same_bits #(
      .BITS(BITS)
  ) open_is_present (
      .a(open_label),
      .b(label),
      .same(is_open)
  );
  wire other_open = stored_left && !is_open;
  wire other_next = !stored_left && stored_valid && stored_label != label;
  wire joins_outer = meets && labelled && other_open && open_seen;
  wire joins_inner = meets && labelled && (other_next || (other_open && !open_seen));
  assign joins = joins_outer || joins_inner;
  wire [BITS-1:0] next_one = adopts || joins_outer ? touched : label;

  always_ff @(posedge clk) begin
    if (adopts || joins_outer) {label, not_label} <= {touched, ~touched};
    if (adopts) labelled <= 1'b1;
    else if (starts) labelled <= 1'b0;
    if (adopts) linked <= touched_seen;
    else if (joins_outer) linked <= 1'b1;
    if (above_starts) begin
      above_label <= joins_inner ? label : new_label;
      above_valid <= new_valid;
      above_left  <= next_left;
    end
    if (above_starts) above_seen <= new_seen || adopts || joins_inner;
    else if (adopts) above_seen <= 1'b1;
  end

  // The run that ended: its label, a new one if it has none, none if none is free.
  assign is_new = finishes && !labelled;
  assign final_label = labelled ? label : next_label;
  assign is_linked = labelled && linked;
  assign is_valid = labelled || label_free;
  assign written = finishes && is_valid;
  logic [X_BITS-1:0] run_length;
  always_ff @(posedge clk) begin
    if (starts) run_first <= place_x;
    if (decides && seen_dark) begin
      run_last   <= place_x;
      run_row    <= place_y;
      run_length <= starts ? X_BITS'(1) : run_length + 1'b1;
    end
    if (adopts || joins_outer) last_held <= touched;
    else if (written) last_held <= final_label;
    if (adopts) last_holds <= 1'b1;
    else if (starts) last_holds <= 1'b0;
    else if (written) last_holds <= 1'b1;
    if (rst) label_overflow <= '0;
    else if (is_new && !written) label_overflow <= label_overflow + 32'(run_length);
  end

  // Components that are open in the row above; the top is a register.
  logic first_is_set, right;
  wire passed_seen = above_seen || (starts_below && !above_starts);
  wire passed = passes && above_valid;
  wire open_replace = passed && right && above_left;
  wire open_push = passed && right && !above_left;
  wire open_pop = passed && !right && above_left;
  wire complete = passed && !right && !passed_seen;

  logic [BITS:0] stack[0:(1<<(PLACE-1))-1];
  logic [PLACE-2:0] depth, under;  // under = depth - 1
  always_ff @(posedge clk) begin
    if (open_push) stack[depth] <= {open_seen, open_label};
    if (open_push || open_replace) {open_seen, open_label} <= {passed_seen, above_label};
    else if (open_pop) {open_seen, open_label} <= stack[under];
    if (rst) {depth, under} <= {(PLACE - 1)'(0), ~(PLACE - 1)'(0)};
    else if (open_push) {depth, under} <= {depth + 1'b1, depth};
    else if (open_pop) {depth, under} <= {under, under - 1'b1};
  end

  logic stored_right;
  run_ring #(
      .RUNS (RUNS),
      .PLACE(PLACE),
      .BITS (BITS)
  ) ring (
      .clk,
      .rst,
      .begins_row(behind_first),
      .finishes,
      .label(final_label),
      .valid(is_valid),
      .linked(is_linked),
      .meets,
      .joins_linked(joins_outer && linked),
      .outer(open_label),
      .inner(label),
      .not_inner(not_label),
      .next_inner(next_one),
      .take(above_starts),
      .stored_label,
      .stored_valid,
      .stored_left,
      .stored_right,
      .first_is_set
  );
  // The last run of a row may be finished while the first one is taken from the row above, or passes.
  wire next_right = !spans && (stored_right || (first_is_set && (at_first || behind_first)));
  assign right = above_right || (first_is_set && behind_first);
  always_ff @(posedge clk) above_right <= above_starts ? next_right : right;

  assign written_label = final_label;
  assign clear = starts && !adopts;
  assign load = adopts;
  assign held = written ? final_label : last_held;
  assign holds = written || last_holds;
  // Labels that are done with leave one after the other; those of complete components with them.
  assign done = complete || joins;
  assign done_blob = passes;
  assign done_label = passes ? above_label : stored_left && open_seen ? label : new_label;
endmodule
