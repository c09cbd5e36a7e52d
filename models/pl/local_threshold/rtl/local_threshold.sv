// Local Threshold, with the ports of Global Threshold. Companion of LocalThresholdCore
// (local_threshold.h).
//
// A pixel waits in a delay line until it is in the middle of the window, and in a second one until
// its row leaves the window. A sum is kept of each column in the window, and of the window.
// Four registers lie between the port and the binary image: column, difference, window, comparison.
module local_threshold #(
    parameter int WIDTH = 640,
    parameter int HEIGHT = 480,
    parameter int RADIUS = 5,   // pixels of the window on each side of its middle
    parameter int OFFSET = 10,  // levels by which a dark pixel is below its window's mean
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
    // Rows follow each other without a pause, and go on behind the frame: they are counted here.
    input  logic [X_BITS-1:0] x,
    input  logic [Y_BITS-1:0] y,
    // verilator lint_on UNUSEDSIGNAL
    output logic        binary_ena,
    output logic        binary_out,        // 1 is dark
    output logic [X_BITS-1:0] binary_x,
    output logic [Y_BITS-1:0] binary_y,
    output logic        thresh_out,        // no words are packed
    output logic [31:0] thresh_data,
    output logic [ 7:0] active_threshold   // for reports
);
  localparam int WINDOW = 2 * RADIUS + 1;
  localparam int LAG = RADIUS * WIDTH + RADIUS;  // clocks until a pixel is in the middle
  localparam int C = $clog2(WIDTH);
  localparam int R = $clog2(HEIGHT + RADIUS + 1);
  localparam int N = $clog2(WINDOW + 1);                    // bits of a side of the window
  localparam int COLUMN = $clog2(255 * WINDOW + 1);         // of the sum of a column,
  localparam int SUM = $clog2(255 * WINDOW * WINDOW + 1);   // and of the window

  wire reset = por || rst;

  // A pixel goes in, or nothing behind the last one: in each clock, once a frame has begun.
  logic busy, ended;
  logic [C-1:0] column, next_column;
  logic [R-1:0] row;
  wire push = frame_ena || busy;
  wire last = row == R'(HEIGHT + RADIUS) && next_column == C'(RADIUS);
  wire clear = reset || ended;  // one clock behind the last one
  always_ff @(posedge clk) begin
    ended <= busy && last && !clear;
    if (clear) begin
      busy        <= 1'b0;
      column      <= '0;
      next_column <= C'(1);
      row         <= '0;
    end else if (push) begin
      busy        <= 1'b1;
      column      <= next_column;
      next_column <= next_column == C'(WIDTH - 1) ? '0 : next_column + 1'b1;
      if (next_column == '0) row <= row + 1'b1;
    end
  end

  wire [7:0] entering = frame_ena ? pixel : 8'd0;
  logic [7:0] middle, leaving;
  delay_line #(
      .DELAY(LAG),
      .BITS (8)
  ) to_the_middle (
      .clk,
      .reset,
      .turns(busy),
      .value(entering),
      .delayed(middle)
  );
  // One clock early, as is the sum of the column.
  delay_line #(
      .DELAY(WINDOW * WIDTH - LAG - 1),
      .BITS (8)
  ) to_the_end (
      .clk,
      .reset,
      .turns(busy),
      .value(middle),
      .delayed(leaving)
  );

  // The column that the next pixel enters: without the one that leaves there. What the memories hold
  // of another frame does not count.
  logic [COLUMN-1:0] column_sum, column_above, column_rest;
  logic rows_above, all_rows;
  delay_line #(
      .DELAY(WIDTH - 2),
      .BITS (COLUMN)
  ) columns (
      .clk,
      .reset,
      .turns(busy),
      .value(column_sum),
      .delayed(column_above)
  );
  always_ff @(posedge clk)
    if (clear) begin
      rows_above  <= 1'b0;
      all_rows    <= 1'b0;
      column_rest <= '0;
    end else begin
      if (next_column == C'(WIDTH - 1)) begin
        rows_above <= 1'b1;
        if (row == R'(WINDOW - 1)) all_rows <= 1'b1;
      end
      column_rest <= (rows_above ? column_above : '0) - (all_rows ? COLUMN'(leaving) : '0);
    end
  always_ff @(posedge clk) column_sum <= column_rest + COLUMN'(entering);

  // Where the window turns into the next row it loses columns, while those that enter are added up
  // for the row's first window.
  logic pushed, starts, waits, fits, loses;
  always_ff @(posedge clk) begin
    pushed <= push && !reset;
    starts <= column == '0;
    waits  <= column < C'(RADIUS);
    fits   <= column == C'(RADIUS);
    loses  <= column < C'(RADIUS) || column > C'(2 * RADIUS);
  end
  logic [WINDOW*COLUMN-1:0] passing;  // the newest column is the lowest
  logic [COLUMN:0] difference;
  logic [SUM-1:0] first_columns, sum;
  logic changes, begins;
  always_ff @(posedge clk) begin
    changes    <= pushed;
    begins     <= fits;
    difference <= {1'b0, waits ? COLUMN'(0) : column_sum}
                - {1'b0, loses ? passing[WINDOW*COLUMN-1-:COLUMN] : COLUMN'(0)};
    passing    <= {passing[(WINDOW-1)*COLUMN-1:0], column_sum};
    if (waits) first_columns <= (starts ? '0 : first_columns) + SUM'(column_sum);
    if (changes)
      sum <= (begins ? first_columns : sum) + {{SUM - COLUMN - 1{difference[COLUMN]}}, difference};
  end

  // Pixels of the window across and down: fewer at the frame's border.
  logic leaves;
  logic [N-1:0] across, down;
  always_ff @(posedge clk)
    if (clear || last) leaves <= 1'b0;
    else if (busy) begin
      if (next_column == C'(RADIUS)) begin
        if (row == R'(RADIUS)) leaves <= 1'b1;
        if (row == R'(RADIUS)) down <= N'(RADIUS + 1);
        else if (row >= R'(HEIGHT)) down <= down - 1'b1;
        else if (row <= R'(2 * RADIUS)) down <= down + 1'b1;
      end
      if (next_column == C'(RADIUS)) across <= N'(RADIUS + 1);
      else if (next_column < C'(RADIUS)) across <= across - 1'b1;
      else if (next_column <= C'(2 * RADIUS)) across <= across + 1'b1;
    end

  // The mean without division.
  logic [2*N-1:0] count;
  logic [7:0] grey;
  logic [8:0] raised;
  logic [SUM:0] product, limit;
  logic [7:0] level;
  logic [2:0] leaves_then;
  logic below, below_then;
  always_ff @(posedge clk) begin
    leaves_then <= reset ? '0 : {leaves_then[1:0], leaves};
    count       <= across * down;
    grey        <= middle;
    raised      <= {1'b0, middle} + 9'(OFFSET);
    product     <= (SUM + 1)'(count) * (SUM + 1)'(raised);
    below       <= grey <= level;
    limit       <= product;
    below_then  <= below;
    binary_out  <= below_then || limit <= {1'b0, sum};
  end

  // The binary image counts its own pixels.
  assign thresh_out  = 1'b0;
  assign thresh_data = '0;
  always_ff @(posedge clk) begin
    binary_ena <= leaves_then[2] && !reset;
    if (leaves_then[2]) begin
      binary_x <= !binary_ena || binary_x == X_BITS'(WIDTH - 1) ? '0 : binary_x + 1'b1;
      if (!binary_ena) binary_y <= '0;
      else if (binary_x == X_BITS'(WIDTH - 1)) binary_y <= binary_y + 1'b1;
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
