// A source and a sink of an AXI4-Stream. The source breaks a rule once: it withdraws TVALID before TREADY came.
`timescale 1ns / 1ps
module stream;
  reg aclk = 0, aresetn = 0;
  always #5 aclk = ~aclk;

  reg tvalid = 0, tready = 0, tlast = 0, mistaken = 0;
  reg [31:0] tdata = 0;
  integer cycle = 0;

  always @(posedge aclk) begin
    cycle <= cycle + 1;
    aresetn <= cycle > 2;
    tready <= cycle % 7 < 4;
    if (aresetn && (!tvalid || tready)) begin
      tvalid <= cycle % 5 != 0;
      tdata <= tdata + 1;
      tlast <= tdata % 8 == 6;
    end
    if (cycle > 55 && tvalid && !tready && !mistaken) begin
      tvalid <= 0;
      mistaken <= 1;
    end
    if (cycle == 80) $finish;
  end

  initial begin
    $dumpfile("stream.vcd");
    $dumpvars(0, stream);
  end
endmodule
