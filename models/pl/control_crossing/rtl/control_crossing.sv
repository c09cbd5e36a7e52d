// What software says to the logic, on its way from the bus clock to the pixel clock: each wire through
// two registers of the pixel clock. Companion of ControlCrossing (control_crossing.h).
//
// It has no reset: the reset itself crosses here. The threshold crosses beside `wr_thresh`, bit by bit:
// `wr_thresh` is a level and reloads on each clock, so a torn value lasts one clock at most.
module control_crossing (
    input  logic       clk,           // pixel clock
    input  logic       ena_in,        // of the bus clock
    input  logic       rst_in,
    input  logic       por_in,
    input  logic       wr_thresh_in,
    input  logic [7:0] threshold_in,
    output logic       ena,
    output logic       rst,
    output logic       por,
    output logic       wr_thresh,
    output logic [7:0] threshold
);
  (* ASYNC_REG = "TRUE" *) logic [11:0] first = '0, second = '0;
  always_ff @(posedge clk) begin
    first  <= {ena_in, rst_in, por_in, wr_thresh_in, threshold_in};
    second <= first;
  end
  assign {ena, rst, por, wr_thresh, threshold} = second;
endmodule
