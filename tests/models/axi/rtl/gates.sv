// Logic without a clock.
module gates (
    input  logic [7:0] a,
    output logic [7:0] inverted,
    output logic       parity
);
  initial $display("gates are made");
  assign inverted = ~a;
  assign parity   = ^a;
endmodule
