// Corner Detection (thesis 4.3.4, ports of table B.1): FAST-9 on the bright side, then non-maximum
// suppression in two clocks. Companion of CornerCore (core.h).
//
// A corner is strictly stronger than those of its neighbours that come before in raster order, and
// at least as strong as those that come after. Windows that wrap around a line's end do not count.
module corner_detection #(
    parameter int WIDTH = 640,     // pixels a line
    parameter int THRESHOLD = 30,  // grey levels, 0 to 255
    parameter int LEAN = 0,        // 1: one FAST module instead of the thesis' nine; same outputs, same clocks
    // Coordinates of frames larger than 1024 x 512 take their bits from the strength.
    parameter int X_BITS = WIDTH > 1024 ? $clog2(WIDTH) : 10,
    parameter int Y_BITS = 9
) (
    input  logic        clk,
    input  logic        ena,
    input  logic        rst,
    input  logic [ 7:0] pixel,
    input  logic [X_BITS-1:0] x,
    input  logic [Y_BITS-1:0] y,
    output logic        corner_out,
    output logic [31:0] corner_data
);
  localparam int STRENGTH_BITS = 29 - X_BITS - Y_BITS;
  localparam logic [X_BITS-1:0] REACH = 4;  // the newest pixel lies this far right of and below the centre

  logic [9*12-1:0] scores;
  logic [1:0] direction;
  if (LEAN != 0) begin : g_lean
    score_grid_lean #(
        .WIDTH(WIDTH),
        .THRESHOLD(THRESHOLD),
        .X_BITS(X_BITS)
    ) grid (
        .clk,
        .ena,
        .pixel,
        .x,
        .scores,
        .direction
    );
  end else begin : g_thesis
    score_grid_thesis #(
        .WIDTH(WIDTH),
        .THRESHOLD(THRESHOLD),
        .X_BITS(X_BITS)
    ) grid (
        .clk,
        .ena,
        .pixel,
        .x,
        .scores,
        .direction
    );
  end

  // The newest pixel's place beside the stages: window, threshold, score, maximum of a row.
  logic [3:0] whole_at;  // the window lies within the frame
  logic [4*X_BITS-1:0] x_at;
  logic [4*Y_BITS-1:0] y_at;
  wire [X_BITS-1:0] centre_x = x_at[3*X_BITS+:X_BITS] - REACH;
  wire [Y_BITS-1:0] centre_y = y_at[3*Y_BITS+:Y_BITS] - Y_BITS'(REACH);
  always_ff @(posedge clk) begin
    x_at <= {x_at[3*X_BITS-1:0], x};
    y_at <= {y_at[3*Y_BITS-1:0], y};
    whole_at <= rst ? 4'd0 : {whole_at[2:0], ena && x >= 2 * REACH && y >= Y_BITS'(2 * REACH)};
  end

  function automatic logic [11:0] score(input logic [9*12-1:0] grid, input int row, input int column);
    score = grid[(3*row+column)*12+:12];
  endfunction
  function automatic logic [11:0] maximum(input logic [11:0] a, input logic [11:0] b);
    maximum = a > b ? a : b;
  endfunction

  logic [11:0] above, centre, below;
  logic first_in_row;
  logic [1:0] centre_direction;
  always_ff @(posedge clk) begin
    above <= maximum(maximum(score(scores, 0, 0), score(scores, 0, 1)), score(scores, 0, 2));
    below <= maximum(maximum(score(scores, 2, 0), score(scores, 2, 1)), score(scores, 2, 2));
    centre <= score(scores, 1, 1);
    first_in_row <= score(scores, 1, 1) > score(scores, 1, 0)
        && score(scores, 1, 1) >= score(scores, 1, 2);
    centre_direction <= direction;
  end

  wire is_corner = whole_at[3] && first_in_row && centre != 12'd0 && centre > above && centre >= below;
  always_ff @(posedge clk)
    if (rst) corner_out <= 1'b0;
    else begin
      corner_out <= is_corner;
      if (is_corner)
        corner_data <= {1'b1, centre[11-:STRENGTH_BITS], centre_direction, centre_y, centre_x};
    end
endmodule
