// The stored image (thesis 4.3.1): a block memory with a port of 32 bits that writes and one of 8 bits
// that reads, through a register. Four pixels a word, the leftmost in bits 7:0.
module frame_memory #(
    parameter int PIXELS = 640 * 480,
    parameter int BITS_A = $clog2(PIXELS / 4),
    parameter int BITS_B = BITS_A + 2
) (
    input  logic              clk_a,
    input  logic              we_a,
    input  logic [BITS_A-1:0] addr_a,
    input  logic [      31:0] din_a,
    input  logic              clk_b,
    input  logic              en_b,
    input  logic [BITS_B-1:0] addr_b,
    output logic [       7:0] dout_b
);
  logic [31:0] words[0:PIXELS/4-1];
  logic [31:0] word;
  logic [ 1:0] lane;
  assign dout_b = word[{lane, 3'd0}+:8];

  always_ff @(posedge clk_a) if (we_a) words[addr_a] <= din_a;

  always_ff @(posedge clk_b)
    if (en_b) begin
      word <= words[addr_b[BITS_B-1:2]];
      lane <= addr_b[1:0];
    end
endmodule
