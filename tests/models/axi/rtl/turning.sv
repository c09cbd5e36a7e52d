// 512 bits that turn in each clock in which it works, beside a memory that makes its state large.
module turning (
    input  logic        clk,
    input  logic        rst_n,
    input  logic        works,
    input  logic [31:0] idle_input,
    output logic [31:0] sum,
    output logic [31:0] word
);
  logic [31:0] bits[0:15];
  logic [31:0] memory[0:1023];
  logic [9:0] address;
  always_comb begin
    sum = idle_input;
    for (int i = 0; i < 16; i++) sum ^= bits[i];
  end
  always_ff @(posedge clk)
    if (!rst_n) begin
      for (int i = 0; i < 16; i++) bits[i] <= 32'(i);
      address <= 10'd0;
    end else begin
      word <= memory[address];
      if (idle_input[31]) memory[address] <= idle_input;
      if (works) for (int i = 0; i < 16; i++) bits[i] <= ~bits[i];
    end
endmodule
