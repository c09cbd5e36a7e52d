// The scores of the 3 x 3 points of interest around the centre of the window as the thesis finds
// them (4.3.4): nine FAST modules side by side over a 9 x 9 window. Three clocks.
module score_grid_thesis #(
    parameter int WIDTH = 640,
    parameter int THRESHOLD = 30,
    parameter int X_BITS = 10
) (
    input  logic            clk,
    input  logic            ena,
    input  logic [     7:0] pixel,
    input  logic [X_BITS-1:0] x,
    output logic [9*12-1:0] scores,    // of row r and column c: [(3 * r + c) * 12 +: 12]; 0: no corner
    output logic [     1:0] direction  // of the centre
);
  logic [9*9*8-1:0] window;
  pixel_window #(
      .WIDTH (WIDTH),
      .SIZE  (9),
      .X_BITS(X_BITS)
  ) pixels (
      .clk,
      .ena,
      .pixel,
      .x,
      .window
  );

  logic [9*2-1:0] directions;
  assign direction = directions[4*2+:2];

  for (genvar row = 0; row < 3; row++) begin : g_row
    for (genvar column = 0; column < 3; column++) begin : g_column
      localparam int POINT = 3 * row + column;
      logic contiguous;
      logic [11:0] strength;
      fast_module #(
          .THRESHOLD(THRESHOLD)
      ) fast (
          .clk,
          .window({
            window[((row+6)*9+column)*8+:7*8],
            window[((row+5)*9+column)*8+:7*8],
            window[((row+4)*9+column)*8+:7*8],
            window[((row+3)*9+column)*8+:7*8],
            window[((row+2)*9+column)*8+:7*8],
            window[((row+1)*9+column)*8+:7*8],
            window[((row+0)*9+column)*8+:7*8]
          }),
          .contiguous,
          .strength,
          .direction(directions[POINT*2+:2])
      );
      assign scores[POINT*12+:12] = contiguous ? strength : 12'd0;
    end
  end

  // The directions of the other eight points are unused.
  wire unused = &{1'b0, directions[17:10], directions[7:0]};
endmodule
