// Blob Labelling: each connected component of dark pixels once, with its outermost pixels in eight
// directions. Companion of RunLabeller (run_labeller.h), which says how it works; one pixel a clock is
// LabellingCore's (core.h), several are GroupLabellingCore's (group_core.h).
//
// The memories of the rows' runs follow one clock behind a decision, the extremes three.
module blob_labelling #(
    parameter int WIDTH = 640,
    parameter int HEIGHT = 480,
    parameter int LABELS = 512,       // 0, which means none, included
    parameter int MINIMUM_SIDE = 10,  // smallest side (last - first) of a blob that is shown
    parameter int PIXELS_PER_CLOCK = 1,  // 1, 2 or 4
    parameter int RUN_FIFO_DEPTH = 64,   // runs that wait, where several pixels come on a clock
    parameter int X_BITS = WIDTH > 1024 ? $clog2(WIDTH) : 10,
    parameter int Y_BITS = HEIGHT > 512 ? $clog2(HEIGHT) : 9
) (
    input  logic              clk,
    input  logic              ena,
    input  logic              rst,
    input  logic              pixel,          // 1 is dark
    // verilator lint_off UNUSEDSIGNAL
    // Neighbours to the right, as many as come on a clock.
    input  logic              pixel_1,
    input  logic              pixel_2,
    input  logic              pixel_3,
    // verilator lint_on UNUSEDSIGNAL
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
    output logic [      31:0] label_overflow  // dark pixels of runs that found no free label, or no room
);
  localparam int BITS = $clog2(LABELS);
  localparam int KEYS = 8 * (((X_BITS > Y_BITS) ? X_BITS : Y_BITS) * 2 + 1);
  localparam int SEVERAL = PIXELS_PER_CLOCK > 1 ? 1 : 0;

  wire busy, is_new, label_free, written, clear, load, holds, joins, done, done_blob;
  wire [BITS-1:0] next_label, written_label, held, touched, done_label;
  wire [X_BITS-1:0] run_first, run_last;
  wire [Y_BITS-1:0] run_row;

  if (SEVERAL != 0) begin : g_groups
    group_labeller #(
        .WIDTH(WIDTH),
        .HEIGHT(HEIGHT),
        .BITS(BITS),
        .P(PIXELS_PER_CLOCK),
        .FIFO_DEPTH(RUN_FIFO_DEPTH),
        .X_BITS(X_BITS),
        .Y_BITS(Y_BITS)
    ) labeller (
        .clk,
        .ena,
        .rst,
        .pixels(PIXELS_PER_CLOCK'({pixel_3, pixel_2, pixel_1, pixel})),
        .x,
        .y,
        .busy,
        .is_new,
        .next_label,
        .label_free,
        .label_overflow,
        .written,
        .written_label,
        .run_first,
        .run_last,
        .run_row,
        .clear,
        .load,
        .held,
        .holds,
        .joins,
        .touched,
        .done,
        .done_blob,
        .done_label
    );
  end else begin : g_pixels
    pixel_labeller #(
        .WIDTH(WIDTH),
        .HEIGHT(HEIGHT),
        .BITS(BITS),
        .X_BITS(X_BITS),
        .Y_BITS(Y_BITS)
    ) labeller (
        .clk,
        .ena,
        .rst,
        .pixel,
        .x,
        .y,
        .busy,
        .is_new,
        .next_label,
        .label_free,
        .label_overflow,
        .written,
        .written_label,
        .run_first,
        .run_last,
        .run_row,
        .clear,
        .load,
        .held,
        .holds,
        .joins,
        .touched,
        .done,
        .done_blob,
        .done_label
    );
  end

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
      .next(next_label),
      .found(label_free)
  );

  label_extremes #(
      .X_BITS(X_BITS),
      .Y_BITS(Y_BITS),
      .BITS  (BITS),
      .KEYS  (KEYS),
      .JOINS_AT_ONCE(SEVERAL)
  ) extremes (
      .clk,
      .write(written),
      .write_label(written_label),
      .first(run_first),
      .last(run_last),
      .row(run_row),
      .clear,
      .load,
      .held,
      .holds,
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
      .push(done),
      .push_blob(done_blob),
      .push_label(done_label),
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
