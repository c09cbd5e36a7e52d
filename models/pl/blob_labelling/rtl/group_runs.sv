// The runs of dark pixels that end in the pixels of a clock, two clocks behind the port: three of them at
// most, from left to right, and whether the row does.
//
// A run is given by its first column and the column after its last.
module group_runs #(
    parameter int WIDTH = 640,
    parameter int HEIGHT = 480,
    parameter int P = 4,        // pixels a clock, 2 or 4
    parameter int X_BITS = 10,
    parameter int Y_BITS = 9,
    parameter int COLUMN = 10   // bits of a column, and of WIDTH
) (
    input  logic                clk,
    input  logic                rst,
    input  logic                ena,
    input  logic [       P-1:0] pixels,    // the leftmost is the lowest
    // verilator lint_off UNUSEDSIGNAL
    // Columns of a clock follow from each other.
    input  logic [  X_BITS-1:0] x,
    // verilator lint_on UNUSEDSIGNAL
    input  logic [  Y_BITS-1:0] y,
    output logic [         2:0] ends,      // of the lowest is the leftmost
    output logic [3*COLUMN-1:0] first,
    output logic [3*COLUMN-1:0] behind,
    output logic                row_ends,
    output logic                frame_ends  // so does the frame, if row_ends
);
  localparam int LANE = $clog2(P);
  localparam int GROUP = COLUMN - LANE;

  // Captured.
  logic valid, at_right, at_bottom;
  logic [P-1:0] dark;
  logic [GROUP-1:0] group;
  always_ff @(posedge clk) begin
    valid <= ena && !rst;
    if (ena) begin
      dark      <= pixels;
      group     <= GROUP'(x >> LANE);
      at_right  <= x == X_BITS'(WIDTH - P);
      at_bottom <= y == Y_BITS'(HEIGHT - 1);
    end
  end

  // What follows from the pixels, and the one before: lanes, of which P is the place behind them.
  logic dark_before;  // the pixel before is dark: a run has begun
  logic [COLUMN-1:0] begun;
  logic [2:0] found, old;  // `old`: it begun in a clock before
  logic [3*LANE-1:0] first_lane;
  logic [3*LANE+2:0] behind_lane;
  logic runs, runs_old;    // at the pixel at hand
  logic [LANE-1:0] from;
  logic [1:0] count;
  always_comb begin
    found = '0;
    old = '0;
    first_lane = '0;
    behind_lane = '0;
    runs = dark_before;
    runs_old = 1'b1;
    from = '0;
    count = 2'd0;
    for (int i = 0; i <= P; i++) begin
      if (runs && (i == P ? at_right : !dark[i])) begin
        for (int j = 0; j < 3; j++)
          if (count == 2'(j)) begin
            found[j] = 1'b1;
            old[j] = runs_old;
            first_lane[j*LANE+:LANE] = from;
            behind_lane[j*(LANE+1)+:LANE+1] = (LANE + 1)'(i);
          end
        count = count + 2'd1;
        runs = 1'b0;
      end
      if (i < P && dark[i] && !runs) begin
        runs = 1'b1;
        runs_old = 1'b0;
        from = LANE'(i);
      end
    end
  end

  always_ff @(posedge clk) begin
    for (int j = 0; j < 3; j++) begin
      first[j*COLUMN+:COLUMN] <= old[j] ? begun : {group, first_lane[j*LANE+:LANE]};
      behind[j*COLUMN+:COLUMN] <= behind_lane[j*(LANE+1)+LANE] ? COLUMN'(WIDTH)
                                                               : {group, behind_lane[j*(LANE+1)+:LANE]};
    end
    frame_ends <= at_bottom;
    if (valid && !runs_old) begun <= {group, from};
    if (rst) begin
      dark_before <= 1'b0;
      ends     <= '0;
      row_ends <= 1'b0;
    end else begin
      ends     <= valid ? found : '0;
      row_ends <= valid && at_right;
      if (valid) dark_before <= runs && !at_right;
    end
  end
endmodule
