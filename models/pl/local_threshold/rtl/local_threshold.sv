// Local Threshold, with the ports of Global Threshold. Companion of LocalThresholdCore
// (local_threshold.h).
//
// A pixel waits in a delay line until it is in the middle of the window, and in a second one until
// its row leaves the window. A sum is kept of each column in the window, and of the window.
// Four registers lie between the port and the binary image: column, difference, window, comparison; and
// where several pixels come on a clock differences, their sums, windows, comparisons. RELATIVE takes one
// more: what the sum allows.
module local_threshold #(
    parameter int WIDTH = 640,
    parameter int HEIGHT = 480,
    parameter int RADIUS = 5,   // pixels of the window on each side of its middle
    parameter int OFFSET = 2,   // levels by which a dark pixel is below its window's mean
    parameter int RELATIVE = 3,  // and by 1 / 2^RELATIVE of the mean; 0: by OFFSET alone
    parameter int PIXELS_PER_CLOCK = 1,  // 1, 2 or 4
    parameter int X_BITS = WIDTH > 1024 ? $clog2(WIDTH) : 10,
    parameter int Y_BITS = HEIGHT > 512 ? $clog2(HEIGHT) : 9
) (
    input  logic        clk,
    input  logic        por,               // system reset
    input  logic        rst,               // the level survives it
    input  logic        frame_ena,
    input  logic        wr_thresh,         // a level: loads `threshold` on every clock
    input  logic [ 7:0] threshold,         // up to it all is dark, from the next frame on
    input  logic [ 7:0] pixel,
    // verilator lint_off UNUSEDSIGNAL
    // Neighbours to the right, as many as come on a clock.
    input  logic [ 7:0] pixel_1,
    input  logic [ 7:0] pixel_2,
    input  logic [ 7:0] pixel_3,
    // Rows follow each other without a pause, and go on behind the frame: they are counted here.
    input  logic [X_BITS-1:0] x,
    input  logic [Y_BITS-1:0] y,
    // verilator lint_on UNUSEDSIGNAL
    output logic        binary_ena,
    output logic        binary_out,        // 1 is dark
    output logic        binary_out_1,
    output logic        binary_out_2,
    output logic        binary_out_3,
    output logic [X_BITS-1:0] binary_x,
    output logic [Y_BITS-1:0] binary_y,
    output logic        thresh_out,        // no words are packed
    output logic [31:0] thresh_data,
    output logic [ 7:0] active_threshold   // for reports
);
  localparam int WINDOW = 2 * RADIUS + 1;
  localparam int P = PIXELS_PER_CLOCK;
  localparam int ROW = WIDTH / P;              // clocks
  localparam int AHEAD = (RADIUS + P - 1) / P;  // clocks of a row until a window's right side is there
  localparam int LAG = RADIUS * ROW + AHEAD;   // clocks until a pixel is in the middle
  localparam int C = $clog2(ROW);
  localparam int R = $clog2(HEIGHT + RADIUS + 1);
  localparam int N = $clog2(WINDOW + 1);                    // bits of a side of the window
  localparam int COLUMN = $clog2(255 * WINDOW + 1);         // of the sum of a column,
  localparam int SUM = $clog2(255 * WINDOW * WINDOW + 1);   // and of the window

  wire reset = por || rst;

  // A pixel goes in, or nothing behind the last one: in each clock, once a frame has begun. `turns` is
  // high where the middle of the window comes into the next row. What that row decides is in
  // registers by then: compared at once it was the longest path.
  logic busy, ended, turns, first_row, upper_rows, lower_rows, last_row;
  logic [C-1:0] column, next_column;
  logic [R-1:0] row;
  wire push = frame_ena || busy;
  wire last = turns && last_row;
  wire clear = reset || ended;  // one clock behind the last one
  always_ff @(posedge clk) begin
    ended <= last && !clear;
    turns <= push && !clear && next_column == C'(AHEAD - 1);
    if (clear) begin
      busy        <= 1'b0;
      column      <= '0;
      next_column <= C'(1);
      row         <= '0;
      {first_row, upper_rows, lower_rows, last_row} <= '0;
    end else if (push) begin
      busy        <= 1'b1;
      column      <= next_column;
      next_column <= next_column == C'(ROW - 1) ? '0 : next_column + 1'b1;
      if (next_column == '0) begin
        row        <= row + 1'b1;
        first_row  <= row == R'(RADIUS - 1);
        upper_rows <= row < R'(2 * RADIUS);
        lower_rows <= row >= R'(HEIGHT - 1);
        last_row   <= row == R'(HEIGHT + RADIUS - 1);
      end
    end
  end

  wire [8*P-1:0] entering = frame_ena ? (8 * P)'({pixel_3, pixel_2, pixel_1, pixel}) : '0;
  logic [8*P-1:0] middle, leaving;
  localparam int HELD = P == 1 ? 8 : 16;  // bits of a delay line
  for (genvar i = 0; i < 8 * P; i += HELD) begin : g_rows
    delay_line #(
        .DELAY(LAG),
        .BITS (HELD)
    ) to_the_middle (
        .clk,
        .reset,
        .turns(busy),
        .value(entering[i+:HELD]),
        .delayed(middle[i+:HELD])
    );
    // One clock early, as is the sum of the column.
    delay_line #(
        .DELAY(WINDOW * ROW - LAG - 1),
        .BITS (HELD)
    ) to_the_end (
        .clk,
        .reset,
        .turns(busy),
        .value(middle[i+:HELD]),
        .delayed(leaving[i+:HELD])
    );
  end

  // The column that the next pixel enters: without the one that leaves there. What the memories hold
  // of another frame does not count.
  logic [P*COLUMN-1:0] column_sum, column_above, column_rest, column_now;
  logic rows_above, all_rows;
  for (genvar lane = 0; lane < P; lane++) begin : g_column
    delay_line #(
        .DELAY(ROW - 2),
        .BITS (COLUMN)
    ) columns (
        .clk,
        .reset,
        .turns(busy),
        .value(column_sum[lane*COLUMN+:COLUMN]),
        .delayed(column_above[lane*COLUMN+:COLUMN])
    );
    always_ff @(posedge clk)
      if (clear) column_rest[lane*COLUMN+:COLUMN] <= '0;
      else
        column_rest[lane*COLUMN+:COLUMN] <= (rows_above ? column_above[lane*COLUMN+:COLUMN] : '0)
                                          - (all_rows ? COLUMN'(leaving[8*lane+:8]) : '0);
    assign column_now[lane*COLUMN+:COLUMN] = column_rest[lane*COLUMN+:COLUMN] + COLUMN'(entering[8*lane+:8]);
  end
  always_ff @(posedge clk)
    if (clear) begin
      rows_above <= 1'b0;
      all_rows   <= 1'b0;
    end else if (next_column == C'(ROW - 1)) begin
      rows_above <= 1'b1;
      if (row == R'(WINDOW - 1)) all_rows <= 1'b1;
    end
  always_ff @(posedge clk) column_sum <= column_now;

  // Where the window turns into the next row it loses columns, while those that enter are added up
  // for the row's first window.
  logic pushed, changes;
  always_ff @(posedge clk) {changes, pushed} <= {pushed, push && !reset};
  logic [P*SUM-1:0] sums;
  if (P == 1) begin : g_one
    logic starts, waits, fits, loses;
    always_ff @(posedge clk) begin
      starts <= column == '0;
      waits  <= column < C'(RADIUS);
      fits   <= column == C'(RADIUS);
      loses  <= column < C'(RADIUS) || column > C'(2 * RADIUS);
    end
    logic [WINDOW*COLUMN-1:0] passing;  // the newest column is the lowest
    logic [COLUMN:0] difference;
    logic [SUM-1:0] first_columns, sum;
    logic begins;
    assign sums = sum;
    always_ff @(posedge clk) begin
      begins     <= fits;
      difference <= {1'b0, waits ? COLUMN'(0) : column_sum}
                  - {1'b0, loses ? passing[WINDOW*COLUMN-1-:COLUMN] : COLUMN'(0)};
      passing    <= {passing[(WINDOW-1)*COLUMN-1:0], column_sum};
      if (waits) first_columns <= (starts ? '0 : first_columns) + SUM'(column_sum);
      if (changes)
        sum <= (begins ? first_columns : sum) + {{SUM - COLUMN - 1{difference[COLUMN]}}, difference};
    end
  end else begin : g_several
    window_sums #(
        .P(P),
        .RADIUS(RADIUS),
        .C(C),
        .COLUMN(COLUMN),
        .SUM(SUM)
    ) windows (
        .clk,
        .clear,
        .push,
        .column,
        .next_column,
        .column_now,
        .column_sum,
        .sums
    );
  end

  // Pixels of the window across and down: fewer at the frame's border.
  logic leaves;
  logic [N-1:0] down;
  logic [P*N-1:0] across;
  always_ff @(posedge clk)
    if (clear || last) leaves <= 1'b0;
    else if (turns) begin
      if (first_row) leaves <= 1'b1;
      if (first_row) down <= N'(RADIUS + 1);
      else if (lower_rows) down <= down - 1'b1;
      else if (upper_rows) down <= down + 1'b1;
    end
  if (P == 1) begin : g_across
    always_ff @(posedge clk)
      if (busy) begin
        if (next_column == C'(RADIUS)) across <= N'(RADIUS + 1);
        else if (next_column < C'(RADIUS)) across <= across - 1'b1;
        else if (next_column <= C'(2 * RADIUS)) across <= across + 1'b1;
      end
  end else begin : g_across_of
    // The middle of the window lies P * AHEAD px to the left of the clock's first pixel.
    localparam int BESIDE = P * AHEAD - RADIUS;
    for (genvar lane = 0; lane < P; lane++) begin : g_lane
      localparam int RIGHT = RADIUS + BESIDE - 1 - lane;  // where the row turns
      localparam int FULL = AHEAD + (lane < RADIUS ? (RADIUS - lane + P - 1) / P : 0);
      wire [N-1:0] place = N'(P) * N'(next_column);
      always_ff @(posedge clk)
        if (next_column == '0) across[lane*N+:N] <= N'(RADIUS + 1 + (RIGHT < RADIUS ? RIGHT : RADIUS));
        else if (next_column < C'(AHEAD)) across[lane*N+:N] <= N'(RADIUS + 1 + RIGHT) - place;
        else if (next_column < C'(FULL)) across[lane*N+:N] <= N'(lane) + N'(1 - BESIDE) + place;
        else across[lane*N+:N] <= N'(WINDOW);
    end
  end

  // The mean without division.
  logic [7:0] level;
  localparam int STAGES = RELATIVE == 0 ? 3 : 4;
  logic [STAGES-1:0] leaves_then;
  always_ff @(posedge clk) leaves_then <= reset ? '0 : STAGES'({leaves_then, leaves});
  logic [P-1:0] binary;
  for (genvar lane = 0; lane < P; lane++) begin : g_mean
    // Not in the multiplier, which needs its inputs a nanosecond earlier than a register of the fabric.
    (* keep *) logic [2*N-1:0] count;
    logic [2*N-1:0] count_then;
    logic [7:0] grey;
    logic [8:0] raised;
    logic [SUM:0] limit;
    logic below, below_then;
    always_ff @(posedge clk) begin
      count      <= across[lane*N+:N] * down;
      count_then <= count;
      grey       <= middle[8*lane+:8];
      raised     <= {1'b0, grey} + (RELATIVE == 0 ? 9'(OFFSET) : 9'd0);
      limit      <= (SUM + 1)'(count_then) * (SUM + 1)'(raised);
      below      <= grey <= level;
      below_then <= below;
    end
    if (RELATIVE == 0) begin : g_offset
      always_ff @(posedge clk) binary[lane] <= below_then || limit <= {1'b0, sums[lane*SUM+:SUM]};
    end else begin : g_share
      // The larger of both distances from the mean; a sum that is below it has no dark pixel.
      localparam int LESS = SUM + 1;
      logic [LESS-1:0] offsets, allowed, limit_then;
      logic reaches, below_last;
      wire [LESS-1:0] sum = {1'b0, sums[lane*SUM+:SUM]};
      wire [LESS-1:0] share = sum >> RELATIVE;
      wire [LESS-1:0] distance = offsets > share ? offsets : share;
      always_ff @(posedge clk) begin
        offsets      <= LESS'(count_then) * LESS'(OFFSET);
        allowed      <= sum - distance;
        reaches      <= distance <= sum;
        limit_then   <= limit;
        below_last   <= below_then;
        binary[lane] <= below_last || (reaches && limit_then <= allowed);
      end
    end
  end
  assign {binary_out_3, binary_out_2, binary_out_1, binary_out} = 4'(binary);

  // The binary image counts its own pixels.
  assign thresh_out  = 1'b0;
  assign thresh_data = '0;
  always_ff @(posedge clk) begin
    binary_ena <= leaves_then[STAGES-1] && !reset;
    if (leaves_then[STAGES-1]) begin
      binary_x <= !binary_ena || binary_x == X_BITS'(WIDTH - P) ? '0 : binary_x + X_BITS'(P);
      if (!binary_ena) binary_y <= '0;
      else if (binary_x == X_BITS'(WIDTH - P)) binary_y <= binary_y + 1'b1;
    end
  end

  // A frame keeps the level with which it began.
`ifndef SYNTHESIS
  initial active_threshold = '0;  // a simulation may begin behind the system reset
`endif
  always_ff @(posedge clk) begin
    if (por) active_threshold <= '0;
    else if (!rst && wr_thresh) active_threshold <= threshold;
    if (!changes) level <= active_threshold;
  end
endmodule
