// The extremes of labels (Extremes in core.h): eight keys, of which the least wins.
//
// The present component's lie in `current`. A command of the clock n reads the memory in n + 1, its
// answer is in a register behind n + 2, and in n + 3 the keys are compared: the run that ended joins
// `current` and is written, then `current` takes or joins what was read. Keys of ones join nothing.
module label_extremes #(
    parameter int X_BITS = 10,
    parameter int Y_BITS = 9,
    parameter int BITS = 9,
    parameter int KEYS = 168,
    parameter int JOINS_AT_ONCE = 0  // 1: a component may join another one behind the clock that wrote it
) (
    input  logic              clk,
    // A run ended, of the present component.
    input  logic              write,
    input  logic [  BITS-1:0] write_label,
    input  logic [X_BITS-1:0] first,
    input  logic [X_BITS-1:0] last,
    input  logic [Y_BITS-1:0] row,
    // A run starts that belongs to no component yet.
    input  logic              clear,
    // The component `other` becomes the present one, or joins it. `held` is at hand already, if `holds`.
    input  logic              load,
    input  logic [  BITS-1:0] held,
    input  logic              holds,
    input  logic              join_,
    input  logic [  BITS-1:0] other,
    // A second port: the keys of `read_label`, one clock later.
    input  logic              read,
    input  logic [  BITS-1:0] read_label,
    output logic [  KEYS-1:0] read_keys
);
  localparam int KEY = KEYS / 8;
  localparam int TIE = (X_BITS > Y_BITS) ? X_BITS : Y_BITS;
  localparam int SUM = TIE + 1;
  localparam logic [SUM-1:0] BIAS = {1'b1, TIE'(0)};

  // Of the run; in the order of blob_stream::Extreme, the first in the lowest bits.
  wire [TIE-1:0] run_row = TIE'(row);
  wire [TIE-1:0] run_first = TIE'(first);
  wire [SUM-1:0] wide_row = SUM'(row);
  wire [SUM-1:0] wide_first = SUM'(first);
  wire [SUM-1:0] wide_last = SUM'(last);
  wire [SUM-1:0] last_sum = wide_last + wide_row;
  wire [KEYS-1:0] run = {
    wide_first + wide_row,
    run_row,
    wide_first,
    run_row,
    wide_first - wide_row + BIAS,
    run_row,
    ~wide_row,
    run_first,
    ~last_sum,
    run_row,
    ~wide_last,
    run_row,
    wide_row - wide_last + BIAS,
    run_row,
    wide_row,
    run_first
  };

  // Commands on their way: behind the decision, behind the memory, at the comparison.
  logic write_1, write_2, write_3, clear_1, clear_2, clear_3, load_1, load_2, takes_3, holds_1, join_1, join_2;
  logic [BITS-1:0] label_1, label_2, label_3, held_1, other_1, other_2;
  logic [KEYS-1:0] run_1, run_2;
  always_ff @(posedge clk) begin
    {write_3, write_2, write_1} <= {write_2, write_1, write};
    {clear_3, clear_2, clear_1} <= {clear_2, clear_1, clear};
    takes_3 <= clear_2 || load_2;  // a register: every key waits for it
    {load_2, load_1} <= {load_1 && !(holds_1 && other_1 == held_1), load};
    {holds_1, held_1} <= {holds, held};
    {join_2, join_1} <= {join_1, join_};
    {label_3, label_2, label_1} <= {label_2, label_1, write_label};
    {other_2, other_1} <= {other_1, other};
    {run_2, run_1} <= {run_1, run};
  end

  // What a run wrote is not in the memory yet when the next ones read it. Two clocks later it is taken
  // from `recent`. One clock later, too: that is the first run of a row, which joins nothing else;
  // with JOINS_AT_ONCE what is joined comes as it is written.
  logic [KEYS-1:0] current, operand, memory, stored, recent;
  logic load_recent, answer_recent, joins_written;
  wire [KEYS-1:0] answer = answer_recent ? recent : stored;
  wire [KEYS-1:0] loaded = clear_3 ? '1 : load_recent ? recent : memory;
  wire [KEYS-1:0] joined;
  for (genvar i = 0; i < 8; i++) begin : g_key
    wire [KEY-1:0] mine = current[i*KEY+:KEY];
    wire [KEY-1:0] theirs = operand[i*KEY+:KEY];
    assign joined[i*KEY+:KEY] = theirs < mine ? theirs : mine;
  end

  if (JOINS_AT_ONCE != 0) begin : g_at_once
    logic not_write_2;  // inverted: every operand waits for write_2
    always_ff @(posedge clk) begin
      not_write_2 <= !write_1;
      joins_written <= !not_write_2 && other_1 == label_2;
    end
  end else begin : g_later
    assign joins_written = 1'b0;
  end

  logic [KEYS-1:0] keys[0:(1<<BITS)-1];
  logic [KEYS-1:0] copy[0:(1<<BITS)-1];
  always_ff @(posedge clk) begin
    if (write_3) keys[label_3] <= joined;
    stored <= keys[other_1];
    memory <= answer;
    operand <= write_2 ? run_2 : !join_2 ? '1 : joins_written ? joined : answer;
    answer_recent <= write_3 && other_1 == label_3;
    load_recent <= write_3 && other_2 == label_3;
    recent <= joined;
    current <= takes_3 ? loaded : joined;
  end
  always_ff @(posedge clk) begin
    if (write_3) copy[label_3] <= joined;
    if (read) read_keys <= copy[read_label];
  end
endmodule
