// The clock at which each grey level came last, of two frames in turn. A level that did not occur
// holds the clock of an earlier frame.
module last_seen #(
    parameter int BITS = 18  // of a clock's number
) (
    input  logic            clk,
    input  logic            bank,      // the frame that is searched is the other one
    input  logic            into,      // of a level of this clock: `bank` behind the clock
    input  logic            seen,
    input  logic [     7:0] level,
    input  logic [BITS-1:0] now,
    input  logic [     7:0] searched,
    output logic [BITS-1:0] last       // of the level that was searched two clocks ago
);
  logic [BITS-1:0] clocks[0:511];
  logic [8:0] place;
  always_ff @(posedge clk) begin
    if (seen) clocks[{into, level}] <= now;
    place <= {!bank, searched};
    last  <= clocks[place];
  end
endmodule
