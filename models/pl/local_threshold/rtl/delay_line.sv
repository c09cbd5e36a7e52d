// A word leaves DELAY clocks after it went in. It goes through a few registers, and then through one
// block memory after the other: rings of one length, each with a register behind the memory's own.
//
// They turn from the second word of a frame on, and stand still between frames. What leaves before
// DELAY words went in is what an earlier frame left behind.
module delay_line #(
    parameter int DELAY = 640,  // 8 or more
    parameter int BITS  = 8     // 18 at most
) (
    input  logic            clk,
    input  logic            reset,
    input  logic            turns,   // a word goes in, and so did one in the clock before
    input  logic [BITS-1:0] value,
    output logic [BITS-1:0] delayed
);
  // Words of a RAMB18E1. Yosys 0.23 cannot map a RAMB36E1 with a port for each (abc9 aborts).
  localparam int DEEPEST = BITS <= 9 ? 2048 : 1024;
  localparam int RINGS = (DELAY + DEEPEST - 1) / DEEPEST;
  localparam int THROUGH = (DELAY - 1) / RINGS;             // clocks, through a ring
  localparam int REGISTERS = DELAY - RINGS * THROUGH;  // 1 to RINGS
  localparam int PLACES = THROUGH - 1;
  localparam int PLACE_BITS = $clog2(PLACES);
  localparam logic [PLACE_BITS-1:0] LAST = PLACE_BITS'(PLACES - 1);

  logic [PLACE_BITS-1:0] writes, reads;  // `reads` is the place behind `writes`
  always_ff @(posedge clk)
    if (reset) begin
      writes <= '0;
      reads  <= PLACE_BITS'(1);
    end else if (turns) begin
      writes <= reads;
      reads  <= reads == LAST ? '0 : reads + 1'b1;
    end

  logic [REGISTERS*BITS-1:0] waits;
  always_ff @(posedge clk) waits <= (REGISTERS * BITS)'({waits, value});

  logic [RINGS*BITS-1:0] leaves;
  for (genvar ring = 0; ring < RINGS; ring++) begin : g_ring
    logic [BITS-1:0] stored[0:PLACES-1];
    logic [BITS-1:0] oldest;
    wire [BITS-1:0] enters =
        ring == 0 ? waits[(REGISTERS-1)*BITS+:BITS] : leaves[(ring == 0 ? 0 : ring - 1)*BITS+:BITS];
    always_ff @(posedge clk) begin
      stored[writes] <= enters;
      oldest <= stored[reads];
      leaves[ring*BITS+:BITS] <= oldest;
    end
  end
  assign delayed = leaves[(RINGS-1)*BITS+:BITS];
endmodule
