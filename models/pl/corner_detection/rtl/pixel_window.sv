// The newest SIZE x SIZE pixels of a frame (thesis 4.3.4.1). Row 0 is the uppermost, column 0 the
// leftmost; the pixel of row r and column c is window[(SIZE * r + c) * 8 +: 8].
module pixel_window #(
    parameter int WIDTH = 640,
    parameter int SIZE  = 9,
    parameter int X_BITS = 10
) (
    input  logic                     clk,
    input  logic                     ena,
    input  logic [              7:0] pixel,
    input  logic [       X_BITS-1:0] x,
    output logic [SIZE*SIZE*8-1:0] window
);
  // The column of pixels that enters: the new one below those of the lines before.
  logic [SIZE*8-1:0] column;
  assign column[(SIZE-1)*8+:8] = pixel;

  for (genvar row = 0; row < SIZE - 1; row++) begin : g_lines
    line_buffer #(
        .WIDTH (WIDTH),
        .BITS  (8),
        .X_BITS(X_BITS)
    ) line (
        .clk,
        .ena,
        .x,
        .value(column[(row+1)*8+:8]),
        .above(column[row*8+:8])
    );
  end

  always_ff @(posedge clk)
    if (ena)
      for (int row = 0; row < SIZE; row++)
        window[row*SIZE*8+:SIZE*8] <= {column[row*8+:8], window[(row*SIZE+1)*8+:(SIZE-1)*8]};
endmodule
