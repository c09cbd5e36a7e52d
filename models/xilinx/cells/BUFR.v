// Clock buffer of a region (UG953), without its divider.
module BUFR #(parameter BUFR_DIVIDE = "BYPASS", parameter SIM_DEVICE = "7SERIES")(output O, input CE, input CLR, input I);
  wire unused = CE ^ CLR;
  assign O = I;
  if (BUFR_DIVIDE != "BYPASS") $error("BUFR is modelled with BUFR_DIVIDE BYPASS only");
endmodule
