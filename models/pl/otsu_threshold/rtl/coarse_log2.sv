// The logarithm to base 2 of the first eleven bits of `value`, which is not 0, in steps of 2^-14, five
// clocks later.
module coarse_log2 #(
    parameter int BITS = 46  // 17 to 64
) (
    input  logic            clk,
    input  logic [BITS-1:0] value,
    output logic [    19:0] log
);
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
  log2_fractions fractions (
      .clk,
      .index,
      .fraction(looked_up)
  );
  always_ff @(posedge clk) begin
    shifted <= bytes;
    for (int i = 0; i < BYTES; i++) used[i] <= bytes[16+8*i+:8] != 8'd0;
    {byte_, window} <= {found_byte, found_window};
    {byte_of_index, bit_of_index, index} <= {byte_, found_bit, found_index};
    exponent <= {byte_of_index, bit_of_index};
    log <= {exponent, looked_up};
  end
endmodule
