// One FAST module (thesis 4.3.4.3): threshold, then {contiguity, strength, direction}. Two clocks.
module fast_module #(
    parameter int THRESHOLD = 30  // grey levels, 0 to 255
) (
    input logic clk,
    // The point of interest and three pixels around it; the corners of that square are not looked at.
    /* verilator lint_off UNUSEDSIGNAL */
    input logic [7*7*8-1:0] window,
    /* verilator lint_on UNUSEDSIGNAL */
    output logic contiguous,
    output logic [11:0] strength,
    output logic [1:0] direction  // N 0, S 1, E 2, W 3
);
  function automatic logic [7:0] at(input logic [7*7*8-1:0] square, input int row, input int column);
    at = square[(7*row+column)*8+:8];
  endfunction

  // Index 0 on top, clockwise.
  wire [16*8-1:0] circle = {
    at(window, 0, 2), at(window, 1, 1), at(window, 2, 0), at(window, 3, 0),
    at(window, 4, 0), at(window, 5, 1), at(window, 6, 2), at(window, 6, 3),
    at(window, 6, 4), at(window, 5, 5), at(window, 4, 6), at(window, 3, 6),
    at(window, 2, 6), at(window, 1, 5), at(window, 0, 4), at(window, 0, 3)
  };
  // Nine bits: does not wrap.
  wire [8:0] limit = {1'b0, at(window, 3, 3)} + 9'(THRESHOLD);

  logic [15:0] bright;
  logic [16*8-1:0] difference;
  always_ff @(posedge clk)
    for (int n = 0; n < 16; n++) begin
      bright[n] <= {1'b0, circle[n*8+:8]} > limit;
      difference[n*8+:8] <= {1'b0, circle[n*8+:8]} > limit ? circle[n*8+:8] - limit[7:0] : 8'd0;
    end

  // Runs of 2, 4, 8 and then 9 on the ring: neighbour by rotation.
  wire [15:0] two = bright & {bright[0], bright[15:1]};
  wire [15:0] four = two & {two[1:0], two[15:2]};
  wire [15:0] eight = four & {four[3:0], four[15:4]};
  wire [15:0] nine = eight & {bright[7:0], bright[15:8]};

  function automatic logic [11:0] sum(input logic [16*8-1:0] values);
    sum = 12'd0;
    for (int n = 0; n < 16; n++) sum = sum + {4'd0, values[n*8+:8]};
  endfunction

  function automatic logic [2:0] ones(input logic [4:0] bits);
    ones = {2'd0, bits[0]} + {2'd0, bits[1]} + {2'd0, bits[2]} + {2'd0, bits[3]} + {2'd0, bits[4]};
  endfunction

  // The region with the most bright pixels; the first of N, S, E, W at a tie.
  wire [2:0] north = ones({bright[2:0], bright[15:14]});
  wire [2:0] south = ones(bright[10:6]);
  wire [2:0] east = ones(bright[6:2]);
  wire [2:0] west = ones(bright[14:10]);
  wire [1:0] north_or_south = {1'b0, south > north};
  wire [2:0] most_of_those = south > north ? south : north;
  wire [1:0] or_east = east > most_of_those ? 2'd2 : north_or_south;
  wire [2:0] most_of_three = east > most_of_those ? east : most_of_those;

  always_ff @(posedge clk) begin
    contiguous <= |nine;
    strength   <= sum(difference);
    direction  <= west > most_of_three ? 2'd3 : or_east;
  end
endmodule
