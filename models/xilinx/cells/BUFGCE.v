// Clock buffer with an enable that is taken while the clock is low (UG953).
module BUFGCE #(parameter CE_TYPE = "SYNC", parameter IS_CE_INVERTED = 1'b0, parameter IS_I_INVERTED = 1'b0)(
  output O, input CE, input I
);
  wire clock = I ^ IS_I_INVERTED;
  reg enabled;
  always_latch if (!clock) enabled = CE ^ IS_CE_INVERTED;
  assign O = clock & enabled;
  if (CE_TYPE != "SYNC") $error("BUFGCE is modelled with CE_TYPE SYNC only");
endmodule
