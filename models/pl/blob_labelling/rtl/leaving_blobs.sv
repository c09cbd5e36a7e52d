// Labels that are done with, on their way out: a queue, the memory's address, the memory, its keys, the
// output. Those of complete components show them, at most one in eight clocks, if they are large enough.
module leaving_blobs #(
    parameter int X_BITS = 10,
    parameter int Y_BITS = 9,
    parameter int BITS = 9,
    parameter int KEYS = 168,
    parameter int MINIMUM_SIDE = 10
) (
    input  logic            clk,
    input  logic            rst,
    input  logic            push,
    input  logic            push_blob,   // a complete component, not one that joined another
    input  logic [BITS-1:0] push_label,
    output logic            take,        // from the memory, one clock later
    output logic [BITS-1:0] take_label,
    input  logic [KEYS-1:0] taken_keys,
    output logic            leaves,
    output logic [BITS-1:0] leaving,
    output logic            waiting,
    output logic            blob_out,
    output logic [    31:0] extreme_0,
    output logic [    31:0] extreme_1,
    output logic [    31:0] extreme_2,
    output logic [    31:0] extreme_3,
    output logic [    31:0] extreme_4,
    output logic [    31:0] extreme_5,
    output logic [    31:0] extreme_6,
    output logic [    31:0] extreme_7
);
  localparam int TIE = (X_BITS > Y_BITS) ? X_BITS : Y_BITS;
  localparam int SUM = TIE + 1;
  localparam logic [SUM-1:0] BIAS = {1'b1, TIE'(0)};
  localparam logic [2:0] SPACING = 3'd7;

  logic pushed, pushed_blob;
  logic [BITS-1:0] pushed_label;
  logic [BITS:0] queue[0:(1<<BITS)-1];
  logic [BITS:0] read, write;
  wire queued = read != write;

  logic address_valid, address_blob, memory_valid, memory_blob, keys_valid, keys_blob, valid, blob;
  logic big_enough;
  logic [BITS-1:0] address_label, memory_label, keys_label;
  logic [KEYS-1:0] keys;
  logic [2:0] spacing;

  // A stage takes the next label when it is empty: one label in two clocks, and no stage depends on
  // another. While a blob is shown, the output stage counts as empty and holds its value.
  wire pop = !address_valid && queued;
  wire to_memory = !memory_valid && address_valid;
  wire to_keys = !keys_valid && memory_valid;
  wire to_output = !valid && keys_valid;
  wire shows = blob && big_enough;
  wire shown = valid && shows && spacing == 3'd0;
  assign leaves = valid && (!shows || spacing == 3'd0);
  assign take = !memory_valid;
  assign take_label = address_label;
  assign waiting = pushed || queued || address_valid || memory_valid || keys_valid || valid;

  always_ff @(posedge clk) begin
    {pushed_blob, pushed_label} <= {push_blob, push_label};
    if (pushed) queue[write[BITS-1:0]] <= {pushed_blob, pushed_label};
    if (!address_valid) {address_blob, address_label} <= queue[read[BITS-1:0]];
    if (!memory_valid) {memory_blob, memory_label} <= {address_blob, address_label};
    if (!keys_valid) begin
      {keys_blob, keys_label} <= {memory_blob, memory_label};
      keys <= taken_keys;
    end
    if (rst) begin
      pushed        <= 1'b0;
      read          <= '0;
      write         <= '0;
      address_valid <= 1'b0;
      memory_valid  <= 1'b0;
      keys_valid    <= 1'b0;
      valid         <= 1'b0;
      blob_out      <= 1'b0;
      spacing       <= 3'd0;
    end else begin
      pushed <= push;
      if (pushed) write <= write + 1'b1;
      if (pop) read <= read + 1'b1;
      address_valid <= pop || (address_valid && !to_memory);
      memory_valid  <= to_memory || (memory_valid && !to_keys);
      keys_valid    <= to_keys || (keys_valid && !to_output);
      valid         <= to_output || (valid && !leaves);
      blob_out <= shown;
      if (shown) spacing <= SPACING;
      else if (spacing != 3'd0) spacing <= spacing - 1'b1;
    end
  end

  wire [SUM-1:0] value_0, value_1, value_2, value_3, value_4, value_5, value_6, value_7;
  wire [TIE-1:0] tie_0, tie_1, tie_2, tie_3, tie_4, tie_5, tie_6, tie_7;
  assign {value_7, tie_7, value_6, tie_6, value_5, tie_5, value_4, tie_4,
          value_3, tie_3, value_2, tie_2, value_1, tie_1, value_0, tie_0} = keys;
  wire [SUM-1:0] x_1 = SUM'(tie_1) - value_1 + BIAS;
  wire [SUM-1:0] x_3 = ~value_3 - SUM'(tie_3);
  wire [SUM-1:0] x_5 = value_5 - BIAS + SUM'(tie_5);
  wire [SUM-1:0] x_7 = value_7 - SUM'(tie_7);
  wire [SUM-1:0] wide = ~value_2 - value_6;
  wire [SUM-1:0] high = ~value_4 - value_0;

  always_ff @(posedge clk)
    if (!valid) begin
      {blob, leaving} <= {keys_blob, keys_label};
      big_enough <= wide >= SUM'(MINIMUM_SIDE) && high >= SUM'(MINIMUM_SIDE);
      extreme_0 <= {16'(value_0), 16'(tie_0)};
      extreme_1 <= {16'(tie_1), 16'(x_1)};
      extreme_2 <= {16'(tie_2), 16'(TIE'(~value_2))};
      extreme_3 <= {16'(tie_3), 16'(x_3)};
      extreme_4 <= {16'(TIE'(~value_4)), 16'(tie_4)};
      extreme_5 <= {16'(tie_5), 16'(x_5)};
      extreme_6 <= {16'(tie_6), 16'(value_6)};
      extreme_7 <= {16'(tie_7), 16'(x_7)};
    end
endmodule
