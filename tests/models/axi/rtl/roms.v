// Memories that are read from files: beside the source, by a path in the vendor's project, by a name that is put together, by $fscanf.
// `words` is what they have at the address.
module roms (input clk, output [31:0] words);
  reg [1:0] at = 0;
  always @(posedge clk) at <= at + 1;
  rom even(clk, at, words[7:0]);
  rom #(.FILE("../project/data/odd.dat")) odd(clk, at, words[15:8]);
  rom #(.FILE("bits"), .BINARY(1)) bits(clk, at, words[23:16]);
  scanned same(clk, at, words[31:24]);
endmodule

module rom #(parameter FILE = "./even.dat", BINARY = 0) (input clk, input [1:0] at, output reg [7:0] word);
  reg [7:0] memory[0:3];
  generate
    if (BINARY) begin
      initial $readmemb({FILE, ".mem"}, memory);
    end else begin
      initial $readmemh(FILE, memory);
    end
  endgenerate
  always @(posedge clk) word <= memory[at];
endmodule

module scanned (input clk, input [1:0] at, output reg [7:0] word);
  reg [7:0] memory[0:3];
  integer file, found, i;
  initial begin
    file = $fopen("even.dat", "r");
    for (i = 0; i < 4; i = i + 1) found = $fscanf(file, "%h", memory[i]);
    $fclose(file);
  end
  always @(posedge clk) word <= memory[at];
endmodule
