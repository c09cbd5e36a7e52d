// Control Block (thesis 4.4.1, ports of table B.4): splits the control packet. Combinational.
module control_block (
    // Bits 6, 7 and those above the threshold have no meaning.
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [31:0] gpio_in,
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic        por,        // system reset, passed on as rst_out
    output logic        ena,
    output logic        rst_out,
    output logic [ 1:0] ready,
    output logic        wr_en,
    output logic        wr_thresh,
    output logic [ 7:0] threshold
);
  assign ena = gpio_in[0];
  assign rst_out = gpio_in[1] || por;
  assign ready = gpio_in[3:2];
  assign wr_en = gpio_in[4];
  assign wr_thresh = gpio_in[5];
  assign threshold = gpio_in[15:8];
endmodule
