// One line of a frame: `above` is what was stored at column `x` one line before.
//
// It is read a pixel ahead, through a register, and written at another address in the same clock:
// block RAM with one port for each.
module line_buffer #(
    parameter int WIDTH = 640,  // columns
    parameter int BITS = 8,
    parameter int AHEAD = 0,    // `above` belongs to column x + AHEAD
    parameter int X_BITS = 10
) (
    input  logic            clk,
    input  logic            ena,
    input  logic [X_BITS-1:0] x,
    input  logic [BITS-1:0] value,
    output logic [BITS-1:0] above
);
  localparam int PLACE_BITS = $clog2(WIDTH);
  localparam logic [X_BITS-1:0] WRAP = X_BITS'(WIDTH - 1 - AHEAD);

  logic [BITS-1:0] stored[0:WIDTH-1];
  wire [PLACE_BITS-1:0] place = PLACE_BITS'(x);
  wire [PLACE_BITS-1:0] next = PLACE_BITS'(x >= WRAP ? x - WRAP : x + X_BITS'(AHEAD + 1));

  always_ff @(posedge clk)
    if (ena) begin
      stored[place] <= value;
      above   <= stored[next];
    end
endmodule
