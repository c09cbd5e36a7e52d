// Blob Detection (thesis 4.3.6, ports of table B.3, and `idle`). Companion of BlobCore (core.h).
//
// A dark pixel takes the label of the widest blob among its neighbours: two to the left, five in the
// row above. All of it happens in the pixel's clock: seven widths are looked up and compared, and the
// box grows. Each look-up is a port of distributed memory.
module blob_detection #(
    parameter int WIDTH = 640,
    parameter int LABELS = 128,       // 0, the background, included
    parameter int MINIMUM_SIDE = 24,  // smallest Ex - Sx and Ey - Sy of a blob that is reported
    // Coordinates of frames larger than 1024 x 512 take their bits from the blob's number.
    parameter int X_BITS = WIDTH > 1024 ? $clog2(WIDTH) : 10,
    parameter int Y_BITS = 9
) (
    input  logic        clk,
    input  logic        ena,
    input  logic        rst,
    input  logic        pixel,          // 1 is dark
    input  logic [X_BITS-1:0] x,
    input  logic [Y_BITS-1:0] y,
    output logic        blob_out,
    output logic [31:0] blob_start,
    output logic [31:0] blob_end,
    output logic        idle,           // no frame, and every label retired
    output logic [31:0] label_overflow  // dark pixels that found no free label
);
  localparam int BITS = $clog2(LABELS);
  localparam int NEIGHBOURS = 7;
  localparam int SPAN = 2 * X_BITS;                  // Ex, Sx
  localparam int NUMBER_BITS = 30 - X_BITS - Y_BITS;
  localparam int PLACE = Y_BITS + 1 + X_BITS;        // a row, also below the frame, and a column
  localparam logic [X_BITS-1:0] LAST = X_BITS'(WIDTH - 1);

  // The neighbours' labels in the order in which the first of equally wide ones wins: left near and
  // far, above from left to right. 0 without a neighbour.
  logic [BITS-1:0] left_1, left_2, above_m2, above_m1, above_0, above_p1, above_p2;
  wire below_top = y != Y_BITS'(0);
  wire [NEIGHBOURS*BITS-1:0] neighbours = {
    below_top && x < LAST - X_BITS'(1) ? above_p2 : BITS'(0),
    below_top && x < LAST ? above_p1 : BITS'(0),
    below_top ? above_0 : BITS'(0),
    below_top && x > X_BITS'(0) ? above_m1 : BITS'(0),
    below_top && x > X_BITS'(1) ? above_m2 : BITS'(0),
    x > X_BITS'(1) ? left_2 : BITS'(0),
    x > X_BITS'(0) ? left_1 : BITS'(0)
  };

  // The boxes, in three memories: each is written when its part changes.
  logic [SPAN-1:0] columns[0:LABELS-1];  // Ex, Sx
  logic [Y_BITS-1:0] tops[0:LABELS-1];     // Sy
  logic [Y_BITS-1:0] bottoms[0:LABELS-1];  // Ey
`ifndef SYNTHESIS
  initial columns[0] = '0;  // label 0 has no blob: a simulator would compare an entry that is never written
`endif

  // The widest one: a tree, each node of which keeps the earlier of equally wide ones. Ex - Sx is one less
  // than the width; the bit above it says that there is a label.
  logic [NEIGHBOURS*SPAN-1:0] spans;
  for (genvar n = 0; n < NEIGHBOURS; n++) begin : g_span
    assign spans[n*SPAN+:SPAN] = columns[neighbours[n*BITS+:BITS]];
  end
  localparam int WIDER = 1 + X_BITS;  // what is compared
  localparam int ENTRY = WIDER + BITS + SPAN;
  function automatic logic [ENTRY-1:0] entry(input logic [BITS-1:0] of, input logic [SPAN-1:0] columns_of);
    entry = {of != '0, columns_of[X_BITS+:X_BITS] - columns_of[0+:X_BITS], of, columns_of};
  endfunction
  function automatic logic [ENTRY-1:0] wider(input logic [ENTRY-1:0] a, input logic [ENTRY-1:0] b);
    wider = b[ENTRY-1-:WIDER] > a[ENTRY-1-:WIDER] ? b : a;
  endfunction
  logic [NEIGHBOURS*ENTRY-1:0] entries;
  for (genvar n = 0; n < NEIGHBOURS; n++) begin : g_entry
    assign entries[n*ENTRY+:ENTRY] = entry(neighbours[n*BITS+:BITS], spans[n*SPAN+:SPAN]);
  end
  wire [ENTRY-1:0] left = wider(entries[0*ENTRY+:ENTRY], entries[1*ENTRY+:ENTRY]);
  wire [ENTRY-1:0] above_left = wider(entries[2*ENTRY+:ENTRY], entries[3*ENTRY+:ENTRY]);
  wire [ENTRY-1:0] above_right = wider(entries[4*ENTRY+:ENTRY], entries[5*ENTRY+:ENTRY]);
  wire [ENTRY-1:0] first_four = wider(left, above_left);
  wire [ENTRY-1:0] last_three = wider(above_right, entries[6*ENTRY+:ENTRY]);
  wire [BITS+SPAN-1:0] best = (BITS + SPAN)'(wider(first_four, last_three));
  wire [BITS-1:0] widest = best[SPAN+:BITS];
  wire [SPAN-1:0] span = best[SPAN-1:0];

  // The pixel's label.
  logic [BITS-1:0] next_label;
  logic label_free;
  wire dark = ena && pixel;
  wire is_new = dark && neighbours == '0;
  wire [BITS-1:0] label = !dark ? '0 : is_new ? next_label : widest;
  wire labelled = dark && (!is_new || label_free);

  wire [X_BITS-1:0] span_left = span[0+:X_BITS], span_right = span[X_BITS+:X_BITS];
  wire [X_BITS-1:0] grown_left = !is_new && span_left < x ? span_left : x;
  wire [X_BITS-1:0] grown_right = !is_new && span_right > x ? span_right : x;
  always_ff @(posedge clk) begin
    if (labelled && !rst) begin
      columns[label] <= {grown_right, grown_left};
      bottoms[label] <= y;
    end
    if (labelled && is_new && !rst) tops[label] <= y;
  end

  // The window of labels, moved on to the next pixel.
  line_buffer #(
      .WIDTH(WIDTH),
      .BITS (BITS),
      .AHEAD(2),
      .X_BITS(X_BITS)
  ) line (
      .clk,
      .ena,
      .x,
      .value(label),
      .above(above_p2)
  );
  always_ff @(posedge clk)
    if (ena) begin
      {above_m2, above_m1, above_0, above_p1} <= {above_m1, above_0, above_p1, above_p2};
      {left_2, left_1} <= {left_1, label};
    end

  // Where no pixel can join a blob any more: two columns right of its end in the row below it. All
  // labels are compared at once, so these are registers.
  (* mem2reg *) logic [PLACE-1:0] ends[1:LABELS-1];
  wire [PLACE-1:0] here = {1'b0, y, x};
  wire beyond = grown_right > LAST - X_BITS'(3);  // no pixel of that row is that far right
  wire [Y_BITS:0] end_row = {1'b0, y} + (beyond ? (Y_BITS + 1)'(2) : (Y_BITS + 1)'(1));
  always_ff @(posedge clk)
    if (labelled) ends[label] <= {end_row, beyond ? X_BITS'(0) : grown_right + X_BITS'(3)};

  // Labels retire one a clock, the lowest first; all of them when the frame is over.
  logic ena_before, flush;
  logic [LABELS-1:1] active, due;
  always_comb begin
    due = '0;
    for (int n = 1; n < LABELS; n++)
      if (active[n] && (flush || (ena && here >= ends[n]))) due[n] = 1'b1;
  end
  wire retires = due != '0;
  wire [LABELS-1:1] retire = due & (~due + 1'b1);

  always_ff @(posedge clk)
    if (rst) active <= '0;
    else begin
      active <= active & ~retire;
      if (is_new && labelled) active[label] <= 1'b1;
    end

  // The number of the one bit that is set.
  logic [BITS-1:0] retired_label;
  for (genvar b = 0; b < BITS; b++) begin : g_number
    logic [LABELS-1:1] mask;
    for (genvar n = 1; n < LABELS; n++) begin : g_mask
      assign mask[n] = ((n >> b) & 1) != 0;
    end
    assign retired_label[b] = |(retire & mask);
  end

  free_labels #(
      .LABELS(LABELS)
  ) free (
      .clk,
      .rst,
      .take(is_new),
      .give_back(retires),
      .returned(retired_label),
      .next(next_label),
      .found(label_free)
  );

  always_ff @(posedge clk)
    if (rst) begin
      ena_before <= 1'b0;
      flush <= 1'b0;
    end else begin
      ena_before <= ena;
      flush <= (ena_before && !ena) || (flush && retires);
    end

  // Only blobs large enough for a marker are reported.
  logic retired;
  logic [X_BITS-1:0] start_x, end_x;
  logic [Y_BITS-1:0] start_y, end_y;
  logic [NUMBER_BITS-1:0] number;
  wire [X_BITS-1:0] across = end_x - start_x;
  wire [Y_BITS-1:0] down = end_y - start_y;
  wire reported = 12'(across) >= 12'(MINIMUM_SIDE) && 12'(down) >= 12'(MINIMUM_SIDE);
  always_ff @(posedge clk) begin
    {end_x, start_x} <= columns[retired_label];
    start_y <= tops[retired_label];
    end_y <= bottoms[retired_label];
    if (rst) begin
      retired <= 1'b0;
      blob_out <= 1'b0;
      number <= '0;
    end else begin
      retired <= retires;
      blob_out <= retired && reported;
      if (retired && reported) begin
        blob_start <= {2'b01, number, start_y, start_x};
        blob_end <= {2'b00, number, end_y, end_x};
      end
      if (ena && !ena_before) number <= '0;
      else if (retired && reported) number <= number + 1'b1;
    end
  end

  assign idle = !(ena_before || retired || flush);

  always_ff @(posedge clk)
    if (rst) label_overflow <= '0;
    else if (is_new && !labelled) label_overflow <= label_overflow + 1'b1;
endmodule
