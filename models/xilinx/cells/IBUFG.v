// Input buffer of a clock (UG953). The electrical parameters change nothing here.
module IBUFG #(
  parameter CAPACITANCE = "DONT_CARE", parameter DIFF_TERM = "FALSE", parameter DQS_BIAS = "FALSE",
  parameter IBUF_DELAY_VALUE = "0", parameter IBUF_LOW_PWR = "TRUE", parameter IFD_DELAY_VALUE = "AUTO",
  parameter IOSTANDARD = "DEFAULT", parameter SLEW = "SLOW", parameter DRIVE = 12
)(output O, input I);
  assign O = I;
endmodule
