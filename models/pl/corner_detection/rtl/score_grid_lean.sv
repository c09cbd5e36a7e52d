// The same scores on the same clocks as score_grid_thesis, from one FAST module: eight of the nine
// points of interest were new before, and their scores are kept for two lines, as in the C++ core.
module score_grid_lean #(
    parameter int WIDTH = 640,
    parameter int THRESHOLD = 30,
    parameter int X_BITS = 10
) (
    input  logic            clk,
    input  logic            ena,
    input  logic [     7:0] pixel,
    input  logic [X_BITS-1:0] x,
    output logic [9*12-1:0] scores,
    output logic [     1:0] direction
);
  logic [7*7*8-1:0] window;
  pixel_window #(
      .WIDTH (WIDTH),
      .SIZE  (7),
      .X_BITS(X_BITS)
  ) pixels (
      .clk,
      .ena,
      .pixel,
      .x,
      .window
  );

  logic contiguous;
  logic [11:0] strength;
  logic [1:0] new_direction;
  fast_module #(
      .THRESHOLD(THRESHOLD)
  ) fast (
      .clk,
      .window,
      .contiguous,
      .strength,
      .direction(new_direction)
  );

  // The newest pixel's column beside the stages of window and FAST module.
  logic [2:0] ena_at;
  logic [3*X_BITS-1:0] x_at;
  wire [X_BITS-1:0] scored_x = x_at[2*X_BITS+:X_BITS];
  always_ff @(posedge clk) begin
    ena_at <= {ena_at[1:0], ena};
    x_at   <= {x_at[2*X_BITS-1:0], x};
  end

  // Of each row of the grid the score that enters on the right.
  wire [11:0] below = contiguous ? strength : 12'd0;
  logic [11:0] here, above;
  logic [1:0] here_direction;
  line_buffer #(
      .WIDTH (WIDTH),
      .BITS  (14),
      .X_BITS(X_BITS)
  ) line_here (
      .clk,
      .ena  (ena_at[2]),
      .x    (scored_x),
      .value({new_direction, below}),
      .above({here_direction, here})
  );
  line_buffer #(
      .WIDTH (WIDTH),
      .BITS  (12),
      .X_BITS(X_BITS)
  ) line_above (
      .clk,
      .ena  (ena_at[2]),
      .x    (scored_x),
      .value(here),
      .above(above)
  );

  // The two columns before.
  logic [2*12-1:0] row_above, row_here, row_below;
  assign scores = {below, row_below, here, row_here, above, row_above};
  always_ff @(posedge clk)
    if (ena_at[2]) begin
      row_above <= {above, row_above[12+:12]};
      row_here  <= {here, row_here[12+:12]};
      row_below <= {below, row_below[12+:12]};
      direction <= here_direction;
    end
endmodule
