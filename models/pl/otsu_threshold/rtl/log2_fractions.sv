// log2(1 + index/1024) in steps of 2^-14, a clock later. A module without parameters: tools evaluate the
// table once, however many read one like it.
module log2_fractions (
    input  logic        clk,
    input  logic [ 9:0] index,
    output logic [13:0] fraction
);
  // Bit by bit: whether the square of what is left reaches 2.
  function automatic logic [13:0] logarithm(input logic [9:0] index_);
    logic [63:0] left;
    left = {33'd0, 1'b1, index_, 20'd0};
    for (int bit_ = 13; bit_ >= 0; bit_--) begin
      left = left * left >> 30;
      logarithm[bit_] = left[31];
      if (left[31]) left = left >> 1;
    end
  endfunction
  logic [13:0] table_[0:1023];
  initial for (int i = 0; i < 1024; i++) table_[i] = logarithm(10'(i));

  always_ff @(posedge clk) fraction <= table_[index];
endmodule
