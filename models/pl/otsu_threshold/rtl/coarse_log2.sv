// The logarithm to base 2 of the first eleven bits of `value`, which is not 0, in steps of 2^-14, five
// clocks later.
module coarse_log2 #(
    parameter int BITS = 46  // 17 to 64
) (
    input  logic            clk,
    input  logic [BITS-1:0] value,
    output logic [    19:0] log
);
  // log2(1 + i/1024), bit by bit: whether the square of what is left reaches 2.
  function automatic logic [13:0] fraction(input logic [9:0] index);
    logic [63:0] left;
    left = {33'd0, 1'b1, index, 20'd0};
    for (int bit_ = 13; bit_ >= 0; bit_--) begin
      left = left * left >> 30;
      fraction[bit_] = left[31];
      if (left[31]) left = left >> 1;
    end
  endfunction
  logic [13:0] fractions[0:1023];
  initial for (int i = 0; i < 1024; i++) fractions[i] = fraction(10'(i));

  // The first byte with a bit set, then the first bit of it.
  localparam int BYTES = (BITS + 7) / 8;
  wire [8*BYTES+15:0] bytes = {(8 * BYTES)'(value), 16'd0};
  logic [8*BYTES+15:0] shifted;
  logic [BYTES-1:0] used;
  logic [23:0] window, found_window;
  logic [2:0] found_byte, byte_, byte_of_index;
  always_comb begin
    found_byte = 3'd0;
    found_window = shifted[23:0];
    for (int i = 1; i < BYTES; i++)
      if (used[i]) begin
        found_byte = 3'(i);
        found_window = shifted[8*i+:24];
      end
  end
  logic [2:0] found_bit, bit_of_index;
  logic [9:0] found_index, index;
  always_comb begin
    found_bit = 3'd0;
    found_index = window[15:6];
    for (int i = 1; i < 8; i++)
      if (window[16+i]) begin
        found_bit = 3'(i);
        found_index = window[6+i+:10];
      end
  end

  logic [5:0] exponent;
  logic [13:0] looked_up;
  always_ff @(posedge clk) begin
    shifted <= bytes;
    for (int i = 0; i < BYTES; i++) used[i] <= bytes[16+8*i+:8] != 8'd0;
    {byte_, window} <= {found_byte, found_window};
    {byte_of_index, bit_of_index, index} <= {byte_, found_bit, found_index};
    {exponent, looked_up} <= {byte_of_index, bit_of_index, fractions[index]};
    log <= {exponent, looked_up};
  end
endmodule
